/* mesh_read_vtk.c: reads a legacy VTK file: polygonal data, or the surface of an unstructured grid
 *
 * Four lines: "# vtk DataFile Version 3.0", a title, ASCII or BINARY, and the kind of DATASET. Then
 * sections: a line with a keyword and sizes, followed by numbers, as text or big-endian. Up to
 * version 4 the cells of a section are counts, each followed by so many vertices; from version 5 on
 * two arrays, OFFSETS and CONNECTIVITY. Data at points and cells come last. */
#include <stdlib.h>
#include <string.h>

#include "mesh_build.h"
#include "tools/io/scalar.h"
#include "vtk_grid.h"

typedef struct vtk {
    mesh_build *b;
    bool ascii;
    bool has_points;
    bool is_grid; /* an unstructured grid */
    vtk_grid grid;
    int64_t others; /* cells that are vertices or lines */
    bool has_data;  /* at points or cells */
} vtk;

/* Reads a word in capital letters: keywords may be in either case. */
static void read_keyword(input *in, char word[32]) {
    input_word(in, word, 32);
    for (char *c = word; *c != '\0'; c++) {
        *c = *c >= 'a' && *c <= 'z' ? (char)(*c - 'a' + 'A') : *c;
    }
}

/* Ends the line of a keyword; binary data, which have no lines, may follow. */
static void end_line(vtk *f) {
    (void)input_next_line(f->b->in);
    f->b->in->line = f->ascii ? f->b->in->line : 0;
}

static bool read_type(input *in, scalar_type *type) {
    static const struct {
        const char *name;
        scalar_type type;
    } types[] = {{"CHAR", SCALAR_INT8},          {"UNSIGNED_CHAR", SCALAR_UINT8},
                 {"SHORT", SCALAR_INT16},        {"UNSIGNED_SHORT", SCALAR_UINT16},
                 {"INT", SCALAR_INT32},          {"UNSIGNED_INT", SCALAR_UINT32},
                 {"LONG", SCALAR_INT64},         {"UNSIGNED_LONG", SCALAR_UINT64},
                 {"FLOAT", SCALAR_FLOAT},        {"DOUBLE", SCALAR_DOUBLE},
                 {"VTKTYPEINT64", SCALAR_INT64}, {"VTKTYPEUINT64", SCALAR_UINT64},
                 {"VTKIDTYPE", SCALAR_INT64}};
    char word[32];
    read_keyword(in, word);
    for (size_t k = 0; k < sizeof types / sizeof types[0]; k++) {
        if (strcmp(word, types[k].name) == 0) {
            *type = types[k].type;
            return true;
        }
    }
    return input_error(in, "'%s' is not a type of VTK's numbers, or not supported", word);
}

/* Reads a count. More numbers than bytes that are left cannot follow it. */
static bool read_count(input *in, int64_t *count) {
    return (input_integer(in, count) && input_at_word_end(in) && *count >= 0 &&
            *count <= in->end - in->at) ||
           input_error(in, "a count expected, not larger than the file");
}

static bool read_number(vtk *f, scalar_type type, double *x) {
    return scalar_read(f->b->in, f->ascii, type, true, x);
}

static bool read_index(vtk *f, scalar_type type, const char *section, int64_t *k) {
    double x = 0;
    if (!read_number(f, type, &x) || !scalar_is_index(x)) {
        return input_error(f->b->in, "%s: truncated, or not a vertex or a count", section);
    }
    *k = (int64_t)x;
    return true;
}

static bool read_points(vtk *f) {
    input *in = f->b->in;
    int64_t count = 0;
    scalar_type type;
    if (!read_count(in, &count) || !read_type(in, &type)) {
        return false;
    }
    if (f->has_points) {
        return input_error(in, "a second section POINTS");
    }
    f->has_points = true;
    end_line(f);
    for (int64_t v = 0; v < count; v++) {
        double x[3];
        for (int d = 0; d < 3; d++) {
            if (!read_number(f, type, &x[d])) {
                return input_error(in, "vertex %lld: truncated, or not a number", (long long)v);
            }
        }
        if (!mesh_build_vertex(f->b, x[0], x[1], x[2])) {
            return false;
        }
    }
    return true;
}

/* Moves the corners of the current polygon to the cells of the grid. */
static bool keep_cell(vtk *f) {
    mesh_build *b = f->b;
    bool ok = int_list_add(&f->grid.cells, (sl_int)b->n_corners);
    for (size_t k = 0; k < b->n_corners && ok; k++) {
        ok = int_list_add(&f->grid.cells, b->corners[k]);
    }
    f->grid.n_cells++;
    b->n_corners = 0;
    return ok || input_error(b->in, "out of memory");
}

/* Reads the types of the cells of a grid. */
static bool read_cell_types(vtk *f) {
    input *in = f->b->in;
    int64_t count = 0, type = 0;
    if (!read_count(in, &count)) {
        return false;
    }
    end_line(f);
    for (int64_t k = 0; k < count; k++) {
        if (!read_index(f, SCALAR_INT32, "CELL_TYPES", &type)) {
            return false;
        }
        if (!int_list_add(&f->grid.types, type < INT32_MAX ? (sl_int)type : INT32_MAX)) {
            return input_error(in, "out of memory");
        }
    }
    return true;
}

/* Reads the corners of a cell, and adds it if the section is one of faces. */
static bool read_cell(vtk *f, scalar_type type, const char *section, int64_t corners) {
    const bool is_strip = strcmp(section, "TRIANGLE_STRIPS") == 0;
    const bool is_face = is_strip || f->is_grid || strcmp(section, "POLYGONS") == 0;
    for (int64_t k = 0; k < corners; k++) {
        int64_t vertex = 0;
        if (!read_index(f, type, section, &vertex) ||
            (is_face && !mesh_build_corner(f->b, vertex))) {
            return false;
        }
    }
    if (f->is_grid) {
        return keep_cell(f);
    }
    f->others += !is_face;
    return !is_face || (is_strip ? mesh_build_strip(f->b) : mesh_build_polygon(f->b));
}

/* Cells from version 5 on: `count` offsets, the first of which is 0, and the vertices. */
static bool read_offset_cells(vtk *f, const char *section, int64_t count, int64_t size) {
    input *in = f->b->in;
    scalar_type type;
    char word[32];
    bool ok = read_type(in, &type);
    int64_t *offset = (int64_t *)malloc(((size_t)count + 1) * sizeof *offset);
    end_line(f);
    ok = ok && (offset != NULL || input_error(in, "out of memory"));
    for (int64_t k = 0; k < count && ok; k++) {
        ok = read_index(f, type, section, &offset[k]);
        if (ok && (k == 0 ? offset[k] != 0 : offset[k] < offset[k - 1] || offset[k] > size)) {
            ok = input_error(in, "%s: offsets do not ascend from 0 to %lld", section,
                             (long long)size);
        }
    }
    if (ok && input_more(in)) {
        read_keyword(in, word);
        ok = strcmp(word, "CONNECTIVITY") == 0 && read_type(in, &type);
        ok = ok || input_error(in, "%s: CONNECTIVITY and a type expected", section);
        end_line(f);
    }
    for (int64_t k = 1; k < count && ok; k++) {
        ok = read_cell(f, type, section, offset[k] - offset[k - 1]);
    }
    free(offset);
    return ok;
}

static bool read_cells(vtk *f, const char *section) {
    input *in = f->b->in;
    int64_t count = 0, size = 0, corners = 0;
    if (!read_count(in, &count) || !read_count(in, &size)) {
        return false;
    }
    end_line(f);
    if (in->end - in->at > 7 && memcmp(in->at, "OFFSETS", 7) == 0) {
        in->at += 7;
        return read_offset_cells(f, section, count, size);
    }
    for (int64_t k = 0; k < count; k++) {
        if (!read_index(f, SCALAR_INT32, section, &corners)) {
            return false;
        }
        size -= 1 + corners;
        if (size < 0) {
            return input_error(in, "%s: cell %lld is longer than the size of the section", section,
                               (long long)k);
        }
        if (!read_cell(f, SCALAR_INT32, section, corners)) {
            return false;
        }
    }
    return true;
}

/* Skips arrays of data that belong to no point or cell. */
static bool skip_field(vtk *f) {
    input *in = f->b->in;
    int64_t arrays = 0;
    char word[32];
    input_word(in, word, sizeof word);
    if (!read_count(in, &arrays)) {
        return false;
    }
    for (int64_t k = 0; k < arrays; k++) {
        int64_t width = 0, count = 0;
        scalar_type type;
        double ignored;
        end_line(f);
        if (!input_more(in)) {
            return input_error(in, "FIELD: truncated");
        }
        input_word(in, word, sizeof word);
        if (!read_count(in, &width) || !read_count(in, &count) || !read_type(in, &type)) {
            return false;
        }
        end_line(f);
        for (int64_t i = 0; i < width * count; i++) {
            if (!read_number(f, type, &ignored)) {
                return input_error(in, "FIELD: truncated, or not a number");
            }
        }
    }
    return true;
}

/* Skips lines up to one that is empty. */
static void skip_metadata(input *in) {
    while (input_next_line(in) && input_more_in_line(in)) {
    }
}

static bool read_header(vtk *f) {
    input *in = f->b->in;
    char word[32];
    if (in->end - in->at < 22 || memcmp(in->at, "# vtk DataFile Version", 22) != 0) {
        return input_error(in, "not a VTK file: does not begin with '# vtk DataFile Version'");
    }
    (void)input_next_line(in); /* the title */
    (void)input_next_line(in);
    read_keyword(in, word);
    f->ascii = strcmp(word, "ASCII") == 0;
    if (!f->ascii && strcmp(word, "BINARY") != 0) {
        return input_error(in, "'%s' is neither ASCII nor BINARY", word);
    }
    if (input_more(in)) {
        read_keyword(in, word);
    }
    if (!input_more(in) || strcmp(word, "DATASET") != 0) {
        return input_error(in, "DATASET expected");
    }
    read_keyword(in, word);
    f->is_grid = strcmp(word, "UNSTRUCTURED_GRID") == 0;
    return f->is_grid || strcmp(word, "POLYDATA") == 0 ||
           input_error(in, "DATASET %s is not supported, only POLYDATA and UNSTRUCTURED_GRID",
                       word);
}

/* Is the word a section of cells in this kind of file? */
static bool is_cell_section(const vtk *f, const char *word) {
    static const char *const sections[4] = {"POLYGONS", "TRIANGLE_STRIPS", "VERTICES", "LINES"};
    bool found = f->is_grid && strcmp(word, "CELLS") == 0;
    for (int k = 0; k < 4 && !f->is_grid; k++) {
        found = found || strcmp(word, sections[k]) == 0;
    }
    return found;
}

static bool read_sections(vtk *f) {
    input *in = f->b->in;
    bool ok = true, is_data = false;
    while (ok && !is_data && input_more(in)) {
        char word[32];
        read_keyword(in, word);
        is_data = strcmp(word, "POINT_DATA") == 0 || strcmp(word, "CELL_DATA") == 0;
        f->has_data = is_data;
        if (strcmp(word, "POINTS") == 0) {
            ok = read_points(f);
        } else if (is_cell_section(f, word)) {
            ok = read_cells(f, word);
        } else if (f->is_grid && strcmp(word, "CELL_TYPES") == 0) {
            ok = read_cell_types(f);
        } else if (strcmp(word, "FIELD") == 0) {
            ok = skip_field(f);
        } else if (strcmp(word, "METADATA") == 0) {
            skip_metadata(in);
        } else if (!is_data) {
            ok = input_error(in, "'%s' is not a section of %s", word,
                             f->is_grid ? "an unstructured grid" : "polygonal data");
        }
    }
    return ok;
}

bool mesh_read_vtk(mesh_build *b) {
    vtk f;
    memset(&f, 0, sizeof f);
    f.b = b;
    bool ok = read_header(&f) && read_sections(&f);
    ok = ok && (f.has_points || input_error(b->in, "there are no POINTS"));
    if (ok && f.is_grid) {
        ok = mesh_build_is_in_range(b) && vtk_grid_add_faces(b, &f.grid);
    }
    if (ok && f.others > 0) {
        mesh_build_note(b, "%lld cells are points or lines, and ignored", (long long)f.others);
    }
    if (ok && f.has_data) {
        mesh_build_leave(b, "data at points and cells");
    }
    if (ok && f.has_data && (f.others > 0 || f.is_grid)) {
        mesh_build_note(b, "data at points and cells are not read");
    }
    vtk_grid_free(&f.grid);
    return ok;
}

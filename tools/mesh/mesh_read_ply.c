/* mesh_read_ply.c: reads the vertices and faces of an ASCII or binary PLY file */
#include <string.h>

#include "mesh_build.h"
#include "tools/io/scalar.h"

#define PLY_MAX_ELEMENTS 32
#define PLY_MAX_PROPERTIES 256

/* Names of the scalar types. */
static const char *const type_names[2][8] = {
    {"char", "uchar", "short", "ushort", "int", "uint", "float", "double"},
    {"int8", "uint8", "int16", "uint16", "int32", "uint32", "float32", "float64"},
};
static const scalar_type types[8] = {SCALAR_INT8,  SCALAR_UINT8,  SCALAR_INT16, SCALAR_UINT16,
                                     SCALAR_INT32, SCALAR_UINT32, SCALAR_FLOAT, SCALAR_DOUBLE};

/* The role of a property in the mesh; 0, 1, 2 are the coordinates x, y, z. A strip is a list of
 * corners in which -1 begins a new strip. */
enum { ROLE_NONE = -1, ROLE_CORNERS = 3, ROLE_STRIP = 4 };

typedef struct ply_property {
    bool list;
    scalar_type count_type; /* of a list's count */
    scalar_type type;
    int role;
} ply_property;

typedef struct ply_element {
    char name[16]; /* truncated: used to find "vertex" and "face", and in messages */
    int64_t count;
    int first; /* its properties are first .. past-1 */
    int past;
} ply_element;

typedef struct ply {
    mesh_build *b;
    bool ascii;
    bool big_endian;
    /* of text: each row of an element has a line of its own, or more; so that values beyond those
     * that the header declares can be told from the next row */
    bool row_is_line;
    bool row_is_one_line; /* no row has more than one */
    int64_t longer_rows;  /* with such values */
    int n_elements;
    int n_properties;
    ply_element elements[PLY_MAX_ELEMENTS];
    ply_property properties[PLY_MAX_PROPERTIES];
} ply;

static bool read_type(input *in, scalar_type *type) {
    char word[16];
    input_word(in, word, sizeof word);
    for (int k = 0; k < 8; k++) {
        if (strcmp(word, type_names[0][k]) == 0 || strcmp(word, type_names[1][k]) == 0) {
            *type = types[k];
            return true;
        }
    }
    return input_error(in, "'%s' is not a PLY type", word);
}

static bool read_format(ply *f) {
    input *in = f->b->in;
    char word[24];
    input_word(in, word, sizeof word);
    f->ascii = strcmp(word, "ascii") == 0;
    f->big_endian = strcmp(word, "binary_big_endian") == 0;
    if (!f->ascii && !f->big_endian && strcmp(word, "binary_little_endian") != 0) {
        return input_error(in, "'%s' is not a PLY format", word);
    }
    return true;
}

static bool read_element(ply *f) {
    input *in = f->b->in;
    if (f->n_elements == PLY_MAX_ELEMENTS) {
        return input_error(in, "more than %d elements", PLY_MAX_ELEMENTS);
    }
    ply_element *e = &f->elements[f->n_elements++];
    input_word(in, e->name, sizeof e->name);
    e->first = f->n_properties;
    e->past = f->n_properties;
    if (!input_integer(in, &e->count) || !input_at_word_end(in) || e->count < 0) {
        return input_error(in, "element %s has no count", e->name);
    }
    return true;
}

static int role_of(const char *element, const char *property, bool list) {
    if (list) {
        bool corners =
            strcmp(property, "vertex_indices") == 0 || strcmp(property, "vertex_index") == 0;
        return !corners                            ? ROLE_NONE
               : strcmp(element, "face") == 0      ? ROLE_CORNERS
               : strcmp(element, "tristrips") == 0 ? ROLE_STRIP
                                                   : ROLE_NONE;
    }
    bool coordinate = property[0] >= 'x' && property[0] <= 'z' && property[1] == '\0';
    return coordinate && strcmp(element, "vertex") == 0 ? property[0] - 'x' : ROLE_NONE;
}

static bool read_property(ply *f) {
    input *in = f->b->in;
    if (f->n_elements == 0) {
        return input_error(in, "a property before the first element");
    }
    if (f->n_properties == PLY_MAX_PROPERTIES) {
        return input_error(in, "more than %d properties", PLY_MAX_PROPERTIES);
    }
    ply_element *e = &f->elements[f->n_elements - 1];
    ply_property *p = &f->properties[f->n_properties++];
    e->past = f->n_properties;
    p->count_type = SCALAR_UINT8;
    p->list = input_more_in_line(in) && strncmp(in->at, "list", 4) == 0;
    char word[24];
    if (p->list) {
        input_word(in, word, sizeof word);
        if (!read_type(in, &p->count_type)) {
            return false;
        }
    }
    if (!read_type(in, &p->type)) {
        return false;
    }
    input_word(in, word, sizeof word);
    p->role = role_of(e->name, word, p->list);
    return true;
}

/* Returns whether the element has each of the roles first .. last exactly once. */
static bool has_roles(const ply *f, const ply_element *e, int first, int last) {
    for (int role = first; role <= last; role++) {
        int times = 0;
        for (int k = e->first; k < e->past; k++) {
            times += f->properties[k].role == role;
        }
        if (times != 1) {
            return false;
        }
    }
    return true;
}

static bool check_header(const ply *f) {
    bool vertices = false;
    for (int k = 0; k < f->n_elements; k++) {
        const ply_element *e = &f->elements[k];
        bool vertex = strcmp(e->name, "vertex") == 0;
        if (vertex && !has_roles(f, e, 0, 2)) {
            return input_error(f->b->in, "element vertex must have x, y and z, each once");
        }
        if (strcmp(e->name, "face") == 0 && e->count > 0 &&
            !has_roles(f, e, ROLE_CORNERS, ROLE_CORNERS)) {
            return input_error(f->b->in, "element face must have one list vertex_indices");
        }
        const bool strips = strcmp(e->name, "tristrips") == 0;
        if (strips && e->count > 0 && !has_roles(f, e, ROLE_STRIP, ROLE_STRIP)) {
            return input_error(f->b->in, "element tristrips must have one list vertex_indices");
        }
        vertices = vertices || vertex;
    }
    return vertices || input_error(f->b->in, "not a mesh: there is no element vertex");
}

/* Leaves in->at at the first byte of the data. */
static bool read_header(ply *f) {
    input *in = f->b->in;
    char word[16];
    input_word(in, word, sizeof word);
    if (strcmp(word, "ply") != 0) {
        return input_error(in, "not a PLY mesh: does not begin with ply");
    }
    /* if lines end in a single \r, a \n after the last header line is already data */
    bool single_return = *in->at == '\r' && in->at[1] != '\n';
    bool formatted = false;
    while (input_next_line(in)) {
        input_word(in, word, sizeof word);
        bool ok = true;
        if (strcmp(word, "format") == 0) {
            ok = read_format(f);
            formatted = true;
        } else if (strcmp(word, "element") == 0) {
            ok = read_element(f);
        } else if (strcmp(word, "property") == 0) {
            ok = read_property(f);
        } else if (strcmp(word, "end_header") == 0) {
            if (single_return && *in->at == '\r') {
                in->at++;
            } else {
                (void)input_next_line(in);
            }
            return formatted ? check_header(f) : input_error(in, "the header has no format");
        } else if (word[0] != '\0' && strcmp(word, "comment") != 0 &&
                   strcmp(word, "obj_info") != 0) {
            ok = input_error(in, "'%s' is not a PLY header keyword", word);
        }
        if (!ok) {
            return false;
        }
    }
    return input_error(in, "truncated in the header");
}

static bool read_scalar(ply *f, scalar_type type, double *x) {
    return scalar_read(f->b->in, f->ascii, type, f->big_endian, x);
}

/* Ends a strip of triangles; one of fewer than three corners has none. */
static bool end_strip(mesh_build *b) {
    if (b->n_corners < 3) {
        b->n_corners = 0;
        return true;
    }
    return mesh_build_strip(b);
}

/* Adds a corner to the current polygon or strip; -1 ends a strip. */
static bool add_corner(ply *f, int role, double x, const char *element, int64_t number) {
    if (role == ROLE_STRIP && x == -1) {
        return end_strip(f->b);
    }
    if (!scalar_is_index(x)) {
        return input_error(f->b->in, "%s %lld: %g is not a vertex index", element,
                           (long long)number, x);
    }
    return mesh_build_corner(f->b, (int64_t)x);
}

/* Reads one property: coordinates into xyz, corners into the current polygon; others are
 * skipped. */
static bool read_value(ply *f, const ply_property *p, const char *element, int64_t number,
                       double xyz[3]) {
    input *in = f->b->in;
    double x = 0;
    double count = 1;
    if (p->list && (!read_scalar(f, p->count_type, &count) || !scalar_is_index(count))) {
        return input_error(in, "%s %lld: truncated, or a list has no valid count", element,
                           (long long)number);
    }
    for (int64_t k = 0; k < (int64_t)count; k++) {
        if (!read_scalar(f, p->type, &x)) {
            return input_error(in, "%s %lld: truncated, or not a number", element,
                               (long long)number);
        }
        if (p->role >= ROLE_CORNERS) {
            if (!add_corner(f, p->role, x, element, number)) {
                return false;
            }
        } else if (p->role != ROLE_NONE) {
            xyz[p->role] = x;
        }
    }
    return true;
}

/* Counts the lines that are not blank from the cursor on, up to `most`. */
static int64_t count_lines(const input *in, int64_t most) {
    input rest = *in;
    int64_t count = 0;
    while (count < most && input_more(&rest)) {
        count++;
        (void)input_next_line(&rest);
    }
    return count;
}

/* Decides how rows of text are separated: by lines, or not at all if there are fewer lines. */
static void find_rows(ply *f) {
    int64_t rows = 0;
    for (int k = 0; k < f->n_elements; k++) {
        const ply_element *e = &f->elements[k];
        rows += e->past > e->first && e->count < INT64_MAX / PLY_MAX_ELEMENTS - 1 ? e->count : 0;
    }
    int64_t lines = count_lines(f->b->in, rows + 1);
    f->row_is_line = lines >= rows;
    f->row_is_one_line = lines == rows;
}

/* Ends a row of text that began in line `first`: skips values that the header does not declare. */
static bool end_row(ply *f, const ply_element *e, int64_t number, int64_t first) {
    input *in = f->b->in;
    const int64_t last = in->line;
    const bool longer = input_more_in_line(in);
    if (last > first && (longer || f->row_is_one_line)) {
        in->line = first;
        return input_error(in, "%s %lld: fewer values in its line than the header declares",
                           e->name, (long long)number);
    }
    f->longer_rows += longer;
    if (f->longer_rows == 1 && longer) {
        mesh_build_note(f->b,
                        "line %lld: %s %lld has more values than the header declares; such "
                        "values are ignored",
                        (long long)last, e->name, (long long)number);
    }
    (void)input_next_line(in);
    return true;
}

static bool read_instances(ply *f, const ply_element *e) {
    input *in = f->b->in;
    bool vertex = strcmp(e->name, "vertex") == 0;
    bool face = strcmp(e->name, "face") == 0;
    bool strips = strcmp(e->name, "tristrips") == 0;
    const int others = e->past - e->first - (vertex ? 3 : 1);
    if ((vertex || face) && others > 0) {
        mesh_build_leave(f->b, "%d more values of each %s", others, e->name);
    }
    if (!vertex && !face && !strips && e->count > 0) {
        mesh_build_note(f->b, "element %s is ignored, %lld rows", e->name, (long long)e->count);
    }
    /* without properties there is nothing to read, whatever count the header claims */
    int64_t count = e->past > e->first ? e->count : 0;
    for (int64_t number = 0; number < count; number++) {
        double xyz[3] = {0, 0, 0};
        if (f->row_is_line) {
            (void)input_more(in);
        }
        const int64_t line = in->line;
        for (int k = e->first; k < e->past; k++) {
            if (!read_value(f, &f->properties[k], e->name, number, xyz)) {
                return false;
            }
        }
        if (vertex && !mesh_build_vertex(f->b, xyz[0], xyz[1], xyz[2])) {
            return false;
        }
        if ((face && !mesh_build_polygon(f->b)) || (strips && !end_strip(f->b))) {
            return false;
        }
        if (f->row_is_line && !end_row(f, e, number, line)) {
            return false;
        }
    }
    return true;
}

bool mesh_read_ply(mesh_build *b) {
    ply f;
    memset(&f, 0, sizeof f);
    f.b = b;
    if (!read_header(&f)) {
        return false;
    }
    if (f.ascii) {
        find_rows(&f);
    } else {
        b->in->line = 0;
    }
    for (int k = 0; k < f.n_elements; k++) {
        if (!read_instances(&f, &f.elements[k])) {
            return false;
        }
    }
    return true;
}

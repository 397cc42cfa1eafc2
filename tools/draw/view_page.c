/* view_page.c: the data of a page as a script: text in quotes, arrays in base64, little-endian */
#include "view_page.h"

#include <stdint.h>
#include <string.h>

#include "colors.h"
#include "tools/mesh/single_frame.h"

enum { COLORS = 256 };

/* Bytes on their way into base64, three at a time. */
typedef struct base64 {
    FILE *out;
    unsigned char held[3];
    int count;
} base64;

static void put_group(base64 *b) {
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const unsigned word = (unsigned)b->held[0] << 16 | (unsigned)b->held[1] << 8 | b->held[2];
    for (int k = 0; k < 4; k++) {
        (void)putc(k <= b->count ? digits[word >> (18 - 6 * k) & 63] : '=', b->out);
    }
    memset(b->held, 0, sizeof b->held);
    b->count = 0;
}

static void put_byte(base64 *b, unsigned char byte) {
    b->held[b->count++] = byte;
    if (b->count == 3) {
        put_group(b);
    }
}

static void put_bytes(base64 *b, uint64_t word, int bytes) {
    for (int k = 0; k < bytes; k++) {
        put_byte(b, (unsigned char)(word >> 8 * k & 255));
    }
}

static base64 begin(FILE *out) {
    base64 b = {out, {0, 0, 0}, 0};
    (void)putc('"', out);
    return b;
}

static void end(base64 *b) {
    if (b->count > 0) {
        put_group(b);
    }
    (void)putc('"', b->out);
}

/* Text between quotes. Nothing in it can end the string or the script. */
static void put_text(FILE *out, const char *text) {
    (void)putc('"', out);
    for (; *text != 0; text++) {
        const unsigned char c = (unsigned char)*text;
        if (c < 32 || c == '"' || c == '\\' || c == '<' || c == '>' || c == '&') {
            (void)fprintf(out, "\\u%04x", c);
        } else {
            (void)putc(c, out);
        }
    }
    (void)putc('"', out);
}

/* Relative to the frame of the mesh: the page shows no coordinates, only where vertices are. */
static void put_coordinates(FILE *out, const mesh *m) {
    const single_frame frame = single_frame_of(m);
    base64 b = begin(out);
    for (size_t k = 0; k < 3 * (size_t)m->n_vertices; k++) {
        const float x = single_frame_coordinate(&frame, m, k);
        uint32_t word;
        memcpy(&word, &x, sizeof word);
        put_bytes(&b, word, 4);
    }
    end(&b);
}

static void put_faces(FILE *out, const mesh *m) {
    base64 b = begin(out);
    for (size_t k = 0; k < 3 * (size_t)m->n_faces; k++) {
        put_bytes(&b, (uint32_t)m->faces[k], 4);
    }
    end(&b);
}

static void put_colors(FILE *out) {
    base64 b = begin(out);
    for (int k = 0; k < COLORS; k++) {
        const rgb c = color_map(k / (COLORS - 1.0));
        put_byte(&b, c.r);
        put_byte(&b, c.g);
        put_byte(&b, c.b);
    }
    end(&b);
}

static void put_values(FILE *out, const double *value, size_t count) {
    base64 b = begin(out);
    for (size_t k = 0; k < count; k++) {
        uint64_t word;
        memcpy(&word, value + k, sizeof word);
        put_bytes(&b, word, 8);
    }
    end(&b);
}

/* What live pages solve with. Faces are those of the page, or others. */
static void put_live(FILE *out, const view_live *live, const mesh *m) {
    (void)fprintf(out, ",\nlive: {time: %.17g, share: %.17g, faces: ", live->t, live->share);
    if (live->surface != m) {
        put_faces(out, live->surface);
    } else {
        (void)fputs("null", out);
    }
    (void)fputs(",\nlengths: ", out);
    put_values(out, live->lengths, 3 * (size_t)live->surface->n_faces);
    (void)fputs(",\nkernel: \"", out);
    for (const char *const *line = view_live_kernel; *line != NULL; line++) {
        (void)fputs(*line, out);
    }
    (void)fputs("\"}", out);
}

static void put_script(FILE *out) {
    (void)fprintf(out, "<script type=\"module\">\n");
    for (const char *const *line = view_live_script; *line != NULL; line++) {
        (void)fprintf(out, "%s\n", *line);
    }
    (void)fprintf(out, "</script>\n");
}

static void put_data(FILE *out, const view_page *page) {
    (void)fprintf(out, "const data = {title: ");
    put_text(out, page->title);
    for (int k = 0; k < 9; k++) {
        (void)fprintf(out, "%s%.9g", k == 0 ? ",\naxes: [" : ", ", page->axes[k / 3][k % 3]);
    }
    (void)fprintf(out, "],\nmarked: [");
    for (sl_int k = 0; k < page->n_marked; k++) {
        (void)fprintf(out, "%s%d", k > 0 ? ", " : "", (int)page->marked[k]);
    }
    (void)fprintf(out, "],\npositions: ");
    put_coordinates(out, page->m);
    (void)fprintf(out, ",\nfaces: ");
    put_faces(out, page->m);
    (void)fprintf(out, ",\ncolors: ");
    put_colors(out);
    (void)fprintf(out, ",\nfields: [");
    for (size_t k = 0; k < page->n_fields; k++) {
        (void)fprintf(out, "%s\n{name: ", k > 0 ? "," : "");
        put_text(out, page->fields[k].name);
        (void)fprintf(out, ", values: ");
        put_values(out, page->fields[k].value, (size_t)page->m->n_vertices);
        (void)putc('}', out);
    }
    (void)fputc(']', out);
    if (page->live != NULL) {
        put_live(out, page->live, page->m);
    }
    (void)fprintf(out, "};\n");
}

void view_page_write(FILE *out, const view_page *page) {
    for (const char *const *line = view_page_text; *line != NULL; line++) {
        if (strcmp(*line, VIEW_PAGE_DATA) == 0) {
            put_data(out, page);
        } else if (strcmp(*line, VIEW_PAGE_LIVE) == 0) {
            if (page->live != NULL) {
                put_script(out);
            }
        } else {
            (void)fprintf(out, "%s\n", *line);
        }
    }
}

/* legend.c: legends of pictures: a color bar with ticks, or keys; a title; in its own font */
#include "legend.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

enum { GLYPH_COLUMNS = 5, GLYPH_ROWS = 7, ADVANCE = 6, LINE = 10, LINE_CHARACTERS = 13 };

static const char characters[] = "0123456789abcdefghijklmnopqrstuvwxyz.-+=,()";

/* Rows from top to bottom, the leftmost pixel in bit 4. */
static const unsigned char glyphs[][GLYPH_ROWS] = {
    {0x0e, 0x11, 0x13, 0x15, 0x19, 0x11, 0x0e}, {0x04, 0x0c, 0x04, 0x04, 0x04, 0x04, 0x0e},
    {0x0e, 0x11, 0x01, 0x02, 0x04, 0x08, 0x1f}, {0x1f, 0x02, 0x04, 0x02, 0x01, 0x11, 0x0e},
    {0x02, 0x06, 0x0a, 0x12, 0x1f, 0x02, 0x02}, {0x1f, 0x10, 0x1e, 0x01, 0x01, 0x11, 0x0e},
    {0x06, 0x08, 0x10, 0x1e, 0x11, 0x11, 0x0e}, {0x1f, 0x01, 0x02, 0x04, 0x08, 0x08, 0x08},
    {0x0e, 0x11, 0x11, 0x0e, 0x11, 0x11, 0x0e}, {0x0e, 0x11, 0x11, 0x0f, 0x01, 0x02, 0x0c},
    {0x00, 0x00, 0x0e, 0x01, 0x0f, 0x11, 0x0f}, {0x10, 0x10, 0x16, 0x19, 0x11, 0x11, 0x1e},
    {0x00, 0x00, 0x0e, 0x10, 0x10, 0x11, 0x0e}, {0x01, 0x01, 0x0d, 0x13, 0x11, 0x11, 0x0f},
    {0x00, 0x00, 0x0e, 0x11, 0x1f, 0x10, 0x0e}, {0x06, 0x09, 0x08, 0x1c, 0x08, 0x08, 0x08},
    {0x00, 0x0f, 0x11, 0x11, 0x0f, 0x01, 0x0e}, {0x10, 0x10, 0x16, 0x19, 0x11, 0x11, 0x11},
    {0x04, 0x00, 0x0c, 0x04, 0x04, 0x04, 0x0e}, {0x02, 0x00, 0x06, 0x02, 0x02, 0x12, 0x0c},
    {0x10, 0x10, 0x12, 0x14, 0x18, 0x14, 0x12}, {0x0c, 0x04, 0x04, 0x04, 0x04, 0x04, 0x0e},
    {0x00, 0x00, 0x1a, 0x15, 0x15, 0x11, 0x11}, {0x00, 0x00, 0x16, 0x19, 0x11, 0x11, 0x11},
    {0x00, 0x00, 0x0e, 0x11, 0x11, 0x11, 0x0e}, {0x00, 0x00, 0x1e, 0x11, 0x1e, 0x10, 0x10},
    {0x00, 0x00, 0x0d, 0x13, 0x0f, 0x01, 0x01}, {0x00, 0x00, 0x16, 0x19, 0x10, 0x10, 0x10},
    {0x00, 0x00, 0x0e, 0x10, 0x0e, 0x01, 0x1e}, {0x08, 0x08, 0x1c, 0x08, 0x08, 0x09, 0x06},
    {0x00, 0x00, 0x11, 0x11, 0x11, 0x13, 0x0d}, {0x00, 0x00, 0x11, 0x11, 0x11, 0x0a, 0x04},
    {0x00, 0x00, 0x11, 0x11, 0x15, 0x15, 0x0a}, {0x00, 0x00, 0x11, 0x0a, 0x04, 0x0a, 0x11},
    {0x00, 0x00, 0x11, 0x11, 0x0f, 0x01, 0x0e}, {0x00, 0x00, 0x1f, 0x02, 0x04, 0x08, 0x1f},
    {0x00, 0x00, 0x00, 0x00, 0x00, 0x0c, 0x0c}, {0x00, 0x00, 0x00, 0x1f, 0x00, 0x00, 0x00},
    {0x00, 0x04, 0x04, 0x1f, 0x04, 0x04, 0x00}, {0x00, 0x00, 0x1f, 0x00, 0x1f, 0x00, 0x00},
    {0x00, 0x00, 0x00, 0x00, 0x0c, 0x04, 0x08}, {0x02, 0x04, 0x08, 0x08, 0x08, 0x04, 0x02},
    {0x08, 0x04, 0x02, 0x02, 0x02, 0x04, 0x08}};

static const rgb ink = {0x28, 0x28, 0x28};

static void fill(picture *p, int x, int y, int width, int height, rgb color) {
    for (int j = y < 0 ? 0 : y; j < y + height && j < p->height; j++) {
        for (int i = x < 0 ? 0 : x; i < x + width && i < p->width; i++) {
            p->at[(size_t)j * (size_t)p->width + (size_t)i] = color;
        }
    }
}

static bool has_dot(const unsigned char *glyph, int row, int column) {
    return row < GLYPH_ROWS && column >= 0 && column < GLYPH_COLUMNS &&
           (glyph[row] >> (GLYPH_COLUMNS - 1 - column) & 1) != 0;
}

/* Draws a glyph with strokes between neighboring dots; diagonal ones where these have no other
 * neighbor in common. */
static void draw_glyph(picture *p, int x, int y, int scale, const unsigned char *glyph) {
    static const int to[4][2] = {{0, 1}, {1, 0}, {1, 1}, {1, -1}}; /* rows, columns */
    for (int k = 0; k < GLYPH_ROWS * GLYPH_COLUMNS; k++) {
        const int row = k / GLYPH_COLUMNS, column = k % GLYPH_COLUMNS;
        const double px = x + (column + 0.5) * scale, py = y + (row + 0.5) * scale;
        if (!has_dot(glyph, row, column)) {
            continue;
        }
        picture_stroke(p, px, py, px, py, scale, ink);
        for (int n = 0; n < 4; n++) {
            const int down = to[n][0], right = to[n][1];
            bool cut = n >= 2 &&
                       (has_dot(glyph, row, column + right) || has_dot(glyph, row + down, column));
            if (!cut && has_dot(glyph, row + down, column + right)) {
                picture_stroke(p, px, py, px + right * scale, py + down * scale, scale, ink);
            }
        }
    }
}

void legend_text(picture *p, int x, int y, int scale, const char *text) {
    for (; *text != '\0'; text++, x += ADVANCE * scale) {
        const char *found = strchr(characters, tolower((unsigned char)*text));
        if (found != NULL) {
            draw_glyph(p, x, y, scale, glyphs[found - characters]);
        }
    }
}

/* Twice the size of the font at 600 rows; grows with the picture. */
static int font_scale(int width, int height) {
    int scale = height / 300 < width / 400 ? height / 300 : width / 400;
    return scale < 1 ? 1 : scale;
}

int legend_width(int width, int height) {
    return width < 320 || height < 200 ? 0 : LINE_CHARACTERS * ADVANCE * font_scale(width, height);
}

/* Where a legend is in its picture. */
typedef struct place {
    int left, scale; /* pixels; pixels of a dot of the font */
} place;

static place place_of(const picture *p, int of_size) {
    const int width = p->width / of_size, height = p->height / of_size;
    const place at = {p->width - of_size * legend_width(width, height),
                      of_size * font_scale(width, height)};
    return at;
}

/* Draws lines of at most `most` characters; returns the y below them. */
static int draw_lines(picture *p, int x, int y, int scale, const char *text, size_t most) {
    while (*text != '\0') {
        char line[LINE_CHARACTERS + 1];
        size_t length = strcspn(text, "\n"), shown = length < most ? length : most;
        memcpy(line, text, shown);
        line[shown] = '\0';
        legend_text(p, x, y, scale, line);
        y += LINE * scale;
        text += length + (text[length] == '\n');
    }
    return y;
}

void legend_draw_keys(picture *p, int of_size, const char *title, const legend_key *keys,
                      int n_keys) {
    const place at = place_of(p, of_size);
    const int scale = at.scale;
    int y = draw_lines(p, at.left, LINE * scale, scale, title, LINE_CHARACTERS - 1) + LINE * scale;
    for (int k = 0; k < n_keys && y + 3 * LINE * scale <= p->height; k++) {
        fill(p, at.left, y - scale / 2, 9 * scale, 8 * scale, ink);
        fill(p, at.left + scale, y + scale / 2, 7 * scale, 6 * scale, keys[k].color);
        y = draw_lines(p, at.left + 2 * ADVANCE * scale, y, scale, keys[k].text,
                       LINE_CHARACTERS - 3);
        y += LINE / 2 * scale;
    }
}

void legend_draw(picture *p, int of_size, const char *title, double low, double high,
                 int isolines) {
    const place at_right = place_of(p, of_size);
    const int left = at_right.left, scale = at_right.scale;
    const int y = draw_lines(p, left, LINE * scale, scale, title, LINE_CHARACTERS - 1);
    const int top = y + LINE * scale, bottom = p->height - 2 * LINE * scale, bar = 10 * scale;
    for (int j = top; j < bottom; j++) {
        double t = (double)(bottom - 1 - j) / (double)(bottom - 1 - top);
        fill(p, left, j, bar, 1, color_map(t));
    }
    for (int k = 1; k <= isolines && isolines < 60; k++) {
        double t = (double)k / (double)(isolines + 1);
        fill(p, left, bottom - 1 - (int)(t * (bottom - 1 - top)), bar, scale > 1 ? scale / 2 : 1,
             ink);
    }
    for (int k = 0; k < 5; k++) {
        char number[32];
        double t = 0.25 * (double)k;
        int at = bottom - 1 - (int)(t * (bottom - 1 - top));
        (void)snprintf(number, sizeof number, "%.3g", low + t * (high - low));
        fill(p, left + bar, at - scale / 2, 3 * scale, scale, ink);
        legend_text(p, left + bar + 6 * scale, at - GLYPH_ROWS * scale / 2, scale, number);
    }
}

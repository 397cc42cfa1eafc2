/* deform_output.c: what the command deform prints, draws and writes */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "deform.h"

/* The mesh in its present shape; release with free(m.xyz). */
static mesh deformed(const deform_command *cmd) {
    mesh m = cmd->m;
    size_t n = (size_t)m.n_vertices;
    m.xyz = app_alloc(3 * n, sizeof *m.xyz);
    for (size_t k = 0; k < 3 * n; k++) {
        m.xyz[k] = cmd->d.Y[k % 3 * n + k / 3];
    }
    return m;
}

void deform_write_shape(const deform_command *cmd, const app_output *output) {
    static const rgb moved = {0xd5, 0x2b, 0x1e}, still = {0x28, 0x50, 0xa0};
    mesh m = deformed(cmd);
    size_t n = (size_t)m.n_vertices, n_marks = (size_t)cmd->d.n_pins;
    render_mark *marks = app_alloc(n_marks, sizeof *marks);
    double *displacement = app_alloc(n, sizeof *displacement);
    for (size_t v = 0; v < n; v++) {
        for (size_t c = 0; c < 3; c++) {
            displacement[v] = hypot(displacement[v], m.xyz[3 * v + c] - cmd->m.xyz[3 * v + c]);
        }
    }
    int n_moved = 0;
    for (size_t k = 0; k < n_marks; k++) {
        const sl_int v = cmd->d.held[k];
        const bool has_moved = displacement[v] > 1e-6 * cmd->d.diameter;
        marks[k].vertex = v;
        marks[k].radius = 3;
        marks[k].color = has_moved ? moved : still;
        n_moved += has_moved;
    }
    legend_key keys[2] = {{moved, ""}, {still, ""}};
    (void)snprintf(keys[0].text, sizeof keys->text, "moved\n%d", n_moved);
    (void)snprintf(keys[1].text, sizeof keys->text, "at rest\n%d", (int)n_marks - n_moved);
    const mesh_field field = {"displacement", displacement};
    const mesh_extra extra = {.fields = &field, .n_fields = 1};
    const render_style style = {.box = cmd->box,
                                .marks = marks,
                                .n_marks = (int)n_marks,
                                .legend = "vertices\nthat handles\nhold",
                                .keys = keys,
                                .n_keys = 2};
    app_write(output, &m, &extra, &style);
    free(displacement);
    free(marks);
    free(m.xyz);
}

char *deform_frame_path(const deform_command *cmd, sl_int frame) {
    size_t room = strlen(cmd->frames) + 32;
    char *path = app_alloc(room, 1);
    (void)snprintf(path, room, "%s%04d.png", cmd->frames, (int)frame);
    return path;
}

void deform_write_frame(const deform_command *cmd, sl_int frame) {
    char *path = deform_frame_path(cmd, frame);
    app_output one = cmd->output;
    one.out = NULL;
    one.png = path;
    deform_write_shape(cmd, &one);
    free(path);
}

void deform_write_csv(const deform_command *cmd) {
    size_t n = (size_t)cmd->d.n, count = cmd->at != NULL ? (size_t)cmd->n_watched : n;
    FILE *csv = app_create(cmd->output.csv);
    fprintf(csv, "vertex,x,y,z,displacement\n");
    for (size_t k = 0; k < count; k++) {
        const size_t v = cmd->at != NULL ? (size_t)cmd->watched[k] : k;
        double size = 0;
        fprintf(csv, "%d", (int)v);
        for (size_t c = 0; c < 3; c++) {
            const double x =
                cmd->at != NULL ? cmd->near_positions[c * count + k] : cmd->d.Y[c * n + v];
            size = hypot(size, x - cmd->d.rest[c * n + v]);
            fprintf(csv, ",%.17g", x);
        }
        fprintf(csv, ",%.17g\n", size);
    }
    app_close(csv);
}

void deform_print_free(const deform_command *cmd) {
    sl_int none = 0, single = 0;
    for (sl_int c = 0; c < cmd->d.n_components; c++) {
        none += cmd->d.n_held[c] == 0;
        single += cmd->d.n_held[c] == 0 && cmd->d.sizes[c] == 1;
    }
    if (none > 0) {
        printf(
            "free       %d of %d components have no handle, %d of them single vertices: they %s\n",
            (int)none, (int)cmd->d.n_components, (int)single,
            cmd->d.method == DEFORM_ARAP ? "keep their mean position" : "are at rest");
    }
}

void deform_print_summary(const deform_command *cmd) {
    const double frames = cmd->script.n_frames > 0 ? (double)cmd->script.n_frames : 1;
    if (cmd->pinned > 0 && (options_verbose || cmd->d.refused)) {
        printf("pins       %d grabbed, %.4f ms each", (int)cmd->pinned,
               cmd->total.pin / (double)cmd->pinned);
        if (cmd->released > 0) {
            printf("; %d released, %.4f ms each", (int)cmd->released,
                   cmd->total.release / (double)cmd->released);
        }
        printf("%s\n", cmd->d.refused ? " (refused: a new factor for each set of handles)"
                       : cmd->d.anew  ? "; in a factor of the other rows"
                                      : "");
    }
    printf("frames     %d", (int)cmd->script.n_frames);
    if (cmd->d.method == DEFORM_ARAP && cmd->script.n_frames > 0) {
        printf(", with %d solves, in %.3g ms each; the last has energy %.6g, and its last step "
               "moved %.1e diagonals.\n",
               cmd->total.solves, cmd->total.solve / frames, cmd->last.energy, cmd->last.moved);
    } else {
        printf(": solve %.3f ms%s.\n", cmd->total.solve / frames,
               cmd->at != NULL ? " at the wanted vertices" : "");
    }
    if (cmd->d.method == DEFORM_BIHARMONIC && !cmd->d.squared) {
        printf(
            "system     The squared system has too few digits for these faces: each set of handles "
            "has a factor of the mixed one.\n");
    }
    if (cmd->check && cmd->script.n_frames > 0) {
        printf("check      a new factor and its solve take %.3f ms per frame; positions differ by "
               "at most %.3g diameters, bound %.3g\n",
               cmd->total.fresh / frames, cmd->worst, cmd->bound);
    }
}

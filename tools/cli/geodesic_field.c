/* geodesic_field.c: the files of the command geodesic: the mesh with a field, its picture */
#include <stdlib.h>
#include <string.h>

#include "geodesic.h"

static render_mark *marks_of(const geodesic_command *cmd) {
    render_mark *marks = app_alloc((size_t)cmd->n_sources, sizeof *marks);
    const rgb red = {0xd5, 0x2b, 0x1e};
    for (sl_int k = 0; k < cmd->n_sources; k++) {
        marks[k].vertex = cmd->sources[k];
        marks[k].radius = cmd->n_sources > 20 ? 3 : 5;
        marks[k].color = red;
    }
    return marks;
}

void geodesic_write_field(const geodesic_command *cmd, const mesh_field *field, const rgb *colors,
                          const render_style *how) {
    mesh_extra extra;
    render_style style = *how;
    render_mark *marks = marks_of(cmd);
    memset(&extra, 0, sizeof extra);
    extra.fields = field;
    extra.n_fields = 1;
    extra.color = colors;
    style.marks = marks;
    style.n_marks = cmd->n_sources;
    app_write(&cmd->output, &cmd->m, &extra, &style);
    free(marks);
}

/* mesh_write_vtk.c: writes a mesh and its fields as a legacy VTK file of polygonal data, binary */
#include "mesh_sink.h"

void mesh_write_vtk(mesh_sink *s, const mesh *m, const mesh_extra *extra) {
    const size_t n = (size_t)m->n_vertices;
    sink_print(s, "# vtk DataFile Version 3.0\nsparse-local\nBINARY\nDATASET POLYDATA\n");
    sink_print(s, "POINTS %ld double\n", (long)m->n_vertices);
    for (size_t k = 0; k < 3 * n; k++) {
        sink_double(s, m->xyz[k], true);
    }
    sink_print(s, "\nPOLYGONS %ld %lld\n", (long)m->n_faces, 4 * (long long)m->n_faces);
    for (size_t k = 0; k < 3 * (size_t)m->n_faces; k++) {
        if (k % 3 == 0) {
            sink_int(s, 3, true);
        }
        sink_int(s, m->faces[k], true);
    }
    sink_print(s, "\n");
    if (extra->n_fields > 0 || extra->color != NULL || extra->uv != NULL) {
        sink_print(s, "POINT_DATA %ld\n", (long)m->n_vertices);
    }
    for (int k = 0; k < extra->n_fields; k++) {
        sink_print(s, "SCALARS %s double 1\nLOOKUP_TABLE default\n", extra->fields[k].name);
        for (size_t v = 0; v < n; v++) {
            sink_double(s, extra->fields[k].value[v], true);
        }
        sink_print(s, "\n");
    }
    if (extra->color != NULL) {
        sink_print(s, "COLOR_SCALARS color 3\n");
        for (size_t v = 0; v < n; v++) {
            sink_put(s, &extra->color[v], 3);
        }
        sink_print(s, "\n");
    }
    if (extra->uv != NULL) {
        sink_print(s, "TEXTURE_COORDINATES uv 2 double\n");
        for (size_t k = 0; k < 2 * n; k++) {
            sink_double(s, extra->uv[k], true);
        }
        sink_print(s, "\n");
    }
}

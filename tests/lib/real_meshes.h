/* each_mesh.h: runs a test over the development meshes of $SL_DATA, where there are any */
#ifndef SL_TEST_EACH_MESH_H
#define SL_TEST_EACH_MESH_H

#include "test.h"

#include "../tools/dataset.h"
#include "../tools/mesh.h"

/* Calls try_one, which takes the mesh over, for each of the names; names NULL: for all that have at most so many
 * vertices. Skips the test where SL_DATA names no folder. */
static inline void each_mesh(const char *const *names, int count, sl_int most,
                             void (*try_one)(const char *name, mesh m)) {
    dataset data;
    if (!dataset_list(&data, NULL, "meshes")) {
        print_message("SL_DATA names no folder with meshes: none is tried here\n");
        skip();
    }
    for (size_t k = 0; k < data.count; k++) {
        const char *name = dataset_basename(data.paths[k]);
        bool wanted = names == NULL;
        for (int i = 0; i < count && !wanted; i++) {
            wanted = strcmp(name, names[i]) == 0;
        }
        mesh m;
        if (wanted) {
            assert_true(mesh_read(&m, data.paths[k], NULL, 0));
            if (m.n_vertices <= most) {
                try_one(name, m);
            } else {
                mesh_free(&m);
            }
        }
    }
    dataset_free(&data);
}

#endif

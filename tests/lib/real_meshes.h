/* real_meshes.h: runs a test on the meshes in $SL_DATA */
#ifndef SL_TEST_REAL_MESHES_H
#define SL_TEST_REAL_MESHES_H

#include "test.h"

#include "tools/io/dataset.h"
#include "tools/mesh/mesh.h"

/* Calls try_one, which takes ownership of the mesh, for each mesh of at most `most` vertices whose
 * file name is in names (NULL: for all). Skips the test if SL_DATA has no meshes. */
static inline void each_mesh(const char *const *names, int count, sl_int most,
                             void (*try_one)(const char *name, mesh m)) {
    dataset data;
    if (!dataset_list(&data, NULL, "meshes")) {
        TEST_SKIP("SL_DATA has no folder meshes");
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

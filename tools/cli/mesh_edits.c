/* mesh_edits.c: a mesh whose edges are flipped, split and collapsed; a factor of M + t L follows */
#include "mesh_edits.h"

#include <stdlib.h>
#include <string.h>

#include "app.h"
#include "solve_accuracy.h"
#include "tools/geometry/laplacian.h"

/* A place is looked for this many times. */
enum { TRIES = 200 };

static sl_matrix *assemble(const mesh_edits *e) {
    sl_matrix *A = NULL;
    if (!mesh_faces_are_in_range(&e->mesh.faces.m)) {
        app_die("edit: an edit has left a face without a vertex");
    }
    if (!laplacian_system(&A, &e->mesh.faces.m, e->t)) {
        app_die("edit: out of memory for the matrix of %d vertices",
                (int)e->mesh.faces.m.n_vertices);
    }
    return A;
}

void mesh_edits_create(mesh_edits *out, const mesh *m, double t, sl_int patch, uint64_t seed) {
    memset(out, 0, sizeof *out);
    out->t = t;
    out->patch = patch;
    out->random = seed;
    if (!remesh_create(&out->mesh, m)) {
        app_die("edit: out of memory for a copy of the mesh");
    }
    out->A = assemble(out);
    const sl_csc A = sl_matrix_view(out->A);
    const accuracy_faces faces = accuracy_of_faces(m, NULL);
    accuracy_warn(&faces, NULL, &A);
    app_must(sl_work_create(&out->W, NULL), "workspace", NULL);
    app_must(sl_symbolic_create(&out->S, &A, NULL, &out->stats), "analysis", &out->stats);
    app_must(sl_factor_create(&out->F, out->S, &A, NULL, &out->stats), "factorization",
             &out->stats);
}

void mesh_edits_free(mesh_edits *e) {
    remesh_free(&e->mesh);
    sl_matrix_free(e->A);
    sl_matrix_free(e->B);
    free(e->new_of);
    sl_factor_free(e->F);
    sl_symbolic_free(e->S);
    sl_work_free(e->W);
    memset(e, 0, sizeof *e);
}

static bool edit_patch(mesh_edits *e) {
    const sl_int n = e->mesh.faces.m.n_vertices;
    sl_int *patch = app_alloc((size_t)n, sizeof *patch);
    unsigned char *seen = app_alloc((size_t)n, 1);
    memset(seen, 0, (size_t)n);
    const sl_int size =
        remesh_patch(&e->mesh, app_random_below(&e->random, n), e->patch, patch, seen);
    const bool is_changed = remesh_vertices(&e->mesh, patch, size, &e->random) > 0;
    free(patch);
    free(seen);
    return is_changed;
}

bool mesh_edits_edit(mesh_edits *e, edit_kind kind) {
    bool is_changed = false;
    for (int tries = 0; tries < TRIES && !is_changed && e->mesh.faces.m.n_faces > 0; tries++) {
        const sl_int side = app_random_below(&e->random, 3 * e->mesh.faces.m.n_faces);
        is_changed = kind == EDIT_FLIP       ? remesh_flip(&e->mesh, side)
                     : kind == EDIT_SPLIT    ? remesh_split(&e->mesh, side)
                     : kind == EDIT_COLLAPSE ? remesh_collapse(&e->mesh, side)
                                             : edit_patch(e);
    }
    if (is_changed) {
        e->new_of = app_alloc((size_t)e->mesh.faces.m.n_vertices, sizeof *e->new_of);
        remesh_compact(&e->mesh, e->new_of);
        e->B = assemble(e);
    }
    return is_changed;
}

edit_way mesh_edits_follow(mesh_edits *e) {
    const sl_csc A = sl_matrix_view(e->A), B = sl_matrix_view(e->B);
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    app_must(sl_symbolic_edit(&S, e->S, &A, &B, e->new_of, NULL, &e->stats), "analysis", &e->stats);
    if (e->stats.edit.is_due) {
        sl_symbolic_free(S);
        app_must(sl_symbolic_create(&S, &B, NULL, &e->stats), "analysis", &e->stats);
    }
    app_must(sl_factor_edit(&F, e->F, S, &B, e->new_of, NULL, &e->stats), "factorization",
             &e->stats);
    sl_factor_free(e->F);
    sl_symbolic_free(e->S);
    sl_matrix_free(e->A);
    free(e->new_of);
    e->A = e->B;
    e->S = S;
    e->F = F;
    e->B = NULL;
    e->new_of = NULL;
    return e->stats.edit.is_anew || e->stats.edit.is_due ? EDIT_ANEW
           : e->stats.reuse.is_anew                      ? EDIT_REFACTOR
                                                         : EDIT_KEPT;
}

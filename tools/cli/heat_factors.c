/* heat_factors.c: the two factors of the heat method, of a mesh or of files of sparse-local save */
#include "heat_factors.h"

#include "laplacian_choice.h"
#include "saved_file.h"

void heat_factors_create(heat_solver *s, intrinsic *surface, const mesh *m, const char *laplacian,
                         double t, const sl_options *opt) {
    app_stage("factoring heat and Laplacian");
    app_must(laplacian_choose(surface, m, laplacian)
                 ? heat_solver_create_intrinsic(s, surface, t, opt)
                 : heat_solver_create(s, m, t, opt),
             "factors of heat and Laplacian", NULL);
    app_progress_end();
}

void heat_factors_find_time(heat_solver *s, double first, double squared_edge,
                            const sl_int *sources, sl_int count, const heat_options *heat) {
    sl_int before = 0;
    double scaled = first;
    for (;; scaled *= 2) {
        heat_field f;
        app_must(heat_distance(&f, s, sources, count, heat), "distances", NULL);
        sl_int negative = f.negative;
        heat_field_free(&f);
        if (negative == 0 || scaled >= HEAT_FACTORS_LAST) {
            break;
        }
        before = before == 0 ? negative : before;
        app_must(heat_solver_set_time(s, 2 * scaled * squared_edge), "factor of heat", NULL);
    }
    if (before > 0) {
        app_detail(
            "time       raised to %g squared mean edges: heat was negative at %d vertices behind "
            "obtuse faces\n",
            scaled, (int)before);
    }
}

void heat_factors_open(heat_solver *s, intrinsic *surface, const mesh *m, const char *laplacian,
                       const char *heat, const char *poisson) {
    sl_saved_set sets[2];
    saved_file_open(&sets[0], heat, SL_LOAD_CHECKED);
    saved_file_open(&sets[1], poisson, SL_LOAD_CHECKED);
    bool is_intrinsic = laplacian_choose(surface, m, laplacian);
    sl_status status =
        heat_solver_adopt(s, is_intrinsic ? &surface->m : m, is_intrinsic ? surface->lengths : NULL,
                          &sets[0], &sets[1]);
    if (status == SL_ERR_MALFORMED) {
        app_die("%s, %s: not the factors of this mesh that save --poisson writes, with the same "
                "--laplacian",
                heat, poisson);
    }
    app_must(status, heat, NULL);
    sl_saved_set_free(&sets[0]);
    sl_saved_set_free(&sets[1]);
}

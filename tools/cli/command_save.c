/* command_save.c: saves the factored diffusion operator of a mesh in a file */
#include <stdlib.h>
#include <string.h>

#include "app.h"
#include "command.h"
#include "tools/cli/heat_factors.h"
#include "tools/cli/heat_system.h"
#include "tools/geometry/laplacian.h"
#include "tools/io/scratch_memory.h"

static const options_usage usage = {"save", "MESH", 1, 1,
                                    "Factors M + t L of a mesh and saves the factor in a file."};

static const options_manual manual = {
    "M is the lumped mass and L the cotangent Laplacian. The file holds the analysis and the "
    "factor; it is replaced only once the new one is complete. Any number of processes can map it "
    "at once and share one copy in memory. With --selected adf and hks read their values from the "
    "file; with --region query answers questions within the region in a time that does not depend "
    "on the size of the mesh.\n"
    "With --poisson both factors of the heat method are saved, for geodesic --heat --poisson: M + "
    "t "
    "L in FILE of --out and L in that of --poisson. Unless a time is given, it is that of geodesic "
    "from the first vertex of a face with an area.",
    "Sizes of the files; seconds to factor, to save, and to make what goes with the factor.",
    "hills:200x200 --out hills.slf\nbunny.obj --time 1e-4 --region 100-200 --out bunny.slf\n"
    "bunny.obj --out heat.slf --poisson poisson.slf"};

/* Makes what the options ask for. region: a list of vertices, or NULL. */
static void make_inverses(sl_saved_set *set, sl_region **R, const char *region, bool selected,
                          const sl_options *opt) {
    sl_stats stats;
    if (selected) {
        app_stage("selected inverse");
        app_must(sl_selected_create(&set->selected, set->factor, NULL, SL_ALL, opt, &stats),
                 "selected inverse", &stats);
    }
    if (region != NULL) {
        sl_int count = 0;
        const sl_int n = sl_symbolic_view(set->symbolic).n;
        sl_int *vertices = app_vertices("region", region, n, 1, &count);
        app_stage("region");
        app_must(sl_region_create(R, set->factor, vertices, count, NULL, opt, &stats), "region",
                 &stats);
        set->regions = R;
        set->n_regions = 1;
        free(vertices);
    }
}

/* Both factors of the heat method, as geodesic makes them. */
static void make_pair(heat_solver *s, intrinsic *surface, const mesh *m, const heat_time *time,
                      const sl_options *opt) {
    const bool is_given = time->time > 0 || time->scaled > 0 || time->area > 0;
    const double edge = app_mean_edge_length(m);
    heat_time chosen = *time;
    if (!is_given) {
        chosen.scaled = HEAT_FACTORS_FIRST;
    }
    heat_factors_create(s, surface, m, time->laplacian, heat_time_value(&chosen, m, 0), opt);
    accuracy_warn_poisson(s->m, s->inc.lengths, surface->lengths != NULL ? surface->share : 1);
    if (!is_given) {
        const sl_int source = app_default_vertex(m);
        heat_factors_find_time(s, HEAT_FACTORS_FIRST, edge * edge, &source, 1, NULL);
    }
}

/* Writes a file and returns its megabytes. */
static double write_set(const char *path, const sl_saved_set *set) {
    size_t bytes = 0;
    app_stage("save");
    app_must(sl_save(NULL, NULL, &bytes, set, NULL), "save", NULL);
    app_must(sl_save(path, NULL, NULL, set, NULL), path, NULL);
    app_progress_end();
    return 1e-6 * (double)bytes;
}

int command_save(int argc, char **argv) {
    const char *operand = NULL, *out = NULL, *scratch = NULL, *region = NULL, *poisson = NULL;
    bool selected = false;
    heat_time time = {0, 0, 0, NULL};
    const option options[] = {{OPTION_OUTPUT, "out", &out, "FILE", "the file to write: required"},
                              {OPTION_TEXT, "scratch", &scratch, "FOLDER",
                               "keep large blocks in unnamed files of this folder, so that the "
                               "factor may exceed the memory"},
                              {OPTION_FLAG, "selected", &selected, NULL,
                               "with the selected inverse: the diagonal of the inverse and all "
                               "entries in the pattern of the factor"},
                              {OPTION_TEXT, "region", &region, "VERTICES",
                               "with a region around these vertices: 3,17,100-200"},
                              {OPTION_OUTPUT, "poisson", &poisson, "FILE",
                               "write the factor of L to this file, and make both for geodesic"},
                              HEAT_TIME_OPTIONS(&time, "otherwise S = 1, with --poisson 4 or more"),
                              APP_WELD_OPTION,
                              {OPTION_END, NULL, NULL, NULL, NULL}};
    options_read(&usage, &manual, options, argc, argv, &operand);
    mesh m;
    heat_system h;
    heat_solver pair;
    intrinsic surface;
    sl_options opt;
    memset(&opt, 0, sizeof opt);
    memset(&h, 0, sizeof h);
    memset(&pair, 0, sizeof pair);
    memset(&surface, 0, sizeof surface);
    if (scratch != NULL) {
        opt.allocator = scratch_allocator(scratch);
        void *block = opt.allocator.allocate(opt.allocator.context, SCRATCH_BLOCK);
        if (block == NULL) {
            app_die("%s: no file of %d bytes can be created there", scratch, SCRATCH_BLOCK);
        }
        opt.allocator.release(opt.allocator.context, block);
    }
    app_mesh(&m, operand, true);
    if (out == NULL) {
        app_die_usage("save: --out FILE is missing");
    }
    app_stage("factor");
    double begin = app_now();
    if (poisson != NULL) {
        make_pair(&pair, &surface, &m, &time, &opt);
    } else {
        heat_system_create(&h, &m, heat_time_value(&time, &m, 0), time.laplacian, &opt);
    }
    double factored = app_now();
    sl_saved_set set;
    sl_region *R = NULL;
    memset(&set, 0, sizeof set);
    set.symbolic = poisson != NULL ? pair.S : h.S;
    set.factor = poisson != NULL ? pair.heat : h.F;
    make_inverses(&set, &R, region, selected, &opt);
    double made = app_now();
    double megabytes = write_set(out, &set);
    printf("%s: %.2f MB, %d rows, t = %.6g; seconds: factor %.4g, save %.4g\n", out, megabytes,
           (int)m.n_vertices, poisson != NULL ? pair.t : h.t, factored - begin, app_now() - made);
    if (poisson != NULL) {
        sl_saved_set second;
        memset(&second, 0, sizeof second);
        second.symbolic = pair.poisson_S;
        second.factor = pair.poisson;
        megabytes = write_set(poisson, &second);
        printf("%s: %.2f MB, the Laplacian\n", poisson, megabytes);
    }
    if (selected || region != NULL) {
        printf("with%s%s%s: made in %.4g s\n", selected ? " the selected inverse" : "",
               selected && region != NULL ? " and" : "", region != NULL ? " a region" : "",
               made - factored);
    }
    sl_region_free(R);
    sl_selected_free(set.selected);
    heat_system_free(&h);
    heat_solver_free(&pair);
    intrinsic_free(&surface);
    mesh_free(&m);
    return 0;
}

/* command_save.c: saves the factored diffusion operator of a mesh in a file */
#include <stdlib.h>
#include <string.h>

#include "app.h"
#include "command.h"
#include "tools/cli/heat_system.h"
#include "tools/io/scratch_memory.h"

static const options_usage usage = {"save", "MESH", 1, 1,
                                    "Factors M + t L of a mesh and saves the factor in a file."};

static const options_manual manual = {
    "M is the lumped mass and L the cotangent Laplacian. The file holds the analysis and the "
    "factor; it is replaced only once the new one is complete. Any number of processes can map it "
    "at once and share one copy in memory. With --selected adf and hks read their values from the "
    "file; with --region query answers questions within the region in a time that does not depend "
    "on the size of the mesh.",
    "Size of the file; seconds to factor, to save, and to make what goes with the factor.",
    "hills:200x200 --out hills.slf\nbunny.obj --time 1e-4 --region 100-200 --out bunny.slf"};

/* Makes what the options ask for. region: a list of vertices, or NULL. */
static void make_inverses(sl_saved_set *set, sl_region **R, const char *region, bool selected,
                          const sl_options *opt) {
    sl_stats stats;
    if (selected) {
        app_stage("selected inverse");
        app_must(sl_selected_create(&set->selected, set->factor, NULL, 0, opt, &stats),
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

int command_save(int argc, char **argv) {
    const char *operand = NULL, *out = NULL, *scratch = NULL, *region = NULL;
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
                              HEAT_TIME_OPTIONS(&time, "otherwise S = 1"),
                              {OPTION_END, NULL, NULL, NULL, NULL}};
    options_read(&usage, &manual, options, argc, argv, &operand);
    mesh m;
    heat_system h;
    sl_options opt;
    size_t bytes = 0;
    memset(&opt, 0, sizeof opt);
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
    heat_system_create(&h, &m, heat_time_value(&time, &m, 0), time.laplacian, &opt);
    double factored = app_now();
    sl_saved_set set;
    sl_region *R = NULL;
    memset(&set, 0, sizeof set);
    set.symbolic = h.S;
    set.factor = h.F;
    make_inverses(&set, &R, region, selected, &opt);
    double made = app_now();
    app_stage("save");
    app_must(sl_save_set_bytes(&bytes, &set), "save", NULL);
    app_must(sl_save_set_file(out, &set, NULL), out, NULL);
    double saved = app_now();
    app_progress_end();
    printf("%s: %.2f MB, %d rows, t = %.6g; seconds: factor %.4g, save %.4g\n", out,
           1e-6 * (double)bytes, (int)h.n, h.t, factored - begin, saved - made);
    if (selected || region != NULL) {
        printf("with%s%s%s: made in %.4g s\n", selected ? " the selected inverse" : "",
               selected && region != NULL ? " and" : "", region != NULL ? " a region" : "",
               made - factored);
    }
    sl_region_free(R);
    sl_selected_free(set.selected);
    heat_system_free(&h);
    mesh_free(&m);
    return 0;
}

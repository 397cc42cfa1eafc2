/* command_save.c: saves the factored diffusion operator of a mesh in a file */
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
    "at once and share one copy in memory.",
    "Size of the file; seconds to factor and to save.",
    "hills:200x200 --out hills.slf\nbunny.obj --time 1e-4 --out bunny.slf"};

int command_save(int argc, char **argv) {
    const char *operand = NULL, *out = NULL, *scratch = NULL;
    heat_time time = {0, 0, 0, NULL};
    const option options[] = {{OPTION_OUTPUT, "out", &out, "FILE", "the file to write: required"},
                              {OPTION_TEXT, "scratch", &scratch, "FOLDER",
                               "keep large blocks in unnamed files of this folder, so that the "
                               "factor may exceed the memory"},
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
    app_stage("save");
    app_must(sl_save_bytes(&bytes, h.S, h.F), "save", NULL);
    app_must(sl_save_file(out, h.S, h.F, NULL), out, NULL);
    double saved = app_now();
    app_progress_end();
    printf("%s: %.2f MB, %d rows, t = %.6g; seconds: factor %.4g, save %.4g\n", out,
           1e-6 * (double)bytes, (int)h.n, h.t, factored - begin, saved - factored);
    heat_system_free(&h);
    mesh_free(&m);
    return 0;
}

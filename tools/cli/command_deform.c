/* command_deform.c: deformations by handles that are grabbed, moved and released, on one factor */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "app.h"
#include "command.h"
#include "deform.h"
#include "solve_accuracy.h"
#include "tools/io/output_file.h"

static const options_usage usage = {
    "deform", "MESH", 1, 1, "Deforms a mesh by handles that are grabbed, moved and released."};

static const options_manual manual = {
    "Vertices that handles hold are pins on the factor of a singular matrix, the Laplacian L "
    "(arap) or L M^-1 L (biharmonic), which is factored once. Grabbing a handle takes a forward "
    "sweep for up to 8 of its vertices, and releasing it changes a small matrix only; more than "
    "200 vertices are fixed in a factor of the others instead. An as-rigid-as-possible frame takes "
    "10 to 30 solves: Newton steps with a factor of the Hessian each, then quasi-Newton steps with "
    "the last one, until a step moves nothing any more. Biharmonic displacements need one solve; "
    "--at "
    "computes them near the wanted vertices only. A component without handles keeps its mean "
    "position (arap) or is at rest.\n"
    "The script has a step per line; # starts a comment:\n"
    "grab VERTICES [within R]: 3,17,100-200 and all vertices within the distance R of these; "
    "handles are numbered 0, 1, ... in order of their grabs\n"
    "move HANDLE DX DY DZ\n"
    "turn HANDLE AX AY AZ DEGREES: about an axis through the mean of the handle\n"
    "release HANDLE\n"
    "frame: computes the surface, and draws it with --frames; dots are the vertices that are held, "
    "red where they have moved, else blue",
    "How many solves the frames took, the energy of the last one and how far its last step moved a "
    "vertex; with --verbose milliseconds of processor time. --csv has the last "
    "positions and displacements; with --at only those vertices, which are then all that is "
    "computed. --steps has a row per step of the script. --check solves each frame again with a "
    "new factor without the rows that are held; exit status 1 if positions differ by more than "
    "--bound, or if a frame has not converged.",
    "star:5 --script bend.txt --frames bend --out bent.ply\n"
    "bunny.obj --script bend.txt --method biharmonic --check --steps steps.csv"};

/* A row of --steps. */
static void report(deform_command *cmd, const script_step *step, const step_times *t) {
    cmd->total.pin += t->pin;
    cmd->total.release += t->release;
    cmd->total.solves += t->solves;
    cmd->total.solve += t->solve;
    cmd->total.fresh += t->fresh;
    cmd->worst = t->difference <= cmd->worst ? cmd->worst : t->difference; /* a NaN counts */
    if (cmd->table != NULL) {
        fprintf(cmd->table, "%ld,%s,%d,%d,%.3f,%.3f,%d,%.3f", step->line, script_word(step->action),
                (int)step->handle, (int)cmd->d.n_pins, t->pin, t->release, t->solves, t->solve);
        if (step->action == SCRIPT_FRAME) {
            fprintf(cmd->table, ",%.17g,%.3g", t->energy, t->moved);
        } else {
            fprintf(cmd->table, ",,");
        }
        if (step->action == SCRIPT_FRAME && cmd->check) {
            fprintf(cmd->table, ",%.3f,%.3g\n", t->fresh, t->difference);
        } else {
            fprintf(cmd->table, ",,\n");
        }
    }
}

/* ---- steps of the script ---- */

static void warn_of_refusal(deform_command *cmd) {
    if (cmd->d.refused && !cmd->has_warned) {
        app_warn("a part of the mesh is so close to degenerate that pins on its factor lose all "
                 "digits; each set of handles has a new factor instead");
        cmd->has_warned = true;
    }
}

static void grab(deform_command *cmd, const script_handle *h, const script_step *step,
                 step_times *t) {
    const double began = app_processor_ms();
    app_stage("holding vertices");
    const sl_status status = deformer_hold(&cmd->d, h->vertices, h->count);
    if (status != SL_OK) {
        app_die("%s:%ld: vertex %d cannot be held: %s", cmd->script_path, step->line,
                (int)cmd->d.stats.error.row, app_error_text(status, NULL));
    }
    t->pin = app_processor_ms() - began;
    cmd->pinned += h->count;
    warn_of_refusal(cmd);
}

static void release(deform_command *cmd, const script_handle *h, step_times *t) {
    const double began = app_processor_ms();
    app_must(deformer_release(&cmd->d, h->vertices, h->count), "release", NULL);
    t->release = app_processor_ms() - began;
    cmd->released += h->count;
}

static void move(deform_command *cmd, const script_handle *h, const script_step *step) {
    double *points = app_alloc(3 * (size_t)h->count, sizeof *points);
    for (sl_int k = 0; k < h->count; k++) {
        memcpy(points + 3 * k, cmd->d.target + 3 * (size_t)h->vertices[k], 3 * sizeof *points);
    }
    script_step_apply(step, points, h->count);
    for (sl_int k = 0; k < h->count; k++) {
        deformer_move(&cmd->d, h->vertices[k], points + 3 * k);
    }
    free(points);
}

/* Dies unless a solve of `method` has succeeded. A badly shaped mesh can be beyond the digits. */
static void must_solve(const deform_command *cmd, sl_status status) {
    if (status == SL_ERR_PIVOT || status == SL_ERR_INACCURATE || status == SL_ERR_NOT_FINITE ||
        status == SL_ERR_INCONSISTENT) {
        app_die(
            "%s cannot be solved on this mesh: its faces are too thin, or too different in size",
            cmd->method);
    }
    app_must(status, "deformation", NULL);
}

static void solve_frame(deform_command *cmd, step_times *t) {
    if (cmd->at != NULL) {
        const double began = app_processor_ms();
        must_solve(cmd, deformer_solve_watched(&cmd->d, cmd->near_positions));
        t->solve = app_processor_ms() - began;
    }
    const double began = app_processor_ms();
    if (cmd->d.method == DEFORM_ARAP) {
        deformer_rest how;
        must_solve(cmd, deformer_relax(&cmd->d, cmd->tolerance, (int)cmd->iterations, &how));
        t->energy = how.energy;
        t->solves = how.solves;
        t->moved = how.moved;
        cmd->unfinished += !how.converged;
        cmd->lately = fmax(cmd->lately, how.lately);
        cmd->last = how;
        if (cmd->check) { /* of a global step */
            (void)deformer_rotations(&cmd->d);
        }
    }
    /* with --at the full solve is the check */
    if (cmd->check || (cmd->at == NULL && cmd->d.method == DEFORM_BIHARMONIC)) {
        must_solve(cmd, deformer_solve(&cmd->d));
    }
    t->solve += cmd->at == NULL ? app_processor_ms() - began : 0;
    warn_of_refusal(cmd);
}

static void check_frame(deform_command *cmd, step_times *t) {
    size_t n = (size_t)cmd->d.n, count = (size_t)cmd->n_watched;
    must_solve(cmd, deformer_compare(&cmd->d, &t->difference, &t->fresh));
    t->fresh *= 1e3;
    for (size_t k = 0; k < count && cmd->at != NULL; k++) {
        double distance = 0;
        for (size_t c = 0; c < 3; c++) {
            distance = hypot(distance, cmd->near_positions[c * count + k] -
                                           cmd->d.Y[c * n + (size_t)cmd->watched[k]]);
        }
        distance /= cmd->d.diameter;
        t->difference = distance <= t->difference ? t->difference : distance;
    }
}

static void run_script(deform_command *cmd) {
    for (size_t k = 0; k < cmd->script.n_steps; k++) {
        const script_step *step = &cmd->script.steps[k];
        const script_handle *h = script_step_handle(&cmd->script, step);
        step_times t;
        memset(&t, 0, sizeof t);
        switch (step->action) {
        case SCRIPT_GRAB:
            grab(cmd, h, step, &t);
            break;
        case SCRIPT_RELEASE:
            release(cmd, h, &t);
            break;
        case SCRIPT_MOVE:
        case SCRIPT_TURN:
            move(cmd, h, step);
            break;
        case SCRIPT_FRAME:
            if (step->handle == 0) {
                deform_print_free(cmd);
            }
            solve_frame(cmd, &t);
            if (cmd->check) {
                check_frame(cmd, &t);
            }
            if (cmd->frames != NULL) {
                deform_write_frame(cmd, step->handle);
            }
            break;
        }
        report(cmd, step, &t);
        app_progress("script", (double)(k + 1) / (double)cmd->script.n_steps);
    }
    app_progress_end();
}

/* ---- preparation ---- */

/* Without --iterations: beyond LARGE vertices a factor of the Hessian takes about a second. */
enum { BY_SIZE = -1, LARGE = 10000 };

static void check_options(const deform_command *cmd) {
    char message[512];
    if (strcmp(cmd->method, "arap") != 0 && strcmp(cmd->method, "biharmonic") != 0) {
        app_die_usage("--method %s: expected arap or biharmonic", cmd->method);
    }
    if (cmd->iterations != BY_SIZE && (cmd->iterations < 1 || cmd->iterations > 1000000)) {
        app_die_usage("--iterations: expected 1 to 1000000");
    }
    if (!(cmd->tolerance >= 0)) {
        app_die_usage("--tolerance: expected 0 or more");
    }
    if (cmd->at != NULL && strcmp(cmd->method, "biharmonic") != 0) {
        app_die_usage("--at: only with --method biharmonic; rotations need all vertices");
    }
    if (cmd->at != NULL &&
        (cmd->frames != NULL || cmd->output.out != NULL || cmd->output.png != NULL)) {
        app_die_usage("--at: computes no surface for --frames, --out and --png");
    }
    app_check_output(&cmd->output, cmd->output.out);
    if (cmd->frames != NULL) {
        char *first = deform_frame_path(cmd, 0);
        if (!output_is_possible(first, message, sizeof message)) {
            app_die("%s", message);
        }
        free(first);
    }
}

static void open_command(deform_command *cmd, const char *operand) {
    char message[512];
    app_mesh(&cmd->m, operand, true);
    if (cmd->iterations == BY_SIZE) {
        cmd->iterations = cmd->m.n_vertices > LARGE ? 30 : 200;
    }
    app_set_up(&cmd->output, &cmd->m, cmd->output.png != NULL || cmd->frames != NULL);
    if (cmd->script_path == NULL) {
        app_die_usage("deform: --script FILE is missing");
    }
    if (!handle_script_read(&cmd->script, cmd->script_path, &cmd->m, message, sizeof message)) {
        app_die("%s", message);
    }
    if (!handle_script_box(cmd->box, &cmd->script, &cmd->m)) {
        app_die("out of memory");
    }
    app_stage("factoring");
    const double began = app_processor_ms();
    const bool is_arap = strcmp(cmd->method, "arap") == 0;
    must_solve(cmd, deformer_create(&cmd->d, &cmd->m, is_arap ? DEFORM_ARAP : DEFORM_BIHARMONIC));
    const double spent = app_processor_ms() - began;
    app_progress_end();
    if (!(cmd->d.diameter > 0) || !isfinite(cmd->d.diameter)) {
        app_die("%s: all vertices are at one point, or too far apart", operand);
    }
    const sl_stats *s = &cmd->d.stats;
    printf("mesh       %d vertices, %d faces, %d components; %s.\n", (int)cmd->m.n_vertices,
           (int)cmd->m.n_faces, (int)cmd->d.n_components, cmd->method);
    if (options_verbose) {
        printf("factor     order and analyze %.1f ms, factor %.1f ms, %.3g entries of L; prepared "
               "in %.1f ms\n",
               1e3 * (s->symbolic.seconds_order + s->symbolic.seconds_analyze),
               1e3 * s->factor.seconds, (double)s->symbolic.nnz_panels, spent);
    }
    accuracy_warn_poisson(&cmd->m, NULL, 1);
    if (s->factor.weak > 0) {
        app_warn("%d pivots are within rounding of 0: parts of the mesh are joined weakly",
                 (int)s->factor.weak);
    }
    if (cmd->at != NULL) {
        cmd->watched = app_vertices("at", cmd->at, cmd->m.n_vertices, 1, &cmd->n_watched);
        cmd->n_watched = app_distinct(cmd->watched, cmd->n_watched, cmd->m.n_vertices);
        cmd->near_positions = app_alloc(3 * (size_t)cmd->n_watched, sizeof *cmd->near_positions);
        app_must(deformer_watch(&cmd->d, cmd->watched, cmd->n_watched), "plan", &cmd->d.stats);
        app_print_reads("local", &cmd->d.stats);
        for (size_t k = 0; k < 3 * (size_t)cmd->n_watched; k++) {
            const size_t count = (size_t)cmd->n_watched, n = (size_t)cmd->d.n;
            cmd->near_positions[k] = cmd->d.Y[k / count * n + (size_t)cmd->watched[k % count]];
        }
    }
    if (cmd->output.view == NULL) {
        cmd->output.view = "30,20"; /* for all frames, also where the mesh is flat at rest */
    }
}

static void warn_of_unfinished(const deform_command *cmd) {
    if (cmd->unfinished > 0) {
        app_warn("%d of %d frames have not converged within %d solves: the second half of them "
                 "moved a vertex by %.2g %% of the diagonal, and the limit may be as far again; "
                 "raise --iterations",
                 (int)cmd->unfinished, (int)cmd->script.n_frames, (int)cmd->iterations,
                 100 * cmd->lately);
    }
}

int command_deform(int argc, char **argv) {
    deform_command cmd;
    const char *operand = NULL;
    memset(&cmd, 0, sizeof cmd);
    cmd.method = "arap";
    cmd.iterations = BY_SIZE;
    cmd.tolerance = 1e-4;
    cmd.bound = 1e-6;
    const option options[] = {
        {OPTION_TEXT, "script", &cmd.script_path, "FILE", "steps of the handles: required"},
        {OPTION_TEXT, "method", &cmd.method, "arap|biharmonic",
         "as rigid as possible, or biharmonic displacements (arap)"},
        {OPTION_COUNT, "iterations", &cmd.iterations, "N",
         "largest number of solves per frame, arap only (200; 30 beyond 10000 vertices)"},
        {OPTION_REAL, "tolerance", &cmd.tolerance, "D",
         "arap has converged when steps move no vertex by more than D diagonals of the bounding "
         "box and lower the energy by no more than that part of it (1e-4)"},
        {OPTION_TEXT, "at", &cmd.at, "VERTICES",
         "compute positions of these vertices only, by local solves, biharmonic only: "
         "3,17,100-200"},
        {OPTION_FLAG, "check", &cmd.check, NULL, "solve each frame again with a new factor"},
        {OPTION_ABOVE_0, "bound", &cmd.bound, "D",
         "largest difference that --check accepts, in diagonals of the bounding box (1e-6)"},
        {OPTION_OUTPUT, "steps", &cmd.steps, "FILE", "write the times of each step as a table"},
        {OPTION_TEXT, "frames", &cmd.frames, "PREFIX",
         "draw each frame: PREFIX0000.png, PREFIX0001.png, ..."},
        APP_OUTPUT_OPTIONS(&cmd.output),
        APP_WELD_OPTION,
        {OPTION_END, NULL, NULL, NULL, NULL}};
    options_read(&usage, &manual, options, argc, argv, &operand);
    check_options(&cmd);
    open_command(&cmd, operand);
    if (cmd.steps != NULL) {
        cmd.table = app_create(cmd.steps);
        fprintf(cmd.table, "line,action,handle,pins,pin_ms,release_ms,solves,solve_ms,energy,moved,"
                           "fresh_ms,difference\n");
    }
    run_script(&cmd);
    if (cmd.table != NULL) {
        app_close(cmd.table);
    }
    deform_print_summary(&cmd);
    if (cmd.output.csv != NULL) {
        deform_write_csv(&cmd);
    }
    deform_write_shape(&cmd, &cmd.output);
    const bool failed = cmd.check && !(cmd.worst <= cmd.bound);
    if (failed) {
        app_warn("positions differ from those of a new factor by more than --bound");
    }
    warn_of_unfinished(&cmd);
    handle_script_free(&cmd.script);
    deformer_free(&cmd.d);
    free(cmd.near_positions);
    free(cmd.watched);
    mesh_free(&cmd.m);
    return failed || cmd.unfinished > 0;
}

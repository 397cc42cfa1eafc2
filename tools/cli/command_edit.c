/* command_edit.c: a system edited at random places, and a factor that follows each edit */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "command.h"
#include "edit_system.h"
#include "heat_system.h"
#include "mesh_edits.h"
#include "tools/draw/plot.h"

static const options_usage usage = {
    "edit", "MESH", 1, 1, "Edits a system at random places; its factor follows each edit."};

static const options_manual manual = {
    "The system is M + t L. Edits change the weight of an edge, add springs to a patch, pin or "
    "release a vertex (its row and column are eliminated or put back), or flip an edge. "
    "sl_factor_change_entries takes the cheapest of rank-one updates, a refactorization of the "
    "reach and a "
    "complete one. A flip joins two vertices by a new entry, which is a change of pattern: where L "
    "holds the fill, rank-one updates follow, also for the edits after it; elsewhere the "
    "system is analyzed and factored anew. Positions do not change. With split, collapse or remesh "
    "among the kinds rows come and go: an edge gets a vertex in its middle, an edge is collapsed, "
    "or a patch is remeshed by splits, collapses and flips. sl_symbolic_edit and sl_factor_edit "
    "then follow each edit, also flips; they do not go with weight, patch and pin.",
    "A table of edits by kind and way, with milliseconds of processor time; the estimate of the "
    "errors that updates have added (drift), or of the fill relative to a new order (growth); "
    "comparisons with new factors at intervals. Exit "
    "status 1 if solutions differ by more than --bound. --csv has a row per edit, --svg a plot of "
    "the time against the number of edits.",
    "hills:300x300 --edits 2000 --svg edits.svg\n"
    "hills:300x300 --kinds flip,split,collapse --svg mesh.svg\n"
    "bunny.obj --kinds weight,pin --edits 10000 --every 1000 --csv edits.csv"};

static const char *const kind_names[EDIT_ALL_KINDS] = {"weight", "patch",    "pin",   "flip",
                                                       "split",  "collapse", "remesh"};
static const char *const way_names[EDIT_WAYS] = {"none",    "update", "reach", "refactor",
                                                 "outside", "anew",   "kept"};
#define KINDS "weight, patch, pin, flip, split, collapse, remesh"

enum { MOST_POINTS = 3000 }; /* of the plot */

typedef struct edit_command {
    sl_int n_edits, every, patch, seed;
    const char *kinds_text, *svg, *csv, *laplacian;
    double bound;
    heat_time time;
    edit_kind kinds[EDIT_ALL_KINDS];
    int n_kinds;
    mesh m;
    bool is_mesh; /* rows come and go: mesh; else e */
    edit_system e;
    mesh_edits mesh;
    FILE *table;
    plot *drawn;
    double *times[EDIT_ALL_KINDS]; /* milliseconds of each edit of a kind */
    sl_int count[EDIT_ALL_KINDS], ways[EDIT_ALL_KINDS][EDIT_WAYS], not_found;
    double total_ms, most_drift, most_growth;
    edit_check worst; /* largest errors, and smallest times */
    sl_int n_checks;
} edit_command;

/* "weight,pin" */
static void read_kinds(edit_command *cmd) {
    const char *at = cmd->kinds_text;
    bool is_fixed = false;
    while (*at != '\0') {
        const size_t length = strcspn(at, ",");
        int k = 0;
        while (k < EDIT_ALL_KINDS &&
               (strlen(kind_names[k]) != length || strncmp(at, kind_names[k], length) != 0)) {
            k++;
        }
        for (int other = 0; other < cmd->n_kinds; other++) {
            k = (int)cmd->kinds[other] == k ? EDIT_ALL_KINDS : k;
        }
        if (k == EDIT_ALL_KINDS) {
            app_die_usage("--kinds %s: expected some of " KINDS ", each once", cmd->kinds_text);
        }
        cmd->kinds[cmd->n_kinds++] = (edit_kind)k;
        cmd->is_mesh = cmd->is_mesh || k >= EDIT_KINDS;
        is_fixed = is_fixed || k < EDIT_FLIP;
        at += length + (at[length] == ',');
    }
    if (cmd->n_kinds == 0) {
        app_die_usage("--kinds: expected some of " KINDS);
    }
    if (is_fixed && cmd->is_mesh) {
        app_die_usage("--kinds %s: weight, patch and pin do not go with split, collapse and remesh",
                      cmd->kinds_text);
    }
}

/* The random state of the system that is edited. */
static uint64_t *random_of(edit_command *cmd) {
    return cmd->is_mesh ? &cmd->mesh.random : &cmd->e.random;
}

static void add_point(edit_command *cmd, const char *series, plot_style style, double x, double y) {
    if (cmd->drawn != NULL && !plot_add(cmd->drawn, series, style, x, y)) {
        app_die("out of memory");
    }
}

static void check(edit_command *cmd, sl_int done) {
    const sl_csc A = cmd->is_mesh ? sl_matrix_view(cmd->mesh.A) : edited_matrix_view(&cmd->e.A);
    const edit_check found =
        cmd->is_mesh ? edit_check_factor(&A, cmd->mesh.F, cmd->mesh.W, &cmd->mesh.random)
                     : edit_system_check(&cmd->e);
    edit_check *w = &cmd->worst;
    w->difference = found.difference <= w->difference ? w->difference : found.difference;
    w->backward_error = fmax(w->backward_error, found.backward_error);
    w->refactor_ms =
        cmd->n_checks == 0 ? found.refactor_ms : fmin(w->refactor_ms, found.refactor_ms);
    w->anew_ms = cmd->n_checks == 0 ? found.anew_ms : fmin(w->anew_ms, found.anew_ms);
    cmd->n_checks++;
    if (cmd->table != NULL) {
        fprintf(cmd->table, "%d,check,,,,%.3f,%.3g,,%.3g,%.3g\n", (int)done, found.anew_ms,
                cmd->e.stats.change.drift, found.difference, found.backward_error);
    }
    add_point(cmd, "refactorization", PLOT_DASHES, (double)done, found.refactor_ms);
    add_point(cmd, "new analysis and factor", PLOT_LINES, (double)done, found.anew_ms);
}

/* Edits the system and lets the factor follow. Returns false if there is no place. */
static bool edit_and_follow(edit_command *cmd, edit_kind kind, edit_way *way, double *spent,
                            sl_int *entries) {
    entry_changes changes;
    memset(&changes, 0, sizeof changes);
    const bool found = cmd->is_mesh ? mesh_edits_edit(&cmd->mesh, kind)
                                    : edit_system_edit(&cmd->e, kind, &changes);
    if (found) {
        const double began = app_processor_ms();
        *way = cmd->is_mesh ? mesh_edits_follow(&cmd->mesh) : edit_system_follow(&cmd->e, &changes);
        *spent = app_processor_ms() - began;
        *entries = cmd->is_mesh ? cmd->mesh.stats.edit.changed : (sl_int)changes.count;
    }
    triplets_free(&changes);
    return found;
}

static void edit_once(edit_command *cmd, sl_int number) {
    const edit_kind kind = cmd->kinds[app_random_below(random_of(cmd), (sl_int)cmd->n_kinds)];
    const sl_change_info *info = &cmd->e.stats.change; /* all 0 where the mesh is edited */
    edit_way way = EDIT_NONE;
    double spent = 0;
    sl_int entries = 0;
    if (!edit_and_follow(cmd, kind, &way, &spent, &entries)) {
        cmd->not_found++;
        return;
    }
    cmd->times[kind][cmd->count[kind]++] = spent;
    cmd->ways[kind][way]++;
    cmd->total_ms += spent;
    cmd->most_drift = fmax(cmd->most_drift, info->drift);
    cmd->most_growth = fmax(cmd->most_growth, cmd->is_mesh ? cmd->mesh.stats.edit.growth : 0);
    if (cmd->table != NULL) {
        fprintf(cmd->table, "%d,%s,%s,%d,%d,%.3f,%.3g,%lld,,\n", (int)number, kind_names[kind],
                way_names[way], (int)entries, way == EDIT_ANEW ? 0 : (int)info->ranks, spent,
                info->drift, (long long)info->updates);
    }
    if (number % (cmd->n_edits / MOST_POINTS + 1) == 0) {
        add_point(cmd, kind_names[kind], PLOT_POINTS, (double)number + 1, spent);
    }
}

static int by_size(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void print_summary(edit_command *cmd) {
    const sl_int done = cmd->n_edits - cmd->not_found;
    printf("%d edits took %.4f ms each, and %d found no place.\n", (int)done,
           done > 0 ? cmd->total_ms / done : 0, (int)cmd->not_found);
    if (cmd->n_checks > 0) {
        printf(
            "A new analysis and factor takes %.3f ms, a refactorization %.3f ms. Solutions differ "
            "from those of new factors by at most %.3g.\n",
            cmd->worst.anew_ms, cmd->worst.refactor_ms, cmd->worst.difference);
    }
    app_detail("edits      %d in %.1f ms, %.4f ms each\n", (int)done, cmd->total_ms,
               done > 0 ? cmd->total_ms / done : 0);
    app_detail("  %-8s", "kind");
    for (int w = EDIT_UPDATE; w < EDIT_WAYS; w++) {
        app_detail(" %8s", way_names[w]);
    }
    app_detail("  median ms     max ms\n");
    for (int k = 0; k < EDIT_ALL_KINDS; k++) {
        const sl_int count = cmd->count[k];
        if (count == 0) {
            continue;
        }
        qsort(cmd->times[k], (size_t)count, sizeof *cmd->times[k], by_size);
        app_detail("  %-8s", kind_names[k]);
        for (int w = EDIT_UPDATE; w < EDIT_WAYS; w++) {
            app_detail(" %8d", (int)cmd->ways[k][w]);
        }
        app_detail(" %10.4f %10.4f\n", cmd->times[k][count / 2], cmd->times[k][count - 1]);
    }
    if (cmd->count[EDIT_FLIP] > 0 && !cmd->is_mesh) {
        app_detail("flips      %d of %d outside of the fill of L or of what updates can follow: "
                   "analyzed anew\n",
                   (int)cmd->ways[EDIT_FLIP][EDIT_ANEW], (int)cmd->count[EDIT_FLIP]);
    }
    if (cmd->is_mesh) {
        app_detail("growth     entries of L at most %.3f times those expected of a new order; %d "
                   "vertices\n",
                   cmd->most_growth, (int)cmd->mesh.mesh.faces.m.n_vertices);
    } else {
        app_detail(
            "growth     drift at most %.3g; %lld rank-one changes since the last factorization\n",
            cmd->most_drift, (long long)cmd->e.stats.change.updates);
    }
    if (cmd->n_checks > 0) {
        app_detail(
            "check      %d new factors: a refactorization takes %.3f ms, order, analysis and "
            "factor %.3f ms\n",
            (int)cmd->n_checks, cmd->worst.refactor_ms, cmd->worst.anew_ms);
        app_detail(
            "           solutions differ by at most %.3g, bound %.3g; backward error at most "
            "%.3g\n",
            cmd->worst.difference, cmd->bound, cmd->worst.backward_error);
    }
}

static void check_options(edit_command *cmd) {
    read_kinds(cmd);
    if (cmd->n_edits > 100000000) {
        app_die_usage("--edits: expected at most 100000000");
    }
    if (cmd->patch < 2) {
        app_die_usage("--patch: expected 2 or more");
    }
}

static void open_command(edit_command *cmd, const char *operand) {
    app_mesh(&cmd->m, operand, true);
    const double t = heat_time_value(&cmd->time, &cmd->m, 0);
    const sl_int most = cmd->m.n_vertices;
    app_stage("factoring");
    const sl_int patch = cmd->patch < most ? cmd->patch : most;
    if (cmd->is_mesh) {
        mesh_edits_create(&cmd->mesh, &cmd->m, t, patch, (uint64_t)cmd->seed);
    } else {
        edit_system_create(&cmd->e, &cmd->m, t, patch, (uint64_t)cmd->seed);
    }
    app_progress_end();
    app_detail("mesh       %d vertices, %d faces; t = %.6g\n", (int)most, (int)cmd->m.n_faces, t);
    for (int k = 0; k < EDIT_ALL_KINDS; k++) {
        cmd->times[k] = app_alloc((size_t)cmd->n_edits, sizeof *cmd->times[k]);
    }
    if (cmd->csv != NULL) {
        cmd->table = app_create(cmd->csv);
        fprintf(cmd->table, "edit,kind,way,entries,ranks,ms,drift,updates,difference,"
                            "backward_error\n");
    }
    if (cmd->svg != NULL) {
        char title[80];
        (void)snprintf(title, sizeof title, "Processor time of each edit, %d vertices", (int)most);
        cmd->drawn = plot_create(title, "edits", "milliseconds", false, true);
        if (cmd->drawn == NULL) {
            app_die("out of memory");
        }
    }
}

static void close_command(edit_command *cmd) {
    char message[512];
    if (cmd->table != NULL) {
        app_close(cmd->table);
    }
    if (cmd->drawn != NULL && !plot_write(cmd->drawn, cmd->svg, message, sizeof message)) {
        app_die("%s", message);
    }
    plot_free(cmd->drawn);
    for (int k = 0; k < EDIT_ALL_KINDS; k++) {
        free(cmd->times[k]);
    }
    edit_system_free(&cmd->e);
    mesh_edits_free(&cmd->mesh);
    mesh_free(&cmd->m);
}

int command_edit(int argc, char **argv) {
    edit_command cmd;
    const char *operand = NULL;
    memset(&cmd, 0, sizeof cmd);
    cmd.n_edits = 200;
    cmd.every = 50;
    cmd.patch = 100;
    cmd.seed = 1;
    cmd.kinds_text = "weight,pin,flip";
    cmd.bound = 1e-9;
    const option options[] = {
        {OPTION_COUNT, "edits", &cmd.n_edits, "N", "number of edits (200)"},
        {OPTION_TEXT, "kinds", &cmd.kinds_text, "LIST",
         "kinds of edits, drawn at random: some of " KINDS " (weight,pin,flip)"},
        {OPTION_COUNT, "patch", &cmd.patch, "N", "vertices of a patch (100)"},
        {OPTION_COUNT, "every", &cmd.every, "N",
         "compare with a new factor after every N edits and at the end; 0: never (50)"},
        {OPTION_ABOVE_0, "bound", &cmd.bound, "D",
         "largest difference of solutions, relative to their largest entry (1e-9)"},
        {OPTION_COUNT, "seed", &cmd.seed, "N", "of the random places (1)"},
        {OPTION_ABOVE_0, "time", &cmd.time.time, "T", "t of M + t L"},
        {OPTION_ABOVE_0, "scaled-time", &cmd.time.scaled, "S",
         "t is S times the squared mean edge length (1)"},
        {OPTION_OUTPUT, "csv", &cmd.csv, "FILE", "write a row per edit and check"},
        {OPTION_OUTPUT, "svg", &cmd.svg, "FILE", "draw the time of each edit"},
        APP_WELD_OPTION,
        {OPTION_END, NULL, NULL, NULL, NULL}};
    options_read(&usage, &manual, options, argc, argv, &operand);
    check_options(&cmd);
    open_command(&cmd, operand);
    for (sl_int k = 0; k < cmd.n_edits; k++) {
        edit_once(&cmd, k);
        if (cmd.every > 0 && ((k + 1) % cmd.every == 0 || k + 1 == cmd.n_edits)) {
            check(&cmd, k + 1);
        }
        app_progress("edits", (double)(k + 1) / (double)cmd.n_edits);
    }
    app_progress_end();
    print_summary(&cmd);
    const bool failed = !(cmd.worst.difference <= cmd.bound);
    if (failed) {
        app_warn("solutions differ from those of a new factor by more than --bound");
    }
    close_command(&cmd);
    return failed;
}

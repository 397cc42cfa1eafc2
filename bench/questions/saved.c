/* saved.c: what does a saved factor cost to write, load and map, and to share among processes? */
#define _DEFAULT_SOURCE /* MAP_ANONYMOUS */
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include "bench/lib/bench.h"
#include "bench/lib/saved_inverses.h"

/* A factor is saved beside the CSV files. Saving and loading are compared with a plain copy of the
 * file to the device and a plain read of it; a mapped factor with the one in memory. Children of
 * this process map the file and solve: their private memory is that of the kernel's accounts, and
 * one of them alone is compared with two at once. The file stays in the page cache. */

enum { CHUNK = 1 << 20, FIRST_SOLVES = 32, CHILD_SOLVES = 500, OPENS = 9, ROUNDS = 4 };

typedef struct saved_case {
    const bench_system *system;
    char path[500], copy[500];
    size_t bytes;
    unsigned char *buffer; /* CHUNK bytes */
    unsigned checks;
    uint64_t rng;
    sl_saved_set mapped; /* the factor of the solves, beside that in memory */
    sl_work *W;
} saved_case;

/* ---- contenders ---- */

static sl_saved_set set_of(const saved_case *c) {
    const sl_saved_set set = {.symbolic = c->system->S, .factor = c->system->F};
    return set;
}

static void call_save(void *state) {
    const saved_case *c = state;
    const sl_saved_set set = set_of(c);
    bench_must(sl_save(c->copy, NULL, NULL, &set, NULL), "saving");
}

static void call_load(void *state) {
    const saved_case *c = state;
    sl_saved_set set = {0};
    bench_must(sl_load(&set, c->path, NULL, 0, c->checks, NULL), "loading");
    sl_saved_set_free(&set);
}

static void call_map(void *state) {
    const saved_case *c = state;
    sl_saved_set set = {0};
    bench_must(sl_load(&set, c->path, NULL, 0, (c->checks) | SL_LOAD_MAPPED, NULL), "mapping");
    sl_saved_set_free(&set);
}

/* Copies the file as cp does, and waits until the copy is on the device, as a save does. */
static void call_copy(void *state) {
    const saved_case *c = state;
    const int from = open(c->path, O_RDONLY),
              to = open(c->copy, O_WRONLY | O_CREAT | O_TRUNC, 0666);
    ssize_t got = 0;
    while (from >= 0 && to >= 0 && (got = read(from, c->buffer, CHUNK)) > 0) {
        if (write(to, c->buffer, (size_t)got) != got) {
            got = -1;
            break;
        }
    }
    if (from < 0 || to < 0 || got != 0 || fsync(to) != 0) {
        bench_must(SL_ERR_IO, "copying a file");
    }
    close(from);
    close(to);
}

/* Reads the whole file into memory that is new, as a load does. */
static void call_read(void *state) {
    const saved_case *c = state;
    FILE *file = fopen(c->path, "rb");
    void *memory = bench_alloc(c->bytes, 1);
    if (file == NULL || fread(memory, 1, c->bytes, file) != c->bytes) {
        bench_must(SL_ERR_IO, "reading a file");
    }
    fclose(file);
    free(memory);
}

static void remove_copy(void *state) {
    const saved_case *c = state;
    (void)remove(c->copy);
}

static double solve_at(const sl_factor *F, sl_int v, sl_work *W) {
    const double one = 1;
    double x;
    bench_must(sl_local_solve(F, &v, 1, &v, 1, &x, 1, &one, 1, 1, W, NULL), "local solve");
    return x;
}

static void map_again(void *state) {
    saved_case *c = state;
    sl_saved_set_free(&c->mapped);
    sl_work_free(c->W);
    bench_must(sl_load(&c->mapped, c->path, NULL, 0, SL_LOAD_TRUSTED | SL_LOAD_MAPPED, NULL),
               "mapping");
    bench_must(sl_work_create(&c->W, NULL), "workspace");
}

static void call_first_solve(void *state) {
    saved_case *c = state;
    (void)solve_at(c->mapped.factor, bench_random_below(&c->rng, c->system->n), c->W);
}

static void call_memory_solve(void *state) {
    saved_case *c = state;
    (void)solve_at(c->system->F, bench_random_below(&c->rng, c->system->n), c->W);
}

/* ---- checks ---- */

/* Mapped and loaded factors give the same bits as the one in memory. */
static int check_bits(bench_run *run, saved_case *c) {
    uint64_t rng = 31;
    int same = 1;
    sl_work *W;
    bench_must(sl_work_create(&W, NULL), "workspace");
    for (int way = 0; way < 4; way++) {
        sl_saved_set set = {0};
        bench_must(way < 3 ? sl_load(&set, c->path, NULL, 0, ((unsigned)way) | SL_LOAD_MAPPED, NULL)
                           : sl_load(&set, c->path, NULL, 0, SL_LOAD_CHECKED, NULL),
                   "mapping");
        for (int k = 0; k < 100; k++) {
            const sl_int v = bench_random_below(&rng, c->system->n);
            const double x = solve_at(c->system->F, v, W), y = solve_at(set.factor, v, W);
            same &= memcmp(&x, &y, sizeof x) == 0;
        }
        sl_saved_set_free(&set);
    }
    sl_work_free(W);
    return bench_expect(run, same, "a mapped factor gives other bits than the one in memory");
}

/* ---- rows ---- */

static void add_row(bench_report *report, const saved_case *c, const char *what, const char *method,
                    const bench_sample *time, double baseline) {
    bench_row row = {.what = what, .method = method, .nrhs = 1};
    row.time = *time;
    row.baseline = baseline;
    bench_report_row(report, c->system, &row);
}

/* Times the calls in turn: seconds on the clock, and of the processor, without waiting for the
 * device. */
static void time_files(bench_report *report, saved_case *c) {
    void (*const calls[4])(void *) = {call_copy, call_read, call_save, call_load};
    static const char *const names[4] = {"cp, then fsync", "read into memory", "save",
                                         "load, checked"};
    double times[4][ROUNDS], processor[4][ROUNDS];
    bench_sample clock[4], own[4];
    c->checks = SL_LOAD_CHECKED;
    for (int round = -1; round < ROUNDS; round++) { /* the first one is a warm-up */
        for (int k = 0; k < 4; k++) {
            remove_copy(c);
            const double start = bench_now(), spent = bench_processor_seconds();
            calls[k](c);
            times[k][round < 0 ? 0 : round] = bench_now() - start;
            processor[k][round < 0 ? 0 : round] = bench_processor_seconds() - spent;
        }
    }
    for (int k = 0; k < 4; k++) {
        clock[k] = bench_sample_of(times[k], ROUNDS);
        own[k] = bench_sample_of(processor[k], ROUNDS);
    }
    for (int k = 0; k < 4; k++) {
        add_row(report, c, "file", names[k], &clock[k], clock[k % 2].median);
        add_row(report, c, "file, CPU time", names[k], &own[k], own[k % 2].median);
    }
    bench_report_note(report,
                      "save and load take %.2f times as long as cp and read, and %.2f times the "
                      "CPU time (minima); %.1f MB",
                      (clock[2].min + clock[3].min) / (clock[0].min + clock[1].min),
                      (own[2].min + own[3].min) / (own[0].min + own[1].min),
                      1e-6 * (double)c->bytes);
    remove_copy(c);
}

/* Mapping computes and does not wait, so that processor time leaves out other programs. */
static void time_maps(bench_report *report, saved_case *c) {
    static const unsigned checks[3] = {SL_LOAD_TRUSTED, SL_LOAD_CHECKED, SL_LOAD_VERIFIED};
    static const char *const names[3] = {"map, trusted", "map, checked", "map, verified"};
    double times[3][OPENS];
    bench_sample found[3];
    for (int round = -1; round < OPENS; round++) { /* the first one is a warm-up */
        for (int k = 0; k < 3; k++) {
            const double start = bench_processor_seconds();
            c->checks = checks[k];
            call_map(c);
            times[k][round < 0 ? 0 : round] = bench_processor_seconds() - start;
        }
    }
    for (int k = 0; k < 3; k++) {
        found[k] = bench_sample_of(times[k], OPENS);
    }
    for (int k = 0; k < 3; k++) {
        add_row(report, c, "open, CPU time", names[k], &found[k], found[1].median);
    }
}

/* The first solve after mapping a file of the page cache: its page faults are those of one path. */
static void time_first_solves(bench_report *report, saved_case *c) {
    double times[2][FIRST_SOLVES];
    bench_sample found[2];
    for (int k = 0; k < FIRST_SOLVES; k++) {
        map_again(c);
        const double start = bench_processor_seconds();
        call_first_solve(c);
        const double middle = bench_processor_seconds();
        call_memory_solve(c);
        times[0][k] = middle - start;
        times[1][k] = bench_processor_seconds() - middle;
    }
    found[0] = bench_sample_of(times[0], FIRST_SOLVES);
    found[1] = bench_sample_of(times[1], FIRST_SOLVES);
    add_row(report, c, "vertex, CPU", "in memory", &found[1], found[1].median);
    add_row(report, c, "vertex, CPU", "first solve, mapped", &found[0], found[1].median);
}

/* ---- processes ---- */

typedef struct child_result {
    double seconds, processor; /* of the solves */
    double private_bytes;      /* more than before the file was mapped, without the workspace */
} child_result;

/* Bytes that only this process has: the lines Private_* of the kernel; -1 if there are none. */
static double private_bytes(void) {
    char line[256];
    double sum = -1;
    FILE *file = fopen("/proc/self/smaps_rollup", "r");
    while (file != NULL && fgets(line, sizeof line, file) != NULL) {
        long kilobytes;
        if (strncmp(line, "Private_", 8) == 0 && strchr(line, ':') != NULL &&
            sscanf(strchr(line, ':') + 1, "%ld", &kilobytes) == 1) {
            sum = (sum < 0 ? 0 : sum) + 1024.0 * (double)kilobytes;
        }
    }
    if (file != NULL) {
        fclose(file);
    }
    return sum;
}

static void be_child(const saved_case *c, int solves, child_result *out) {
    sl_saved_set set = {0};
    sl_work *W;
    uint64_t rng = 99;
    const double before = private_bytes();
    bench_must(sl_load(&set, c->path, NULL, 0, SL_LOAD_MAPPED, NULL), "mapping");
    bench_must(sl_work_create(&W, NULL), "workspace");
    for (int k = 0; k < solves / 10; k++) {
        (void)solve_at(set.factor, bench_random_below(&rng, c->system->n), W);
    }
    out->private_bytes = private_bytes() - before - (double)sl_work_bytes(W);
    const double start = bench_now(), processor = bench_processor_seconds();
    for (int k = 0; k < solves; k++) {
        (void)solve_at(set.factor, bench_random_below(&rng, c->system->n), W);
    }
    out->seconds = bench_now() - start;
    out->processor = bench_processor_seconds() - processor;
    _exit(0);
}

/* Runs `count` children at once. Returns whether all of them ended well. */
static int run_children(const saved_case *c, int count, int solves, child_result *out) {
    int ok = 1;
    pid_t children[2];
    fflush(NULL);
    for (int k = 0; k < count; k++) {
        children[k] = fork();
        if (children[k] == 0) {
            be_child(c, solves, &out[k]);
        }
    }
    for (int k = 0; k < count; k++) {
        int status = 0;
        ok &= children[k] > 0 && waitpid(children[k], &status, 0) == children[k] && status == 0;
    }
    return ok;
}

static double larger(double a, double b) {
    return a > b ? a : b;
}

/* One process alone and two at once, in turn; the best of the rounds counts. */
static void time_processes(bench_run *run, bench_report *report, const saved_case *c) {
    const int solves = CHILD_SOLVES;
    double alone[2] = {1e9, 1e9}, both[2] = {1e9, 1e9}, private_most = 0;
    int ok = 1;
    sl_saved_set set = {
        0}; /* maps all pages here, so that those of a single child are shared too */
    bench_must(sl_load(&set, c->path, NULL, 0, SL_LOAD_VERIFIED | SL_LOAD_MAPPED, NULL), "mapping");
    child_result *r = mmap(NULL, 4096, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (r == MAP_FAILED) {
        bench_must(SL_ERR_MEMORY, "sharing memory");
    }
    for (int round = 0; round < ROUNDS && ok; round++) {
        ok &= run_children(c, 1, solves, r);
        alone[0] = r[0].seconds < alone[0] ? r[0].seconds : alone[0];
        alone[1] = r[0].processor < alone[1] ? r[0].processor : alone[1];
        private_most = larger(private_most, r[0].private_bytes);
        ok &= run_children(c, 2, solves, r);
        const double seconds = larger(r[0].seconds, r[1].seconds),
                     processor = larger(r[0].processor, r[1].processor);
        both[0] = seconds < both[0] ? seconds : both[0];
        both[1] = processor < both[1] ? processor : both[1];
        private_most = larger(private_most, larger(r[0].private_bytes, r[1].private_bytes));
    }
    munmap(r, 4096);
    sl_saved_set_free(&set);
    if (!bench_expect(run, ok, "a process that maps the file failed")) {
        return;
    }
    bench_report_note(report,
                      "private memory of a process beyond its workspace: at most %.2f MB; "
                      "%d solves in %s",
                      1e-6 * private_most, solves, "each process");
    bench_report_note(report,
                      "2 processes answer %.2f times the queries of one in the same processor "
                      "time each (%.2f in the same time on the clock)",
                      2 * alone[1] / both[1], 2 * alone[0] / both[0]);
}

void bench_saved(bench_run *run) {
    static const double default_n = 1e6, quick_n = 1e5;
    saved_case c;
    memset(&c, 0, sizeof c);
    if (bench_systems(run, run->size == BENCH_QUICK ? &quick_n : &default_n, 1, &c.system) != 1) {
        return;
    }
    snprintf(c.path, sizeof c.path, "%s/saved.slf", run->out_dir);
    snprintf(c.copy, sizeof c.copy, "%s/saved_copy.slf", run->out_dir);
    c.buffer = bench_alloc(CHUNK, 1);
    c.rng = 5;
    const sl_saved_set set = set_of(&c);
    bench_must(sl_save(NULL, NULL, &c.bytes, &set, NULL), "saving");
    bench_must(sl_save(c.path, NULL, NULL, &set, NULL), "saving");
    if (check_bits(run, &c)) {
        bench_report *report = bench_report_open(run, "saved", "factors in files",
                                                 "cp or read; map, checked; a factor in memory");
        time_files(report, &c);
        time_maps(report, &c);
        time_first_solves(report, &c);
        time_processes(run, report, &c);
        bench_saved_inverses(run, report, c.system);
        bench_report_close(report);
    }
    sl_saved_set_free(&c.mapped);
    sl_work_free(c.W);
    (void)remove(c.path);
    free(c.buffer);
}

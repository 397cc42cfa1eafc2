/* cluster_mpi.c: many queries on one saved factor, by all ranks of an MPI job; restartable */
#define _POSIX_C_SOURCE 200809L
#include <errno.h>
#include <mpi.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "sparse_local.h"
#include "tools/cli/heat_system.h"
#include "tools/io/output_file.h"

/* Rank 0 checks the saved factor, or factors a mesh and saves it first; then every rank maps the
 * file. The ranks of a node thus share one copy in memory. No rank has a part of the factor that
 * others need, so that queries need no messages.
 *
 * The queries are sorted by the column of L that they begin at, and divided into blocks. A block is
 * a subtree or a few of them, so that its queries share sweeps and pages of L. Every rank takes the
 * next block from a counter at rank 0, and writes the answers in a file of the block. The file gets
 * its name when it is complete. A job that is started again takes only blocks without a file. */

enum { RESULT_NAME = 1024, DEFAULT_BLOCK = 2000 };

typedef struct job {
    const char *operand, *kind, *folder;
    sl_int block; /* queries in a block */
    long count;   /* queries */
    int rank, ranks;
    char factor[RESULT_NAME];
    sl_saved_set set; /* with the selected inverse, if the file has one */
    sl_int n_blocks;
    sl_int *rows, *columns; /* count queries: diagonal entries if columns is NULL */
    MPI_Win counter;
    int *next; /* the counter, at rank 0 */
} job;

APP_NORETURN APP_PRINTF static void fail(const char *format, ...) {
    va_list list;
    va_start(list, format);
    (void)fprintf(stderr, "cluster-mpi: ");
    (void)vfprintf(stderr, format, list);
    (void)fprintf(stderr, "\n");
    va_end(list);
    (void)fflush(stderr);
    /* mpiexec drops what it has not forwarded yet when it ends the ranks */
    (void)nanosleep(&(struct timespec){0, 200000000}, NULL);
    (void)MPI_Abort(MPI_COMM_WORLD, 1);
    exit(1);
}

static void must(sl_status status, const char *what) {
    char text[400];
    if (status != SL_OK) {
        (void)sl_error_text(text, sizeof text, status, NULL);
        fail("%s: %s", what, text);
    }
}

static FILE *open_result(const char *path) {
    char message[RESULT_NAME + 200];
    FILE *file = output_open(path, message, sizeof message);
    if (file == NULL) {
        fail("%s", message);
    }
    return file;
}

static void close_result(FILE *file) {
    char message[RESULT_NAME + 200];
    if (!output_close(file, message, sizeof message)) {
        fail("%s", message);
    }
}

static void name_block(char *path, const job *j, sl_int block) {
    (void)snprintf(path, RESULT_NAME, "%s/%s.%07d.csv", j->folder, j->kind, (int)block);
}

/* ---- the factor ---- */

/* Rank 0: the file is there and verified when it returns. */
static void provide_factor(job *j) {
    sl_saved_set set = {0};
    if (mkdir(j->folder, 0777) != 0 && errno != EEXIST) {
        fail("%s: %s", j->folder, strerror(errno));
    }
    if (!app_is_saved(j->operand) && access(j->factor, R_OK) != 0) {
        const heat_time time = {0, 0, 0, NULL};
        mesh m;
        heat_system h;
        app_mesh(&m, j->operand, true);
        heat_system_create(&h, &m, heat_time_value(&time, &m, 0), time.laplacian, NULL);
        const sl_saved_set made = {.symbolic = h.S, .factor = h.F};
        must(sl_save(j->factor, NULL, NULL, &made, NULL), j->factor);
        heat_system_free(&h);
        mesh_free(&m);
    }
    must(sl_load(&set, j->factor, NULL, 0, SL_LOAD_VERIFIED | SL_LOAD_MAPPED, NULL), j->factor);
    sl_saved_set_free(&set);
}

/* ---- the queries ---- */

typedef struct keyed_pair {
    sl_int key, row, column;
} keyed_pair;

static int by_key(const void *a, const void *b) {
    const keyed_pair *p = a, *q = b;
    return p->key != q->key         ? (p->key > q->key) - (p->key < q->key)
           : p->column != q->column ? (p->column > q->column) - (p->column < q->column)
                                    : 0;
}

/* The same list on every rank and in every run: the blocks have to mean the same. */
static void choose_queries(job *j) {
    const sl_symbolic_arrays a = sl_symbolic_view(j->set.symbolic);
    if (j->kind[0] == 'a') {
        j->count = a.n;
        j->rows = app_alloc((size_t)a.n, sizeof *j->rows);
        memcpy(j->rows, a.perm, (size_t)a.n * sizeof *j->rows);
    } else {
        keyed_pair *all = app_alloc((size_t)j->count, sizeof *all);
        uint64_t state = 1;
        for (long k = 0; k < j->count; k++) {
            all[k].row = app_random_below(&state, a.n);
            all[k].column = app_random_below(&state, a.n);
            all[k].key = a.iperm[all[k].row];
        }
        qsort(all, (size_t)j->count, sizeof *all, by_key);
        j->rows = app_alloc((size_t)j->count, sizeof *j->rows);
        j->columns = app_alloc((size_t)j->count, sizeof *j->columns);
        for (long k = 0; k < j->count; k++) {
            j->rows[k] = all[k].row;
            j->columns[k] = all[k].column;
        }
        free(all);
    }
    j->n_blocks = (sl_int)((j->count + j->block - 1) / j->block);
}

/* The checksum of the header and the table, in which those of all sections are (src/FORMAT.md). */
static unsigned long long checksum_of(const char *path) {
    enum { AT = 32 };
    uint64_t sum = 0;
    FILE *file = fopen(path, "rb");
    if (file == NULL || fseek(file, AT, SEEK_SET) != 0 || fread(&sum, sizeof sum, 1, file) != 1) {
        fail("%s: cannot be read", path);
    }
    (void)fclose(file);
    return (unsigned long long)sum;
}

/* Rank 0: a folder has the results of one job. The first run leaves a line that the others
 * compare. */
static void check_folder(const job *j) {
    char path[RESULT_NAME], mine[200], theirs[200] = "";
    (void)snprintf(path, sizeof path, "%s/%s.job", j->folder, j->kind);
    (void)snprintf(mine, sizeof mine, "%s of factor %016llx, %ld in blocks of %d\n", j->kind,
                   checksum_of(j->factor), j->count, (int)j->block);
    FILE *file = fopen(path, "r");
    if (file != NULL) {
        const char *line = fgets(theirs, sizeof theirs, file);
        (void)fclose(file);
        if (line == NULL || strcmp(mine, theirs) != 0) {
            fail("%s has the results of another job: %.*s", j->folder, (int)strcspn(theirs, "\n"),
                 theirs);
        }
        return;
    }
    file = open_result(path);
    (void)fputs(mine, file);
    close_result(file);
}

/* ---- the work ---- */

/* The next block that has no file; n_blocks if there is none. */
static sl_int take_block(const job *j) {
    for (;;) {
        const int one = 1;
        int block = 0;
        char path[RESULT_NAME];
        (void)MPI_Fetch_and_op(&one, &block, MPI_INT, 0, 0, MPI_SUM, j->counter);
        (void)MPI_Win_flush(0, j->counter);
        if (block >= j->n_blocks) {
            return j->n_blocks;
        }
        name_block(path, j, block);
        if (access(path, F_OK) != 0) {
            return block;
        }
    }
}

/* Entries of the inverse. Diagonal entries are those of the selected inverse, if the file has one
 * with all of them: which way a block takes depends on the file alone, so that bits do too. */
static sl_status find_answers(const job *j, const sl_int *rows, const sl_int *columns, sl_int count,
                              double *x, sl_work *W) {
    sl_status status = SL_ERR_OTHER_PATTERN;
    if (columns != NULL) {
        return sl_inverse_pairs(j->set.factor, x, rows, columns, count, W, NULL);
    }
    if (j->set.selected != NULL) {
        status = sl_selected_entries(j->set.selected, x, rows, NULL, count, NULL);
    }
    return status == SL_ERR_OTHER_PATTERN
               ? sl_inverse_diagonal(j->set.factor, x, rows, count, W, NULL)
               : status;
}

static void answer_block(const job *j, sl_int block, double *x, sl_work *W) {
    const size_t first = (size_t)block * (size_t)j->block;
    const size_t left = (size_t)j->count - first;
    const sl_int count = left < (size_t)j->block ? (sl_int)left : j->block;
    char path[RESULT_NAME];
    must(find_answers(j, j->rows + first, j->columns != NULL ? j->columns + first : NULL, count, x,
                      W),
         j->kind);
    name_block(path, j, block);
    FILE *file = open_result(path);
    for (sl_int k = 0; k < count; k++) {
        if (j->columns == NULL) {
            (void)fprintf(file, "%d,%.17g\n", (int)j->rows[first + (size_t)k], x[k]);
        } else {
            (void)fprintf(file, "%d,%d,%.17g\n", (int)j->rows[first + (size_t)k],
                          (int)j->columns[first + (size_t)k], x[k]);
        }
    }
    close_result(file);
}

/* Answers blocks until there are no more. Returns how many. */
static int work(const job *j) {
    double *x = app_alloc((size_t)j->block, sizeof *x);
    sl_work *W = NULL;
    int done = 0;
    must(sl_work_create(&W, NULL), "workspace");
    for (sl_int block = take_block(j); block < j->n_blocks; block = take_block(j)) {
        answer_block(j, block, x, W);
        done++;
        if (j->rank == 0) {
            app_progress(j->kind, (double)block / (double)j->n_blocks);
        }
    }
    app_progress_end();
    sl_work_free(W);
    free(x);
    return done;
}

/* Rank 0: all blocks in one file, in their order. */
static void gather(const job *j) {
    char path[RESULT_NAME], *buffer = app_alloc(1 << 16, 1);
    (void)snprintf(path, sizeof path, "%s/%s.csv", j->folder, j->kind);
    FILE *all = open_result(path);
    for (sl_int block = 0; block < j->n_blocks; block++) {
        size_t got = 0;
        name_block(path, j, block);
        FILE *one = fopen(path, "rb");
        if (one == NULL) {
            fail("%s: %s", path, strerror(errno));
        }
        while ((got = fread(buffer, 1, 1 << 16, one)) > 0) {
            (void)fwrite(buffer, 1, got, all);
        }
        (void)fclose(one);
    }
    close_result(all);
    free(buffer);
}

static const char usage_text[] =
    "usage: mpiexec -n RANKS cluster-mpi FILE.slf|MESH adf FOLDER [BLOCK]\n"
    "       mpiexec -n RANKS cluster-mpi FILE.slf|MESH pairs FOLDER BLOCK COUNT\n"
    "Computes the diagonal of the inverse, or COUNT entries at random places, with a factor of\n"
    "sparse-local save. The answers are in FOLDER/adf.csv or pairs.csv, in elimination order. A "
    "job\n"
    "that was interrupted computes what is missing when it is started again.\n";

static int read_arguments(job *j, int argc, char **argv) {
    if (argc < 4 || (strcmp(argv[2], "adf") != 0 && strcmp(argv[2], "pairs") != 0)) {
        return 0;
    }
    j->operand = argv[1];
    j->kind = argv[2];
    j->folder = argv[3];
    j->block = argc > 4 ? (sl_int)atoi(argv[4]) : DEFAULT_BLOCK;
    j->count = argc > 5 ? atol(argv[5]) : 0;
    (void)snprintf(j->factor, sizeof j->factor, app_is_saved(j->operand) ? "%s" : "%s/factor.slf",
                   app_is_saved(j->operand) ? j->operand : j->folder);
    return j->block > 0 && (j->kind[0] == 'a' ? argc <= 5 : argc == 6) && j->count >= 0 &&
           j->count <= INT32_MAX && strlen(j->folder) < RESULT_NAME / 2;
}

int main(int argc, char **argv) {
    job j;
    memset(&j, 0, sizeof j);
    (void)MPI_Init(&argc, &argv);
    output_begin_program("cluster-mpi");
    (void)MPI_Comm_rank(MPI_COMM_WORLD, &j.rank);
    (void)MPI_Comm_size(MPI_COMM_WORLD, &j.ranks);
    if (!read_arguments(&j, argc, argv)) {
        if (j.rank == 0) {
            (void)fputs(usage_text, stderr);
        }
        (void)MPI_Finalize();
        return 2;
    }
    if (j.rank == 0) {
        provide_factor(&j);
    }
    (void)MPI_Barrier(MPI_COMM_WORLD);
    must(sl_load(&j.set, j.factor, NULL, 0, SL_LOAD_TRUSTED | SL_LOAD_MAPPED, NULL), j.factor);
    if (j.set.factor == NULL) {
        fail("%s: holds an analysis without a factor", j.factor);
    }
    choose_queries(&j);
    if (j.rank == 0) {
        check_folder(&j);
    }
    (void)MPI_Win_allocate(j.rank == 0 ? sizeof(int) : 0, sizeof(int), MPI_INFO_NULL,
                           MPI_COMM_WORLD, &j.next, &j.counter);
    if (j.rank == 0) {
        *j.next = 0;
    }
    (void)MPI_Barrier(MPI_COMM_WORLD);
    (void)MPI_Win_lock_all(0, j.counter);
    const double begin = app_now();
    const clock_t spent = clock();
    const int mine = work(&j);
    const double own = (double)(clock() - spent) / CLOCKS_PER_SEC;
    double processor = 0;
    int done = 0, most = 0;
    (void)MPI_Win_unlock_all(j.counter);
    (void)MPI_Reduce(&mine, &done, 1, MPI_INT, MPI_SUM, 0, MPI_COMM_WORLD);
    (void)MPI_Reduce(&own, &processor, 1, MPI_DOUBLE, MPI_SUM, 0, MPI_COMM_WORLD);
    (void)MPI_Reduce(&mine, &most, 1, MPI_INT, MPI_MAX, 0, MPI_COMM_WORLD);
    if (j.rank == 0) {
        const double seconds = app_now() - begin;
        gather(&j);
        printf("%s: %ld queries in %d blocks, %d of them now by %d ranks, at most %d by one; "
               "%.3f s, %.3f s of processors\n",
               j.kind, j.count, (int)j.n_blocks, done, j.ranks, most, seconds, processor);
    }
    free(j.rows);
    free(j.columns);
    sl_saved_set_free(&j.set);
    (void)MPI_Win_free(&j.counter);
    (void)MPI_Finalize();
    return 0;
}

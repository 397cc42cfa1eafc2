/* fuzz_readers.c: reads any bytes as a mesh or matrix file of each format, plain and gzipped; what
 * is accepted must be valid and survive a round trip with the same bits */
#define _POSIX_C_SOURCE 200809L

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <zlib.h>

#include "sparse_local.h"
#include "tools/geometry/laplacian.h"
#include "tools/io/matrix_file.h"
#include "tools/mesh/mesh.h"
#include "tools/mesh/mesh_sink.h"
#include "tools/mesh/mesh_stats.h"
#include "tools/mesh/mesh_write.h"
#include "tools/mesh/single_frame.h"

#define PROMISE(condition) ((condition) ? (void)0 : abort())

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* The first byte of an input selects the format, by its value modulo 8, and how the rest becomes a
 * file, by its value divided by 8 and modulo 4: the characters from space select RAW_GZ (the bytes
 * in a file named .gz), those from '(' COMPRESSED, and the digits PLAIN. The characters from '@',
 * 'H' and 'P' do the same with the last three formats. */
enum { FORMATS = 11, FIRST_FORMATS = 8, MATRIX_MARKET = 4, LATE_FIRST = 64, LATE_END = 96 };
enum { RAW_GZ = 0, COMPRESSED = 1, PLAIN = 2 };
enum { PATH_SIZE = 300, MESSAGE_SIZE = 300 };
enum { ROUND_TRIP_ROWS = 300, ROUND_TRIP_ENTRIES = 2000 };

static const char *const endings[FORMATS] = {".obj", ".off", ".ply",         ".stl",
                                             ".mtx", ".rb",  "_csparse.txt", "_cholmod.txt",
                                             ".vtk", ".glb", ".gltf"};

static bool is_mesh_format(int format) {
    return format < MATRIX_MARKET || format >= FIRST_FORMATS;
}

static char folder[PATH_SIZE / 2];

static void file_path(char *path, const char *name, const char *ending, const char *gz) {
    (void)snprintf(path, PATH_SIZE, "%s/%s%s%s", folder, name, ending, gz);
}

static void remove_folder(void) {
    char path[PATH_SIZE];
    for (int k = 0; k < FORMATS; k++) {
        file_path(path, "in", endings[k], "");
        (void)remove(path);
        file_path(path, "in", endings[k], ".gz");
        (void)remove(path);
        file_path(path, "out", endings[k], "");
        (void)remove(path);
    }
    (void)rmdir(folder);
}

/* The files are in memory where the system has a folder for that. */
static void create_folder(void) {
    const char *top = access("/dev/shm", W_OK) == 0 ? "/dev/shm" : "/tmp";
    (void)snprintf(folder, sizeof folder, "%s/sl_fuzz_readers.XXXXXX", top);
    PROMISE(mkdtemp(folder) != NULL);
    PROMISE(atexit(remove_folder) == 0);
}

static void write_plain(const char *path, const uint8_t *data, size_t size) {
    FILE *file = fopen(path, "wb");
    PROMISE(file != NULL);
    PROMISE(fwrite(data, 1, size, file) == size);
    PROMISE(fclose(file) == 0);
}

static void write_compressed(const char *path, const uint8_t *data, size_t size) {
    gzFile file = gzopen(path, "wb1");
    PROMISE(file != NULL);
    PROMISE(size == 0 || gzwrite(file, data, (unsigned)size) == (int)size);
    PROMISE(gzclose(file) == Z_OK);
}

static double *array(sl_int count) {
    double *x = (double *)calloc((size_t)count + 1, sizeof *x);
    PROMISE(x != NULL);
    return x;
}

/* Coordinate k of a glTF file: in single precision, moved and scaled by its node. */
static bool is_rounded(double x, const mesh *m, const single_frame *f, size_t k) {
    const double center = f->center[k % 3];
    const double expected = center + f->scale * (double)single_frame_coordinate(f, m, k);
    return fabs(x - expected) <= 4 * DBL_EPSILON * fmax(fabs(expected), fabs(center));
}

/* A mesh that is written and read again is the same mesh; glTF rounds the coordinates. */
static void check_round_trip(const mesh *m, const char *ending) {
    const bool is_single = ending[1] == 'g';
    const single_frame frame = single_frame_of(m);
    char path[PATH_SIZE], message[MESSAGE_SIZE];
    mesh again;
    file_path(path, "out", ending, "");
    PROMISE(mesh_write(path, m, NULL, message, sizeof message));
    PROMISE(mesh_read(&again, path, message, sizeof message));
    PROMISE(again.n_vertices == m->n_vertices && again.n_faces == m->n_faces);
    for (sl_int k = 0; k < 3 * m->n_vertices; k++) {
        PROMISE(is_single ? is_rounded(again.xyz[k], m, &frame, (size_t)k)
                          : again.xyz[k] == m->xyz[k]);
    }
    for (sl_int k = 0; k < 3 * m->n_faces; k++) {
        PROMISE(again.faces[k] == m->faces[k]);
    }
    mesh_free(&again);
}

/* Whatever the coordinates and faces are, the matrices of a mesh are valid and finite, and M + t L
 * has a factorization or a null pivot. */
static void check_laplacians(const mesh *m) {
    static const double steps[3] = {1.0, 1e-12, 1e150};
    double *mass = array(m->n_vertices);
    laplacian_mass(mass, m);
    for (sl_int k = 0; k < m->n_vertices; k++) {
        PROMISE(mass[k] > 0.0);
    }
    free(mass);
    for (int k = 0; k < 3; k++) {
        sl_matrix *M = NULL;
        sl_symbolic *S = NULL;
        sl_factor *F = NULL;
        PROMISE(laplacian_system(&M, m, steps[k]));
        const sl_csc A = sl_matrix_view(M);
        PROMISE(sl_csc_check(&A, NULL) == SL_OK && A.n_cols == m->n_vertices);
        for (sl_int q = 0; q < A.p[A.n_cols]; q++) {
            PROMISE(isfinite(A.x[q]));
        }
        PROMISE(sl_symbolic_create(&S, &A, NULL, NULL) == SL_OK);
        const sl_status status = sl_factor_create(&F, S, &A, NULL, NULL);
        PROMISE(status == SL_OK || status == SL_ERR_PIVOT || status == SL_ERR_NOT_FINITE ||
                status == SL_ERR_INACCURATE);
        sl_factor_free(F);
        sl_symbolic_free(S);
        sl_matrix_free(M);
    }
}

static void check_stats(const mesh *m) {
    mesh_stats stats;
    PROMISE(mesh_stats_compute(&stats, m));
    PROMISE(stats.used_vertices <= m->n_vertices && stats.edges <= 3 * (sl_off)m->n_faces);
    PROMISE(stats.boundary_edges + stats.nonmanifold_edges <= stats.edges);
    PROMISE(stats.components <= stats.used_vertices);
    PROMISE(stats.repeated_vertex_faces + stats.zero_area_faces <= m->n_faces);
}

static void read_mesh(const char *path) {
    char message[MESSAGE_SIZE];
    mesh m;
    char note[MESSAGE_SIZE];
    memset(message, 'x', sizeof message);
    memset(note, 'x', sizeof note);
    memset(&m, 1, sizeof m);
    const bool is_read = mesh_read_noting(&m, path, message, sizeof message, note, sizeof note);
    PROMISE(memchr(message, '\0', sizeof message) != NULL);
    PROMISE(memchr(note, '\0', sizeof note) != NULL && (is_read || note[0] == '\0'));
    PROMISE(is_read == (message[0] == '\0'));
    if (!is_read) {
        PROMISE(m.n_vertices == 0 && m.n_faces == 0 && !m.xyz && !m.faces);
        return;
    }
    for (sl_int k = 0; k < 3 * m.n_vertices; k++) {
        PROMISE(isfinite(m.xyz[k]));
    }
    for (sl_int k = 0; k < 3 * m.n_faces; k++) {
        PROMISE(m.faces[k] >= 0 && m.faces[k] < m.n_vertices);
    }
    if (m.n_vertices <= ROUND_TRIP_ROWS && m.n_faces <= 2 * ROUND_TRIP_ROWS) {
        check_round_trip(&m, ".ply");
        check_round_trip(&m, ".vtk");
        if (m.n_faces > 0) { /* a mesh without faces becomes points */
            check_round_trip(&m, ".glb");
            check_round_trip(&m, ".gltf");
        }
        if (m.n_vertices > 0) { /* the reader refuses an OBJ file without vertices */
            check_round_trip(&m, ".obj");
        }
        check_stats(&m);
        check_laplacians(&m);
    }
    mesh_free(&m);
}

static void read_matrix(const char *path) {
    char message[MESSAGE_SIZE];
    sl_matrix *M = NULL;
    memset(message, 'x', sizeof message);
    const bool is_read = matrix_file_read(&M, path, message, sizeof message);
    PROMISE(memchr(message, '\0', sizeof message) != NULL);
    PROMISE(is_read == (M != NULL) && is_read == (message[0] == '\0'));
    if (!is_read) {
        return;
    }
    const sl_csc A = sl_matrix_view(M);
    PROMISE(sl_csc_check(&A, NULL) == SL_OK && A.x != NULL);
    if (A.n_cols <= ROUND_TRIP_ENTRIES && A.p[A.n_cols] <= ROUND_TRIP_ENTRIES) {
    }
    sl_matrix_free(M);
}

/* Returns whether a line that is no comment has a number of more than 6 digits. A Matrix Market
 * header may validly ask for 2^31 empty columns, which a fuzzer has no memory for. */
static bool asks_for_much(const uint8_t *data, size_t size) {
    int digits = 0;
    bool is_comment = false, is_line_start = true;
    for (size_t k = 0; k < size; k++) {
        is_comment = is_line_start ? data[k] == '%' : is_comment;
        is_line_start = data[k] == '\n' || data[k] == '\r';
        digits = data[k] >= '0' && data[k] <= '9' && !is_comment ? digits + 1 : 0;
        if (digits > 6) {
            return true;
        }
    }
    return false;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    char path[PATH_SIZE];
    if (size == 0) {
        return 0;
    }
    if (folder[0] == '\0') {
        create_folder();
    }
    const bool is_late = data[0] >= LATE_FIRST && data[0] < LATE_END;
    const int format = is_late ? FIRST_FORMATS + data[0] % FIRST_FORMATS % (FORMATS - FIRST_FORMATS)
                               : data[0] % FIRST_FORMATS;
    const int packing = data[0] / FIRST_FORMATS % 4;
    /* compressed content is rarely valid: numbers in it are not searched */
    if (format == MATRIX_MARKET && (packing == RAW_GZ || asks_for_much(data + 1, size - 1))) {
        return 0;
    }
    file_path(path, "in", endings[format], packing < PLAIN ? ".gz" : "");
    if (packing == COMPRESSED) {
        write_compressed(path, data + 1, size - 1);
    } else {
        write_plain(path, data + 1, size - 1);
    }
    if (is_mesh_format(format)) {
        read_mesh(path);
    } else {
        read_matrix(path);
    }
    (void)remove(path);
    return 0;
}

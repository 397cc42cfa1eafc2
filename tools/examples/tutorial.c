/* tutorial.c: a mesh is loaded, warmed, measured, laid flat, pulled, changed, and its factor saved
 *
 * The steps of the tutorial, tools/docs/tutorial.md, which shows the sections of this file. Its
 * argument is the mesh, by default hill.obj. It writes map.obj, pulled.obj, changed.obj and
 * hill.slf. */
#define SL_WITH_CHANGE
#define SL_WITH_CONSTRAINTS
#define SL_WITH_FIXED
#define SL_WITH_SAVE
#include "example.h"

enum { MOST = 1000, MOST_FACES = 2 * MOST, TOP = 468, OTHER = 263 };
static double vertex[MOST][3];
static sl_int face[MOST_FACES][3], n, n_faces;

static sl_matrix *laplacian, *heat_matrix; /* K and M + t K */
static sl_csc K, H;
static sl_symbolic *S;
static sl_factor *heat, *poisson; /* of H and of K */
static double u[MOST], distance[MOST];
static sl_int border[MOST], n_border;

/* ---- load ---- */
static void load(const char *path) {
    char line[200];
    FILE *file = fopen(path, "r");
    while (file != NULL && fgets(line, sizeof line, file) != NULL && n < MOST) {
        double *v = vertex[n];
        int f[3];
        if (sscanf(line, "v %lf %lf %lf", v, v + 1, v + 2) == 3) n++;
        if (sscanf(line, "f %d %d %d", f, f + 1, f + 2) != 3 || n_faces == MOST_FACES) continue;
        for (int k = 0; k < 3; k++)
            face[n_faces][k] = f[k] - 1; /* files count from 1 */
        n_faces++;
    }
    if (file != NULL) fclose(file);
}
/* ---- edges ---- */
static double dot(const double *a, const double *b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* The edge of face f that is opposite to its corner k. */
static void edge(sl_int f, int k, double *e) {
    const double *from = vertex[face[f][(k + 1) % 3]], *to = vertex[face[f][(k + 2) % 3]];
    for (int d = 0; d < 3; d++)
        e[d] = to[d] - from[d];
}
/* ---- matrix ---- */
/* m M + t K: the masses of the vertices and the cotangent Laplacian; the lower triangle. */
static sl_matrix *combine(double m, double t) {
    static sl_int i[12 * MOST_FACES], j[12 * MOST_FACES];
    static double a[12 * MOST_FACES];
    sl_matrix *A = NULL;
    sl_int count = 0;
    for (sl_int f = 0; f < n_faces; f++) {
        for (int k = 0; k < 3; k++) { /* corner p, between its edges to q and to r */
            const sl_int p = face[f][k], q = face[f][(k + 1) % 3], r = face[f][(k + 2) % 3];
            double to_q[3], to_r[3];
            edge(f, (k + 2) % 3, to_q);
            edge(f, (k + 1) % 3, to_r);
            const double c = -dot(to_q, to_r); /* edges run around the face */
            const double area = sqrt(dot(to_q, to_q) * dot(to_r, to_r) - c * c) / 2;
            const double w = t * c / (4 * area); /* t times half the cotangent at p */
            const sl_int rows[] = {p, q, r, q > r ? q : r}, columns[] = {p, q, r, q > r ? r : q};
            const double values[] = {m * area / 3, w, w, -w};
            for (int e = 0; e < 4; e++, count++) {
                i[count] = rows[e], j[count] = columns[e], a[count] = values[e];
            }
        }
    }
    ok(sl_matrix_from_triplets(&A, n, n, count, i, j, a, NULL, NULL)); /* sums duplicates */
    return A;
}
/* ---- end ---- */

static void make_matrices(void) {
    /* ---- matrices ---- */
    laplacian = combine(0.0, 1.0);
    heat_matrix = combine(1.0, 0.004); /* t is about the square of an edge */
    K = sl_matrix_view(laplacian);
    H = sl_matrix_view(heat_matrix);
    ok(sl_symbolic_create(&S, &K, NULL, NULL)); /* one pattern: one analysis for both */
    /* ---- end ---- */
}

static void warm(void) {
    static double b[MOST];
    /* ---- heat ---- */
    ok(sl_factor_create(&heat, S, &H, NULL, NULL));
    b[TOP] = 1.0;                                         /* a unit of heat at one vertex */
    ok(sl_factor_solve(heat, u, MOST, b, MOST, 1, NULL)); /* u everywhere */
    /* ---- local ---- */
    const sl_int source[] = {TOP}, wanted[] = {TOP, TOP + 1, OTHER};
    double x[3];
    sl_plan *P = NULL;
    ok(sl_plan_create(&P, S, source, 1, wanted, 3, NULL, NULL)); /* once */
    ok(sl_plan_solve(P, heat, x, 3, b + TOP, 1, 1, NULL));       /* as often as you like */
    printf("heat: %g at the top, %g beside it, %g on the other hill\n", x[0], x[1], x[2]);
    sl_plan_free(P);
    /* ---- end ---- */
    if (x[1] != u[TOP + 1] || x[2] != u[OTHER]) exit(1); /* the bits of the full solve */
}

/* ---- divergence ---- */
/* b = the divergence of the unit field along which u falls. */
static void divergence(double *b) {
    for (sl_int k = 0; k < n; k++)
        b[k] = 0.0;
    for (sl_int f = 0; f < n_faces; f++) {
        double e[3][3], w[3] = {0, 0, 0};
        for (int k = 0; k < 3; k++) {
            edge(f, k, e[k]);
            for (int d = 0; d < 3; d++)
                w[d] += u[face[f][k]] * e[k][d];
        } /* w is the gradient of u, turned by 90 degrees and scaled by twice the area */
        for (int k = 0; k < 3; k++)
            b[face[f][k]] -= dot(w, e[k]) / (2 * sqrt(dot(w, w)));
    }
}
/* ---- end ---- */

static void measure(void) {
    static double b[MOST];
    /* ---- distance ---- */
    sl_options options = {0};
    options.pivots = SL_PIVOTS_SKIP_NULL; /* K is singular: K 1 = 0 */
    ok(sl_factor_create(&poisson, S, &K, &options, NULL));
    divergence(b);
    ok(sl_factor_solve(poisson, distance, MOST, b, MOST, 1, NULL)); /* up to a constant */
    const double at_top = distance[TOP];
    for (sl_int k = 0; k < n; k++)
        distance[k] -= at_top;
    printf("the tops are %.3f apart on the surface\n", distance[OTHER]);
    /* ---- end ---- */
    if (!(distance[OTHER] > 0.79 && distance[OTHER] < 1.5)) exit(1); /* 0.79 in the plane */
}

/* Where the edge from a vertex of the border leads; -1: the vertex is inside. */
static void find_border(sl_int *next) {
    for (sl_int k = 0; k < n; k++)
        next[k] = -1;
    for (sl_int f = 0; f < 3 * n_faces; f++) {
        const sl_int a = face[f / 3][f % 3], b = face[f / 3][(f + 1) % 3];
        sl_int g = 0; /* is there a face on the other side? */
        while (g < 3 * n_faces && (face[g / 3][g % 3] != b || face[g / 3][(g + 1) % 3] != a))
            g++;
        if (g == 3 * n_faces) next[a] = b;
    }
    sl_int k = 0;
    while (next[k] < 0)
        k++;
    for (sl_int at = next[k]; n_border == 0 || border[n_border - 1] != k; at = next[at]) {
        border[n_border++] = at;
    }
}

static void write_mesh(const char *path, double (*points)[3]) {
    FILE *file = fopen(path, "w");
    if (file == NULL) exit(1);
    for (sl_int k = 0; k < n; k++) {
        fprintf(file, "v %.9g %.9g %.9g\n", points[k][0], points[k][1], points[k][2]);
    }
    for (sl_int f = 0; f < n_faces; f++) {
        fprintf(file, "f %d %d %d\n", (int)face[f][0] + 1, (int)face[f][1] + 1,
                (int)face[f][2] + 1);
    }
    if (fclose(file) != 0) exit(1);
}

static void lay_flat(void) {
    static double uv[2 * MOST], flat[MOST][3], circle[2 * MOST];
    static sl_int next[MOST];
    find_border(next);
    /* ---- map ---- */
    for (sl_int k = 0; k < n_border; k++) {
        const double angle = 6.283185307179586 * k / n_border;
        circle[2 * k] = cos(angle), circle[2 * k + 1] = sin(angle);
    }
    sl_fixed *D = NULL;
    ok(sl_fixed_create(&D, &K, border, n_border, NULL, NULL));
    ok(sl_fixed_solve(D, uv, SL_ROWS(2), NULL, 0, circle, SL_ROWS(2), 2, NULL));
    sl_fixed_free(D);
    for (sl_int k = 0; k < n; k++)
        flat[k][0] = uv[2 * k], flat[k][1] = uv[2 * k + 1];
    write_mesh("map.obj", flat);
    /* ---- end ---- */
    if (!(hypot(uv[2 * TOP], uv[2 * TOP + 1]) < 1.0)) exit(1);
}

static void pull(void) {
    static double zero[MOST], lift[MOST], values[MOST], pulled[MOST][3];
    const sl_int handle = TOP;
    /* ---- handle ---- */
    sl_constraints *P = NULL;
    ok(sl_constraints_create(&P, poisson, NULL));
    ok(sl_constraints_add(P, border, NULL, n_border, NULL)); /* these stay */
    ok(sl_constraints_add(P, &handle, NULL, 1, NULL));       /* this one is moved */
    for (int frame = 1; frame <= 10; frame++) {
        values[n_border] = 0.1 * frame; /* pins are numbered in the order of their additions */
        ok(sl_constraints_solve(P, NULL, lift, MOST, zero, MOST, values, MOST, 1, NULL));
    }
    sl_constraints_free(P);
    /* ---- end ---- */
    for (sl_int k = 0; k < n; k++) {
        for (int d = 0; d < 3; d++)
            pulled[k][d] = vertex[k][d] + (d == 2 ? lift[k] : 0.0);
    }
    write_mesh("pulled.obj", pulled);
    if (!(fabs(lift[TOP] - 1.0) < 1e-12 && lift[OTHER] > 0.0 && lift[OTHER] < 1.0)) exit(1);
}

/* Vertex v and its neighbors: the columns that change when v moves. */
static sl_int around(sl_int v, sl_int *columns) {
    sl_int count = 0;
    for (sl_int j = 0; j < n; j++) {
        int is_near = 0;
        for (sl_int p = K.p[j]; p < K.p[j + 1]; p++)
            is_near |= K.i[p] == v;
        for (sl_int p = K.p[v]; p < K.p[v + 1]; p++)
            is_near |= K.i[p] == j;
        if (is_near) columns[count++] = j;
    }
    return count;
}

static void change(void) {
    static double b[MOST], anew[MOST];
    static sl_int columns[MOST];
    double error = 0.0;
    /* ---- change ---- */
    vertex[TOP][2] += 0.4; /* a spike: the weights around this vertex change */
    sl_matrix_free(heat_matrix);
    heat_matrix = combine(1.0, 0.004);
    H = sl_matrix_view(heat_matrix);
    const sl_int count = around(TOP, columns); /* the vertex and its neighbors */
    ok(sl_factor_change_entries(heat, &H, NULL, columns, NULL, count, NULL, NULL));
    b[TOP] = 1.0;
    ok(sl_factor_solve(heat, u, MOST, b, MOST, 1, NULL));
    printf("on the spike %g stays\n", u[TOP]);
    /* ---- end ---- */
    write_mesh("changed.obj", vertex);
    ok(sl_factor_refactor(heat, &H, NULL)); /* for comparison */
    ok(sl_factor_solve(heat, anew, MOST, b, MOST, 1, NULL));
    for (sl_int k = 0; k < n; k++)
        error = fmax(error, fabs(u[k] - anew[k]));
    if (!(error < 1e-12 * u[TOP])) exit(1);
}

static void save(void) {
    static double b[MOST], again[MOST];
    b[TOP] = 1.0;
    ok(sl_factor_solve(heat, u, MOST, b, MOST, 1, NULL));
    /* ---- save ---- */
    sl_saved_set set = {0}, got = {0};
    set.symbolic = S;
    set.factor = heat;
    ok(sl_save("hill.slf", NULL, NULL, &set, NULL));
    ok(sl_load(&got, "hill.slf", NULL, 0, SL_LOAD_MAPPED, NULL)); /* here or in another process */
    ok(sl_factor_solve(got.factor, again, MOST, b, MOST, 1, NULL));
    printf("from the file: %g\n", again[TOP]);
    sl_saved_set_free(&got);
    /* ---- end ---- */
    if (again[TOP] != u[TOP]) exit(1);
}

int main(int argc, char **argv) {
    const char *path = argc > 1 ? argv[1] : "hill.obj";
    load(path);
    if (n <= TOP || n_faces == 0) {
        fprintf(stderr, "%s is not the mesh tools/examples/hill.obj\n", path);
        return 1;
    }
    printf("%d vertices, %d faces\n", (int)n, (int)n_faces);
    make_matrices();
    warm();
    measure();
    lay_flat();
    pull();
    change();
    save();
    /* ---- free ---- */
    sl_factor_free(heat);
    sl_factor_free(poisson);
    sl_symbolic_free(S);
    sl_matrix_free(laplacian);
    sl_matrix_free(heat_matrix);
    /* ---- end ---- */
    return 0;
}

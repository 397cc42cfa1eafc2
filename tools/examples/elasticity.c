/* elasticity.c: a plate without supports, pulled apart: three null vectors, the rigid motions */
#include "example.h"

enum { ROWS = 2 * N, ENTRIES = 4 * 10 * N };

static sl_int i[ENTRIES], j[ENTRIES], count;
static double e[ENTRIES];

/* A spring between vertices a and b of the grid: the lower triangle of (d; -d) (d; -d)', where d is
 * its direction. */
static void add_spring(sl_int a, sl_int b) {
    const double dx = b % SIDE - a % SIDE, dy = b / SIDE - a / SIDE;
    const double length = sqrt(dx * dx + dy * dy);
    const sl_int rows[4] = {2 * a, 2 * a + 1, 2 * b, 2 * b + 1};
    const double d[4] = {dx / length, dy / length, -dx / length, -dy / length};
    int r, c;
    for (c = 0; c < 4; c++) {
        for (r = 0; r < 4; r++) {
            if (rows[r] >= rows[c]) {
                i[count] = rows[r];
                j[count] = rows[c];
                e[count++] = d[r] * d[c];
            }
        }
    }
}

int main(void) {
    sl_matrix *M = NULL;
    sl_csc A;
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    static double rigid[3 * ROWS], b[ROWS], x[ROWS];
    sl_options opt;
    sl_stats stats;
    double longer;
    sl_status moved;
    sl_int v;
    for (v = 0; v < N; v++) {
        const int right = (v + 1) % SIDE != 0, below = v + SIDE < N;
        if (right) {
            add_spring(v, v + 1);
        }
        if (below) {
            add_spring(v, v + SIDE);
        }
        if (right && below) {
            add_spring(v, v + SIDE + 1);
        }
        rigid[2 * v] = 1.0;                    /* to the right */
        rigid[ROWS + 2 * v + 1] = 1.0;         /* down */
        rigid[2 * ROWS + 2 * v] = -(v / SIDE); /* around vertex 0 */
        rigid[2 * ROWS + 2 * v + 1] = v % SIDE;
        b[2 * v] = v % SIDE == 0 ? -1.0 : !right ? 1.0 : 0.0; /* both sides are pulled */
    }
    ok(sl_matrix_from_triplets(&M, ROWS, ROWS, count, i, j, e, NULL, NULL));
    A = sl_matrix_view(M);
    ok(sl_symbolic_create(&S, &A, NULL, NULL));
    /* ---- null-vectors ---- */
    sl_options_init(&opt, sizeof opt);
    opt.pivots = SL_PIVOTS_SKIP_NULL;
    opt.null_vector = rigid;
    opt.null_vector_count = 3;
    ok(sl_factor_create(&F, S, &A, &opt, &stats));
    ok(sl_factor_solve(F, x, ROWS, b, ROWS, 1, NULL));
    /* ---- end ---- */
    longer = x[2 * (SIDE - 1)] - x[0];
    b[0] += 0.5; /* now a force remains, which moves the plate */
    moved = sl_factor_solve(F, b, ROWS, b, ROWS, 1, NULL);
    printf("%d null pivots; the upper edge is longer by %g; a single force: %s\n",
           (int)stats.factor.null, longer, sl_status_string(moved));
    sl_factor_free(F);
    sl_symbolic_free(S);
    sl_matrix_free(M);
    return !(stats.factor.null == 3 && longer > 0.0 && moved == SL_ERR_INCONSISTENT);
}

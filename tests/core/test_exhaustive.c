/* test_exhaustive.c: every pattern up to n = 5 with every b-set and x-set against dense solves */
#include "tests/lib/check_factor.h"

enum { MOST = 5 };

/* the members of a set as rows, ascending or descending: the order must not matter */
static sl_int members(unsigned set, sl_int n, sl_int *rows) {
    sl_int count = 0;
    for (sl_int k = 0; k < n; k++) {
        sl_int row = set % 3 ? k : n - 1 - k;
        if (set >> row & 1u) {
            rows[count++] = row;
        }
    }
    return count;
}

typedef struct tally_t {
    long solves, wrong;
    double worst; /* |x - reference| / bound */
} tally_t;

/* all pairs of sets for one factor */
static void check_all_sets(const sl_symbolic *S, const sl_factor *F, sl_int n, const double *Z,
                           sl_work *W, tally_t *tally) {
    double values[MOST], largest = 0;
    gen_reals(values, MOST, 11);
    for (sl_int q = 0; q < n * n; q++) {
        largest = fabs(Z[q]) > largest ? fabs(Z[q]) : largest;
    }
    for (unsigned b = 0; b < 1u << n; b++) {
        sl_int bset[MOST], nb = members(b, n, bset);
        double full[MOST] = {0}, exact[MOST] = {0}, B[MOST];
        for (sl_int k = 0; k < nb; k++) {
            full[bset[k]] = B[k] = values[bset[k]];
            for (sl_int i = 0; i < n; i++) {
                exact[i] += AT(Z, i, bset[k]) * B[k];
            }
        }
        SL_CHECK(sl_factor_solve(F, full, (size_t)n, full, (size_t)n, 1, W));
        for (unsigned x = 0; x < 1u << n; x++) {
            sl_int xset[MOST], nx = members(x, n, xset);
            double X[MOST];
            /* with a plan for some: the code below is the same */
            if ((b + x) % 8 == 0) {
                sl_plan *P = NULL;
                SL_CHECK(sl_plan_create(&P, S, bset, nb, xset, nx, NULL, NULL));
                SL_CHECK(sl_plan_solve(P, F, X, (size_t)n, B, (size_t)n, 1, W));
                sl_plan_free(P);
            } else {
                SL_CHECK(
                    sl_local_solve(F, bset, nb, xset, nx, X, (size_t)n, B, (size_t)n, 1, W, NULL));
            }
            tally->solves++;
            for (sl_int k = 0; k < nx; k++) {
                /* each row is dominant by 1, so |A^-1| <= 1, |A| <= 10, and the bound is 10 n n
                 * eps */
                double off =
                    fabs(X[k] - exact[xset[k]]) / (10.0 * (double)(n * n) * DBL_EPSILON * largest);
                tally->worst = off > tally->worst ? off : tally->worst;
                tally->wrong += !same_value(X[k], full[xset[k]]) || !(off <= 1.0);
            }
        }
    }
}

static void local_solves_are_right_for_every_pattern_and_every_set(void **state) {
    (void)state;
    isa_list_t isas = isas_present();
    const sl_isa tried[2] = {SL_ISA_SCALAR, isas.isa[isas.count - 1]};
    tally_t tally = {0, 0, 0};
    sl_work *W = NULL;
    SL_CHECK(sl_work_create(&W, NULL));
    for (sl_int n = 0; n <= MOST; n++) {
        for (unsigned edges = 0; edges < 1u << (n * (n - 1) / 2); edges++) {
            gen_matrix_t M = gen_pattern(n, edges, edges + 1000u * (unsigned)n);
            double *D = ref_dense(&M.view), *Z = ref_inverse(n, D);
            for (int which = 0; which < 4; which++) {
                sl_options opt = options_none();
                sl_symbolic *S = NULL;
                sl_factor *F = NULL;
                opt.ordering =
                    SL_ORDERING_NATURAL; /* all relabelings of a pattern are among the patterns */
                opt.relaxation = which % 2 ? SL_RELAXATION_NONE : SL_RELAXATION_DEFAULT;
                opt.isa = tried[which / 2];
                SL_CHECK(sl_symbolic_create(&S, &M.view, FOR_ANALYSIS(&opt), NULL));
                SL_CHECK(sl_factor_create(&F, S, &M.view, FOR_FACTOR(&opt), NULL));
                if (which % 2) {
                    sl_symbolic_arrays v = sl_symbolic_view(S);
                    NOTHING_WRONG(check_supernodes(&v));
                    NOTHING_WRONG(check_structure(&v, &M.view, 1));
                    NOTHING_WRONG(check_factor(F, &M.view));
                }
                check_all_sets(S, F, n, Z, W, &tally);
                if (tally.wrong) {
                    print_error("n = %d, edges %u, isa %d, relaxation %d\n", (int)n, edges,
                                (int)opt.isa, which % 2);
                    fail();
                }
                sl_factor_free(F);
                sl_symbolic_free(S);
            }
            free(D);
            free(Z);
            gen_matrix_free(&M);
        }
    }
    print_message("%ld local solves, largest error %.2g of the bound\n", tally.solves, tally.worst);
    sl_work_free(W);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(local_solves_are_right_for_every_pattern_and_every_set),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

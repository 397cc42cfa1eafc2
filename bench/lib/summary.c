/* summary.c: what the rows of a run say to a newcomer, in words */
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench.h"

enum { NAME = 40 };

typedef struct kept_row {
    char question[NAME], system[64], what[NAME], method[NAME];
    sl_int n, threads, nrhs;
    double seconds;
} kept_row;

static struct {
    kept_row *rows;
    int count, room;
} kept;

void bench_summary_keep(const char *question, const bench_system *system, const bench_row *row) {
    if (kept.count == kept.room) {
        kept_row *rows;
        kept.room = 2 * kept.room + 64;
        rows = realloc(kept.rows, (size_t)kept.room * sizeof *rows);
        bench_must(rows ? SL_OK : SL_ERR_MEMORY, "keeping rows");
        kept.rows = rows;
    }
    kept_row *to = &kept.rows[kept.count++];
    snprintf(to->question, sizeof to->question, "%s", question);
    snprintf(to->system, sizeof to->system, "%s", system->name);
    snprintf(to->what, sizeof to->what, "%s", row->what);
    snprintf(to->method, sizeof to->method, "%s", row->method);
    to->n = system->n;
    to->threads = row->threads > 1 ? row->threads : 1;
    to->nrhs = row->nrhs;
    to->seconds = row->time.median;
}

/* The row of one thread on the largest system, or on `system` if it is not NULL. NULL: none. */
static const kept_row *find(const char *question, const char *what, const char *method, sl_int nrhs,
                            const char *system) {
    const kept_row *found = NULL;
    for (int k = 0; k < kept.count; k++) {
        const kept_row *r = &kept.rows[k];
        if (strcmp(r->question, question) == 0 && strcmp(r->what, what) == 0 &&
            strcmp(r->method, method) == 0 && r->threads == 1 && r->nrhs == nrhs &&
            (system ? strcmp(r->system, system) == 0 : !found || r->n >= found->n)) {
            found = r;
        }
    }
    return found;
}

/* "49.9 us" without blanks at its end. A few texts may be in use at once. */
static const char *time_of(double seconds) {
    static char texts[4][32];
    static int next;
    char *text = texts[next++ % 4];
    bench_time_text(text, sizeof texts[0], seconds);
    while (text[strlen(text) - 1] == ' ') {
        text[strlen(text) - 1] = '\0';
    }
    return text;
}

/* ---- a sentence or two for each question that a newcomer has ---- */

static void say_cold(void) {
    const kept_row *all = find("cold", "many solves", "together", 0, NULL);
    if (all) {
        const kept_row *order = find("cold", "many solves", "order", 0, all->system);
        const kept_row *one = find("cold", "one factor", "together", 0, all->system);
        printf("- %s, n %d: from the matrix to the first solution in %s, %.0f %% of it ordering;\n"
               "  %s if one factor is all that is wanted (SL_PURPOSE_ONE_FACTOR).\n",
               all->system, (int)all->n, time_of(all->seconds), 100 * order->seconds / all->seconds,
               time_of(one->seconds));
    }
}

static void say_vertex(void) {
    const kept_row *local = find("locality", "vertex", "plan solve", 1, NULL);
    if (local) {
        const kept_row *full = find("locality", "vertex", "full solve", 1, local->system);
        const kept_row *least = local;
        for (int k = 0; k < kept.count; k++) {
            const kept_row *r = &kept.rows[k];
            least = strcmp(r->what, local->what) == 0 && strcmp(r->method, local->method) == 0 &&
                            strcmp(r->question, local->question) == 0 && r->n < least->n
                        ? r
                        : least;
        }
        printf("- A question about one vertex takes %s on a plan there, 1/%.0f of a full solve.\n",
               time_of(local->seconds), full->seconds / local->seconds);
        if (least != local) {
            printf("  It takes %s at n %d.\n", time_of(least->seconds), (int)least->n);
        }
    }
}

static void say_patch(void) {
    const kept_row *local = find("patches", "patch 2000", "plan solve", 2, NULL);
    if (local) {
        const kept_row *own =
            find("patches", "patch 2000", "refactorize the patch", 2, local->system);
        const kept_row *cg = find("patches", "patch 2000", "conjugate gradients", 2, local->system);
        printf("- A patch of 2000 vertices takes %s. A factor of its own would take %.1f times as "
               "long,\n  conjugate gradients %.0f times.\n",
               time_of(local->seconds), own->seconds / local->seconds,
               cg->seconds / local->seconds);
    }
}

static void say_multi_rhs(void) {
    const kept_row *eight = find("multi_rhs", "full", "together", 8, NULL);
    if (eight) {
        const kept_row *apart = find("multi_rhs", "full", "one by one", 8, eight->system);
        printf("- Eight right-hand sides in one call are %.1f times as fast as eight calls.\n",
               apart->seconds / eight->seconds);
    }
}

static void say_harmonic(void) {
    const kept_row *factor = NULL;
    for (int k = 0; k < kept.count; k++) {
        const kept_row *r = &kept.rows[k];
        factor = strcmp(r->question, "harmonic") == 0 && strcmp(r->method, "refactor") == 0 &&
                         strncmp(r->system, "biharmonic", 10) == 0
                     ? r
                     : factor;
    }
    if (factor) {
        const kept_row *solve = find("harmonic", "solve", "full solve", 3, factor->system);
        printf("- %s, n %d: new values are factored in %s; three right-hand sides take %s.\n",
               factor->system, (int)factor->n, time_of(factor->seconds), time_of(solve->seconds));
    }
}

static void say_inverse(void) {
    const kept_row *list = find("inverse_entries", "diagonal", "one list", 1, NULL);
    if (list) {
        const kept_row *plan = find("inverse_entries", "diagonal", "plan solve", 1, list->system);
        printf("- An entry of the diagonal of the inverse takes %s, %.2f of a local solve.\n",
               time_of(list->seconds), list->seconds / plan->seconds);
    }
}

static void say_neumann(void) {
    const kept_row *zero = find("neumann", "full solve", "zero mean", 1, NULL);
    if (zero) {
        const kept_row *shifted = find("neumann", "full solve", "shifted", 1, zero->system);
        printf("- The zero-mean solution of a singular Laplacian takes %.2f times as long as that "
               "of a shifted one.\n",
               zero->seconds / shifted->seconds);
    }
}

static void say_change(void) {
    const kept_row *edge = find("change", "one place", "edge, update", 1, NULL);
    if (edge) {
        const kept_row *again = find("change", "one place", "refactor", 1, edge->system);
        const kept_row *pin = find("change", "one place", "pin, solve, release", 1, edge->system);
        printf("- %s: a factor follows the new weight of an edge in %s, 1/%.0f of a "
               "factorization;\n  a vertex is pinned, solved beside and released in %s.\n",
               edge->system, time_of(edge->seconds), again->seconds / edge->seconds,
               time_of(pin->seconds));
    }
}

void bench_summary_print(void) {
    const char *const first[] = {"cold",     "locality",        "patches", "multi_rhs",
                                 "harmonic", "inverse_entries", "neumann", "change"};
    int any = 0;
    for (int k = 0; k < kept.count; k++) {
        for (size_t q = 0; q < sizeof first / sizeof *first; q++) {
            any |= strcmp(kept.rows[k].question, first[q]) == 0;
        }
    }
    if (!any) {
        return;
    }
    printf("\nIn words, for one thread:\n");
    say_cold();
    say_vertex();
    say_patch();
    say_multi_rhs();
    say_harmonic();
    say_inverse();
    say_neumann();
    say_change();
}

void bench_summary_free(void) {
    free(kept.rows);
    memset(&kept, 0, sizeof kept);
}

/* choice.h: what is known of a graph, and the order that it gets by one table */
#ifndef SLI_ORDERING_CHOICE_H
#define SLI_ORDERING_CHOICE_H

#include "levels.h"
#include "quotient_order.h"

/* What rules ask for: bits of the facts. */
enum {
    /* what is wanted; none of them: by dissection, of blocks of rows */
    SLI_WANTS_ONE_FACTOR = 1 << 0,
    SLI_WANTS_MANY_SOLVES = 1 << 1,
    /* counted in the graph */
    SLI_IS_IRREGULAR = 1 << 2, /* degrees vary */
    SLI_IS_BIPARTITE = 1 << 3,
    SLI_IS_THIN = 1 << 13,     /* a mean level of a search is small */
    SLI_IS_EXPANDING = 1 << 4, /* a mean level has an eighth of all rows */
    /* counted in an order that was tried */
    SLI_TRIED_LEVELS = 1 << 5,
    SLI_IS_NARROW = 1 << 6, /* by levels, L has few entries */
    SLI_TRIED_MINDEG = 1 << 7,
    SLI_IS_CHEAP = 1 << 8, /* dissection takes longer than it could save once */
    SLI_HAS_CORE = 1 << 9, /* most operations are in one front */
    SLI_HAS_NO_FILL = 1 << 10,
    SLI_HAS_SHORT_PATHS = 1 << 11,
    SLI_HAS_LITTLE_FILL = 1 << 12
};

/* What is counted of a graph. */
typedef struct sli_graph_facts {
    int bits;
    sl_off edges;        /* twice the number of edges */
    sli_order_cost cost; /* of minimum degree, once it was tried */
} sli_graph_facts;

typedef enum sli_order_way {
    SLI_TRY_LEVELS, /* count what an order by levels costs, and choose again */
    SLI_TRY_MINDEG, /* the same of minimum degree */
    SLI_BY_TRIED,   /* perm has it */
    SLI_BY_CUTS,    /* of minimum degree, which was tried */
    SLI_BY_DISSECTION
} sli_order_way;

/* The first rule decides of which all facts hold that it asks for, and none that it excludes. With
 * each stands the row of the bench that it wins (K: peers_kinds, Q: peers_kkt), and how much longer
 * ordering, analysis and factor together take without it. */
static const struct sli_order_rule {
    int all, none;
    sli_order_way way;
} sli_order_rules[] = {
    /* K strips and tube, one factor: 1.5 to 1.6 */
    {SLI_WANTS_ONE_FACTOR, SLI_TRIED_LEVELS, SLI_TRY_LEVELS},
    {SLI_WANTS_ONE_FACTOR | SLI_IS_NARROW, 0, SLI_BY_TRIED},
    /* K surfaces and volumes, one factor: 1.3 to 3 */
    {SLI_WANTS_ONE_FACTOR, SLI_TRIED_MINDEG, SLI_TRY_MINDEG},
    {SLI_WANTS_ONE_FACTOR | SLI_IS_CHEAP, 0, SLI_BY_TRIED},
    /* networks with hubs, one factor: twice the entries of L */
    {SLI_WANTS_ONE_FACTOR | SLI_IS_IRREGULAR, 0, SLI_BY_TRIED},
    /* What minimum degree costs is known in a fraction of the time, but thin graphs are dissected
     * along their levels in less. */
    {SLI_WANTS_MANY_SOLVES | SLI_IS_IRREGULAR, SLI_IS_THIN | SLI_TRIED_MINDEG, SLI_TRY_MINDEG},
    {SLI_WANTS_MANY_SOLVES | SLI_IS_BIPARTITE, SLI_TRIED_MINDEG, SLI_TRY_MINDEG},
    {SLI_WANTS_MANY_SOLVES | SLI_IS_EXPANDING, SLI_TRIED_MINDEG, SLI_TRY_MINDEG},
    /* Q random: 2.8; dissection also has more fill and longer paths */
    {SLI_WANTS_MANY_SOLVES | SLI_TRIED_MINDEG | SLI_HAS_CORE, 0, SLI_BY_TRIED},
    /* least squares, lasso, Huber and portfolio programs (test_order_kkt.c): 1.5 */
    {SLI_WANTS_MANY_SOLVES | SLI_TRIED_MINDEG | SLI_HAS_NO_FILL, 0, SLI_BY_TRIED},
    /* Q PDE control: 1.9 to 2.3; dissection saves 13 to 20 % of the paths for 14 to 20 % of fill */
    {SLI_TRIED_MINDEG | SLI_IS_BIPARTITE | SLI_HAS_SHORT_PATHS, 0, SLI_BY_TRIED},
    /* K fans: 2.5 to 3; a power network (bcspwr10): 1.8, for 9 % more entries on paths */
    {SLI_WANTS_MANY_SOLVES | SLI_TRIED_MINDEG | SLI_HAS_LITTLE_FILL, 0, SLI_BY_CUTS},
    /* all else, such as K surfaces and volumes by default */
    {0, 0, SLI_BY_DISSECTION}};

static sli_order_way sli_order_choose(const sli_graph_facts *f) {
    const struct sli_order_rule *r = sli_order_rules;
    while ((f->bits & r->all) != r->all || (f->bits & r->none) != 0) {
        r++;
    }
    return r->way;
}

/* Do the degrees vary so much that minimum degree may have far less fill than dissection? The mean
 * of their squares is at least 6/5 of the square of their mean: below 1.08 of it on most meshes,
 * 1.2 to 15 on networks and KKT systems. Where rows of few neighbors have been peeled, 11/10:
 * random graphs have 1.14, networks of roads 1.04. Degrees count up to 1024, and all products are
 * exact. */
static int sli_graph_is_irregular(const sli_graph *G, int is_peeled) {
    uint64_t mean, squares = 0;
    sl_int v;
    if (G->n == 0 || G->begin[G->n] / G->n >= 1024) {
        return 0;
    }
    for (v = 0; v < G->n; v++) {
        const uint64_t degree = (uint64_t)sli_graph_degree(G, v);
        squares += degree < 1024 ? degree * degree : 1024 * 1024;
    }
    mean = 16 * (uint64_t)G->begin[G->n] / (uint64_t)G->n;
    return mean > 0 && 10 * 256 * squares >= (is_peeled ? 11u : 12u) * mean * mean * (uint64_t)G->n;
}

/* Is the graph bipartite, with too many edges to be planar? KKT systems are, once bounds are peeled
 * and if the Hessian is diagonal: variables on one side, constraints on the other. queue, side: n
 * of scratch. */
static int sli_graph_is_bipartite(const sli_graph *G, sl_int *queue, sl_int *side) {
    sl_int root, head, tail = 0;
    sl_off e;
    if (G->begin[G->n] <= 4 * (sl_off)G->n) {
        return 0;
    }
    SLI_NONE(side, G->n);
    for (root = 0, head = 0; root < G->n; root++) {
        if (side[root] == -1) {
            side[root] = 0;
            queue[tail++] = root;
        }
        for (; head < tail; head++) {
            const sl_int v = queue[head];
            for (e = G->begin[v]; e < G->begin[v + 1]; e++) {
                const sl_int u = G->to[e];
                if (side[u] == side[v]) {
                    return 0;
                }
                if (side[u] == -1) {
                    side[u] = 1 - side[v];
                    queue[tail++] = u;
                }
            }
        }
    }
    return 1;
}

/* How far apart are the rows? In a thin graph the levels of a breadth-first search have at most 32
 * rows in the mean, and there are at least 32. In an expanding one most rows are a few edges apart,
 * and a mean level has 1/8 of all: a tenth of that in volumes of 1e4 rows. */
static int sli_graph_shape(const sli_order_job *job) {
    const int64_t n = job->G->n, most = n * n / 8;
    sli_levels l = sli_levels_of(job);
    sl_int v, tail = 0;
    for (v = 0; v < job->G->n && l.entries <= most; v++) {
        if (l.seen[v] == 0) {
            tail = sli_levels_search(&l, v, tail, 1, most);
        }
    }
    return l.entries > most                                 ? SLI_IS_EXPANDING
           : l.entries <= 32 * n && l.entries <= n * n / 32 ? SLI_IS_THIN
                                                            : 0;
}

/* Counts what the rules ask for of the graph of a job. perm and scratch are scratch. */
static sli_graph_facts sli_graph_describe(const sli_order_job *job) {
    const sli_graph *G = job->G;
    const sl_off n = G->n, mean = n > 0 ? G->begin[n] / n : 0;
    const int is_for_one = job->is_hurried;
    sli_graph_facts f;
    SLI_CLEAR(f);
    f.edges = G->begin[n];
    f.bits = is_for_one ? SLI_WANTS_ONE_FACTOR : job->block == 1 ? SLI_WANTS_MANY_SOLVES : 0;
    if (f.bits == 0) {
        return f;
    }
    f.bits |= sli_graph_is_irregular(G, job->is_peeled || is_for_one) ? SLI_IS_IRREGULAR : 0;
    /* with n < mean^2, two edges may lead from most rows to most others */
    if (!is_for_one && (job->is_peeled || mean * mean > n || (f.bits & SLI_IS_IRREGULAR) != 0)) {
        f.bits |= sli_graph_shape(job);
    }
    if (!is_for_one && job->is_peeled && (f.bits & SLI_IS_THIN) == 0 &&
        sli_graph_is_bipartite(G, job->perm, job->scratch)) {
        f.bits |= SLI_IS_BIPARTITE;
    }
    return f;
}

/* The cliques of minimum degree are good separators where L has few times the entries of A: with
 * 3.9 times as many, paths are a quarter longer than by dissection. */
#define SLI_CUTS_FILL 3.5

/* For each directed edge, a dissection takes as long as about this many operations of a
 * factorization. Measured on grids of 1e4 to 1e5 rows in 2D, 20^3 and 30^3, and scans. */
#define SLI_ORDER_ND_FLOPS 5000.0
/* For one factor, a dissection follows where half of the operations of minimum degree, about what
 * it saves, exceed this for each directed edge. Its time equals what it saves at 9000 on 7-point
 * volumes and on tetrahedra: at 6200 and 7600 minimum degree is better by a fifth, at 14000
 * dissection. */
#define SLI_ORDER_ND_SAVES 8000.0

/* The entries of A in one triangle. */
static double sli_graph_entries(const sli_order_job *job) {
    const sli_graph *G = job->G;
    double entries = 0.0;
    sl_int v;
    sl_off e;
    if (job->weight == NULL) {
        return 0.5 * (double)G->begin[G->n] + (double)G->n;
    }
    for (v = 0; v < G->n; v++) {
        double height = job->weight[v] + 1;
        for (e = G->begin[v]; e < G->begin[v + 1]; e++) {
            height += job->weight[G->to[e]];
        }
        entries += 0.5 * height * job->weight[v];
    }
    return entries;
}

/* Adds what the cost of minimum degree shows.
 *
 * Where most operations are in one front, no small separator has been missed: graphs of random
 * constraints are eliminated for nearly nothing, up to one dense block.
 *
 * There is next to no fill where L has an eighth more entries than A, and paths are little longer
 * than those within the largest fronts.
 *
 * The entries on a mean path relative to flops^(2/3): those of one dense block are 1.1 of it, in a
 * balanced tree fewer. Minimum degree has 0.5 to 0.6 of it on plane grids, 0.7 in volumes, and 2
 * and more on long chains, which it eliminates from one end. Both sides are cubed. */
static void sli_graph_describe_mindeg(const sli_order_job *job, sli_graph_facts *f) {
    const sli_order_cost *c = &f->cost;
    const double entries = sli_graph_entries(job);
    const double path = c->paths / (double)sli_max(sli_job_rows(job), 1);
    const double share = c->flops > 0.0 ? path / c->flops * path / c->flops * path : 0.0;
    f->bits |= SLI_TRIED_MINDEG;
    f->bits |= 0.5 * c->flops <= SLI_ORDER_ND_SAVES * (double)f->edges ? SLI_IS_CHEAP : 0;
    f->bits |= c->widest * c->widest * c->widest > 1.5 * c->flops ? SLI_HAS_CORE : 0;
    f->bits |= c->entries <= 1.125 * entries && c->paths <= 1.25 * c->fronts ? SLI_HAS_NO_FILL : 0;
    f->bits |= share < 0.67 * 0.67 * 0.67 ? SLI_HAS_SHORT_PATHS : 0;
    f->bits |= c->entries <= SLI_CUTS_FILL * entries ? SLI_HAS_LITTLE_FILL : 0;
}

#endif

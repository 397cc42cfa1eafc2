/* supernodes.h: fundamental supernodes, and their relaxed amalgamation over the whole assembly tree */
#ifndef SLI_SUPERNODES_H
#define SLI_SUPERNODES_H

#include "etree.h"
#include "sort.h"

/* Supernodes under construction, all arrays of n. A group is named by its top fundamental
 * supernode. */
typedef struct sli_groups {
    sl_int count;   /* fundamental supernodes */
    sl_int *first;  /* n + 1: first column of each */
    sl_int *parent; /* parent supernode, -1 at a root */
    sl_int *width;  /* columns of the group so far */
    sl_int *below;  /* rows below it */
    double *zeros;  /* stored places of the group that L does not fill */
    sl_int *group;  /* the supernode it was merged into, itself while on top; at last the top */
} sli_groups;

/* Runs of columns with the same structure, each the only child of the next: count falls by one
 * along the run. */
static void sli_fundamental(sl_int n, const sl_int *parent, const sl_int *counts, sl_int *children,
                            sl_int *super_of, sli_groups *g) {
    sl_int j, s = -1;
    memset(children, 0, (size_t)n * sizeof(sl_int));
    for (j = 0; j < n; j++) {
        if (parent[j] != -1) {
            children[parent[j]]++;
        }
    }
    for (j = 0; j < n; j++) {
        if (j == 0 || parent[j - 1] != j || children[j] != 1 || counts[j - 1] != counts[j] + 1) {
            g->first[++s] = j;
        }
        super_of[j] = s;
    }
    g->count = s + 1;
    g->first[g->count] = n;
    for (s = 0; s < g->count; s++) {
        const sl_int last = g->first[s + 1] - 1;
        g->width[s] = g->first[s + 1] - g->first[s];
        g->below[s] = counts[last] - 1;
        g->parent[s] = parent[last] == -1 ? -1 : super_of[parent[last]];
        g->zeros[s] = 0.0;
        g->group[s] = s;
    }
}

/* Most zeros of a group of up to 8 columns: on a path 28 of 44 places are, 0.64, and on 2D grids no
 * such group has more. Every group's places stay below 1 / (1 - 0.70) = 3.34 times its entries,
 * also where short columns hang on tall ones. */
#define SLI_ZEROS_SMALL 0.70

/* Whether a group of some width may hold a fraction z of zeros. Small panels cost their calls, not
 * their flops; the thresholds gave the fastest solves over 2D and 3D meshes at 2-3 % more flops. */
static int sli_may_merge(sl_int width, double z) {
    return (width <= 8 && z < SLI_ZEROS_SMALL) || (width <= 16 && z < 0.30) ||
           (width <= 48 && z < 0.15) || z < 0.05;
}

/* Zeros that joining child c to p adds: c's columns grow to p's rows. */
static double sli_new_zeros(const sli_groups *g, sl_int c, sl_int p) {
    return (double)g->width[c] * (double)(g->width[p] + g->below[p] - g->below[c]);
}

/* Joins the children of p, cheapest first, as long as the zeros allow. list: the children, keyed by
 * rank. */
static void sli_merge_children(sli_groups *g, sl_int p, uint64_t *list, sl_int count,
                               uint64_t *scratch) {
    sl_int k;
    for (k = 0; k < count; k++) {
        const sl_int c = sli_value(list[k]);
        const double cost = sli_new_zeros(g, c, p);
        list[k] = sli_keyed(cost < 2e9 ? (sl_int)cost : INT32_MAX, c);
    }
    sli_sort(list, count, scratch);
    for (k = 0; k < count; k++) {
        const sl_int c = sli_value(list[k]), width = g->width[c] + g->width[p];
        const double zeros = g->zeros[c] + g->zeros[p] + sli_new_zeros(g, c, p);
        const double places = (double)width * (0.5 * (width + 1.0) + g->below[p]);
        if (sli_may_merge(width, zeros / places)) {
            g->width[p] = width;
            g->zeros[p] = zeros;
            g->group[c] = p;
        }
    }
}

/* Every supernode in turn takes in its children, which come before it. child, sibling: lists of
 * children; list, scratch: room for all of them. */
static void sli_relax(sli_groups *g, sl_int *child, sl_int *sibling, uint64_t *list,
                      uint64_t *scratch) {
    sl_int s, c, count;
    for (s = 0; s < g->count; s++) {
        child[s] = -1;
    }
    for (s = 0; s < g->count; s++) {
        count = 0;
        for (c = child[s]; c != -1; c = sibling[c]) {
            list[count++] = sli_keyed(0, c);
        }
        if (count > 0) {
            sli_merge_children(g, s, list, count, scratch);
        }
        if (g->parent[s] != -1) {
            sibling[s] = child[g->parent[s]];
            child[g->parent[s]] = s;
        }
    }
}

/* Numbers the groups in a postorder of their tree and lays their columns side by side: order[k] =
 * old column of the new k. On return the arrays describe the groups in their new numbers, and count
 * is how many there are. scratch: 5n. */
static void sli_renumber_groups(sli_groups *g, sl_int n, sl_int *order, sl_int *super_of,
                                sl_int *scratch) {
    sl_int *top = scratch, *tree = scratch + n, *post = scratch + 2 * (size_t)n,
           *at = scratch + 3 * (size_t)n;
    sl_int *more = scratch + 4 * (size_t)n;
    sl_int s, k, groups = 0, column = 0;
    for (s = g->count - 1; s >= 0; s--) { /* parents come first, so that their group is final */
        g->group[s] = g->group[s] == s ? s : g->group[g->group[s]];
    }
    for (s = 0; s < g->count; s++) {
        if (g->group[s] == s) {
            at[s] = groups;
            top[groups++] = s;
        }
    }
    for (k = 0; k < groups; k++) {
        const sl_int up = g->parent[top[k]];
        tree[k] = up == -1 ? -1 : at[g->group[up]];
    }
    for (s = 0; s < g->count; s++) { /* from here on: the group's place in top */
        g->group[s] = at[g->group[s]];
    }
    sli_postorder(tree, groups, post, at, more);
    for (k = 0; k < groups; k++) {
        more[post[k]] = k;
        at[post[k]] = column; /* where the group's next column goes */
        column += g->width[top[post[k]]];
    }
    for (s = 0; s < g->count; s++) {
        sl_int *next = &at[g->group[s]];
        for (k = g->first[s]; k < g->first[s + 1]; k++) {
            super_of[*next] = more[g->group[s]];
            order[(*next)++] = k;
        }
    }
    for (k = 0; k < groups;
         k++) { /* group and at are done with: they carry the sizes to the new numbers */
        at[k] = g->width[top[post[k]]];
        g->group[k] = g->below[top[post[k]]];
    }
    column = 0;
    for (k = 0; k < groups; k++) {
        g->first[k] = column;
        g->width[k] = at[k];
        g->below[k] = g->group[k];
        g->parent[k] = tree[post[k]] == -1 ? -1 : more[tree[post[k]]];
        column += at[k];
    }
    g->first[groups] = n;
    g->count = groups;
}

#endif

/* update_stacks.h: where each update matrix is, in the stacks of workers or above all tasks */
#ifndef SLI_ANALYSIS_UPDATE_STACKS_H
#define SLI_ANALYSIS_UPDATE_STACKS_H

#include "schedule_types.h"

/* Two update stacks that grow towards each other, one for supernodes of even depth and one for odd
 * depth. Supernodes are pushed in ascending order. When a supernode is done, its children are on
 * top of the other stack, so that no update matrix is ever moved. */
typedef struct sli_stacks {
    sl_off top[2];
    sl_off most;
} sli_stacks;

/* Pushes the update matrix of supernode s, then pops those of its children: they are free once s is
 * factored. */
static void sli_stacks_push(sli_stacks *k, const sli_schedule *p, const sl_symbolic *S, sl_int s,
                            const sl_int *side) {
    const int own = side[s];
    const sl_off size = sli_passed_size(p, S, s);
    sl_int c;
    p->stack_begin[s] = own == 0 ? k->top[0] : -(k->top[1] + size);
    k->top[own] += size;
    k->most = k->top[0] + k->top[1] > k->most ? k->top[0] + k->top[1] : k->most;
    for (c = s - 1; c >= S->first_descendant[s]; c = S->first_descendant[c] - 1) {
        k->top[1 - own] -= sli_passed_size(p, S, c);
    }
}

/* What a front above the tasks, or the root of a task, keeps until its parent is done. */
SLI_INLINE sl_off sli_waiting_size(const sli_schedule *p, const sl_symbolic *S, sl_int s,
                                   int is_top) {
    return sli_passed_size(p, S, s) +
           (is_top && sli_front_is_large(S, s) ? sli_large_scratch(&S->steps[s]) : 0);
}

/* The child of front s whose subtree has the most memory, or -1, and the memory of s and of that
 * subtree. *others := that of the other children. */
static sl_off sli_waiting_largest(const sl_symbolic *S, const sl_off *size, const sl_off *subtree,
                                  sl_int s, sl_int *child, sl_off *others) {
    sl_off sum = 0, most = 0, both;
    sl_int c;
    *child = -1;
    for (c = s - 1; c >= S->first_descendant[s]; c = S->first_descendant[c] - 1) {
        sum += subtree[c];
        if (subtree[c] > most) {
            most = subtree[c];
            *child = c;
        }
    }
    *others = sum - most;
    both = size[s] + (*child == -1 ? 0 : size[*child]);
    return both > most ? both : most;
}

/* Lays out the update matrices of the fronts above the tasks and of the roots of tasks, from p->own
 * for each worker on. Several workers may factor fronts of disjoint subtrees at the same time, so
 * that these have disjoint memory. That of a front is at one end of its subtree's memory, at the
 * start if side is 0. The child whose subtree has the most memory has its own at the other end, and
 * shares what is between the two with its parent: it is free when that child is done. size,
 * subtree: n_supers of scratch each. */
static void sli_plan_waiting(sli_schedule *p, const sl_symbolic *S, const sl_int *side,
                             sl_off *size, sl_off *subtree) {
    sl_off others;
    sl_int m, c, child;
    for (m = 0; m < p->n_tasks; m++) {
        size[p->last[m]] = subtree[p->last[m]] = sli_waiting_size(p, S, p->last[m], 0);
    }
    for (m = 0; m < p->n_tops; m++) {
        const sl_int s = p->top[m];
        size[s] = sli_waiting_size(p, S, s, 1);
        subtree[s] = sli_waiting_largest(S, size, subtree, s, &child, &others);
        subtree[s] += others;
    }
    for (m = p->n_tops + p->n_tasks - 1; m >= 0; m--) {
        const sl_int s = m >= p->n_tasks ? p->top[m - p->n_tasks] : p->last[m];
        sl_off at;
        if (S->super_parent[s] == -1) {
            p->stack_begin[s] =
                p->stack +
                (side[s] == 0 ? 0 : subtree[s] - size[s]); /* branches untested: of a root */
            p->stack += subtree[s];
        }
        if (m < p->n_tasks || S->first_descendant[s] == s) {
            continue;
        }
        at = sli_waiting_largest(S, size, subtree, s, &child, &others);
        if (child != -1) { /* else all children are plain, and have no memory */
            p->stack_begin[child] = side[s] == 0 ? p->stack_begin[s] + at - size[child]
                                                 : p->stack_begin[s] + size[s] - at;
        }
        for (c = s - 1; c >= S->first_descendant[s]; c = S->first_descendant[c] - 1) {
            if (c != child) {
                at += subtree[c];
                p->stack_begin[c] = side[s] == 0 ? p->stack_begin[s] + at - size[c]
                                                 : p->stack_begin[s] + size[s] - at;
            }
        }
    }
}

/* Lays out the update stacks. Each worker has room for the two stacks of any task. size, subtree:
 * n_supers of scratch each. */
SLI_AT_LINE SLI_NOINLINE static void sli_plan_stacks(sli_schedule *p, const sl_symbolic *S,
                                                     const sl_int *side, sl_off *size,
                                                     sl_off *subtree) {
    sl_int m, s;
    p->own = 0;
    for (m = 0; m < p->n_tasks; m++) {
        sli_stacks k;
        memset(&k, 0, sizeof k);
        for (s = p->first[m]; s < p->last[m]; s++) {
            sli_stacks_push(&k, p, S, s, side);
        }
        for (s = p->first[m]; k.most > 0 && s < p->last[m]; s++) { /* the second stack counts */
            p->stack_begin[s] += side[s] == 0 ? 0 : k.most;        /* from the end */
        }
        p->own = k.most > p->own ? k.most : p->own;
    }
    p->stack = p->workers * p->own;
    sli_plan_waiting(p, S, side, size, subtree);
}

#endif

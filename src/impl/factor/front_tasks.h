/* front_tasks.h: the multifrontal factorization as a list of tasks from which workers draw */
#ifndef SLI_FACTOR_FRONT_TASKS_H
#define SLI_FACTOR_FRONT_TASKS_H

#include "../base/parallel.h"
#include "multifrontal.h"

/* A factorization is one parallel call. Its tasks are bundles of subtrees, and the fronts above
 * them: small fronts as a whole, large ones in pieces. A worker draws a task that waits for nothing
 * but finished ones. If there is none, others are at work, and it waits for one of them.
 *
 * A piece is a range of row tiles of a large front, one group of pivots or some rows below. Its
 * steps follow one another:
 *     clear, assemble, the rows of each group of pivots above it, its own pivots, update
 * Between clearing and assembling, one worker adds the entries of A; at the end, one checks the
 * pivots. Each row tile goes through the same operations as with one worker. */
typedef enum sli_task_kind {
    SLI_TASK_NONE,
    SLI_TASK_SUBTREES,
    SLI_TASK_FRONT,
    SLI_TASK_LOAD,
    SLI_TASK_PIECE,
    SLI_TASK_FINISH
} sli_task_kind;

typedef struct sli_task {
    sli_task_kind kind;
    sl_int at;          /* the bundle, or the front above the subtrees */
    sl_int piece, step; /* of a large front */
} sli_task;

/* What the workers share. */
typedef struct sli_job {
    sl_factor *F;
    const sli_source *from;
    sli_atomic lock;    /* of what follows */
    sli_atomic changes; /* counts the tasks that are done */
    sl_int next;        /* the first bundle that is not drawn */
    sl_int left;        /* bundles and fronts above them that are not done */
    sl_int n_ready;     /* fronts in tops.ready */
    sl_int failed;      /* the first supernode that is known to have failed, or n_supers */
    /* the large front whose turn it is where all share one panel in double; -1: none */
    sl_int in_turn;
} sli_job;

enum { SLI_STEP_CLEAR, SLI_STEP_ASSEMBLE, SLI_STEP_ROWS };

/* The row tiles of a piece: from its beginning to that of the next one. */
SLI_INLINE sl_int sli_piece_begin(const sli_step *s, const sli_top *top, sl_int piece) {
    const sl_int groups = sli_front_groups(s->width);
    return piece < groups ? SLI_GROUP_TILES * piece
                          : sli_min(sli_tiles(s->width) + (piece - groups) * top->piece_tiles,
                                    sli_tiles(s->width + s->below));
}

/* The last step of a piece in which it computes columns of L. */
SLI_INLINE sl_int sli_piece_last_step(const sli_step *s, sl_int piece) {
    const sl_int groups = sli_front_groups(s->width);
    return SLI_STEP_ROWS + (piece < groups ? piece : groups - 1);
}

/* Does the piece have rows of the update matrix? */
SLI_INLINE int sli_piece_has_update(const sli_step *s, const sli_top *top, sl_int piece) {
    return s->below > 0 && sli_piece_begin(s, top, piece + 1) > s->width / SLI_TILE;
}

/* Does the next step of a piece wait for nothing? */
SLI_INLINE int sli_piece_is_ready(const sli_step *s, const sli_top *top, sl_int piece,
                                  sl_int step) {
    const sl_int last = sli_piece_last_step(s, piece), group = step - SLI_STEP_ROWS;
    if (step <= SLI_STEP_ASSEMBLE) {
        return step == SLI_STEP_CLEAR || top->is_loaded;
    }
    return step > last ? top->eliminated == top->pieces : group == piece || group < top->pivots;
}

/* ---- drawing and returning tasks, with the lock held ---- */

/* Supernode s is done: its parent, if it is above the subtrees, waits for one child less. */
static void sli_job_pass(sli_job *job, sl_int s) {
    const sli_schedule *p = &job->F->schedule;
    const sl_int up = job->F->S->super_parent[s];
    if (up != -1) {
        const sl_int at = sli_lower_bound(p->top, p->n_tops, up);
        if (--p->tops[at].waiting == 0) {
            p->ready[job->n_ready++] = at;
        }
    }
}

/* The front is done, and not among those that are ready. */
static void sli_job_end_front(sli_job *job, sl_int at) {
    job->left--;
    sli_job_pass(job, job->F->schedule.top[at]);
}

static void sli_job_end_large_front(sli_job *job, sl_int at) {
    sl_int *ready = job->F->schedule.ready, k;
    for (k = 0; ready[k] != at; k++) {
    }
    ready[k] = ready[--job->n_ready];
    job->in_turn = -1;
    sli_job_end_front(job, at);
}

/* Draws a step of a large front. Pieces with pivots come first: the others wait for them. */
static int sli_top_draw(sli_job *job, sl_int at, sli_task *task) {
    const sli_schedule *p = &job->F->schedule;
    const sli_step *s = &job->F->S->steps[p->top[at]];
    sli_top *top = &p->tops[at];
    sl_int k;
    task->at = at;
    task->kind = SLI_TASK_LOAD;
    if (top->cleared == top->pieces && !top->is_loading) {
        return top->is_loading = 1;
    }
    task->kind = SLI_TASK_FINISH;
    if (top->updated == top->pieces) {
        const int is_first = !top->is_finishing;
        top->is_finishing = 1;
        return is_first;
    }
    task->kind = SLI_TASK_PIECE;
    for (k = 0; k < top->pieces; k++) {
        sl_int *step = &p->steps[top->first_piece + k];
        const sl_int end = sli_piece_last_step(s, k) + sli_piece_has_update(s, top, k);
        if (*step >= 0 && *step <= end && sli_piece_is_ready(s, top, k, *step)) {
            task->piece = k;
            task->step = *step;
            *step = -1;
            return 1;
        }
    }
    return 0;
}

/* Draws a task. Fronts come before subtrees: most workers wait where there are few tasks. A front
 * after a failed one is left out: perhaps it is above it, and its failure would not be the first.
 */
static sli_task sli_job_draw(sli_job *job) {
    const sli_schedule *p = &job->F->schedule;
    sli_task task = {SLI_TASK_NONE, 0, 0, 0};
    sl_int k = 0;
    while (k < job->n_ready) {
        const sl_int at = p->ready[k];
        const sli_top *top = &p->tops[at];
        const int is_whole = top->pieces == 0 || sli_is_copied(job->F, p->top[at]);
        const int skip = !top->is_begun && p->top[at] > job->failed;
        if (is_whole || skip) {
            p->ready[k] = p->ready[--job->n_ready];
            if (skip) {
                sli_job_end_front(job, at);
                continue;
            }
            task.kind = SLI_TASK_FRONT;
            task.at = at;
            return task;
        }
        if ((job->F->type->store == NULL || job->F->work.panel_room == 0 || job->in_turn == -1 ||
             job->in_turn == at) &&
            sli_top_draw(job, at, &task)) {
            job->in_turn = at;
            p->tops[at].is_begun = 1;
            return task;
        }
        k++;
    }
    task.kind = job->next < p->n_bundles ? SLI_TASK_SUBTREES : SLI_TASK_NONE;
    task.at = job->next;
    job->next += task.kind == SLI_TASK_SUBTREES;
    return task;
}

/* Returns a step of a piece. */
static void sli_job_return_piece(sli_job *job, const sli_task *task) {
    const sli_schedule *p = &job->F->schedule;
    const sli_step *s = &job->F->S->steps[p->top[task->at]];
    sli_top *top = &p->tops[task->at];
    const sl_int last = sli_piece_last_step(s, task->piece);
    const int has_update = sli_piece_has_update(s, top, task->piece);
    p->steps[top->first_piece + task->piece] = task->step + 1;
    top->cleared += task->step == SLI_STEP_CLEAR;
    top->pivots += task->step == last && task->piece < sli_front_groups(s->width);
    top->eliminated += task->step == last;
    top->updated += task->step == last + has_update;
}

/* Returns a finished task. */
static void sli_job_return(sli_job *job, const sli_task *task, sl_status status) {
    const sli_schedule *p = &job->F->schedule;
    sl_int m;
    switch (task->kind) {
    case SLI_TASK_SUBTREES:
        job->left--;
        for (m = task->at > 0 ? p->bundle_end[task->at - 1] : 0; m < p->bundle_end[task->at]; m++) {
            sli_job_pass(job, p->last[m]);
        }
        break;
    case SLI_TASK_PIECE:
        sli_job_return_piece(job, task);
        break;
    case SLI_TASK_FRONT:
        sli_job_end_front(job, task->at);
        break;
    default:
        if (task->kind == SLI_TASK_LOAD && status == SL_OK) {
            p->tops[task->at].is_loaded = 1;
        } else {
            sli_job_end_large_front(job, task->at);
        }
        break;
    }
}

/* ---- running tasks ---- */

/* Runs a step of a piece. */
static void sli_piece_run(sl_factor *F, const sli_task *task, sl_int worker) {
    const sl_int s = F->schedule.top[task->at], piece = task->piece;
    const sli_step *step = &F->S->steps[s];
    const sli_top *top = &F->schedule.tops[task->at];
    const sl_int t0 = sli_piece_begin(step, top, piece), t1 = sli_piece_begin(step, top, piece + 1);
    const sl_int group = task->step - SLI_STEP_ROWS, whole = step->width / SLI_TILE;
    double *scratch = F->work.buffer + (ptrdiff_t)worker * sli_front_scratch(F->S->widest);
    const sli_fronts *fronts = F->type->fronts;
    const sli_front f = fronts->shared(F, s, sli_max(group, 0));
    if (task->step == SLI_STEP_CLEAR) {
        fronts->clear(&f, t0, t1);
    } else if (task->step == SLI_STEP_ASSEMBLE) {
        fronts->assemble(F, &f, worker, t0, t1);
    } else if (task->step > sli_piece_last_step(step, piece)) {
        F->own.front->update(&f, whole, sli_front_tiles(&f), sli_max(t0, whole), t1, scratch);
    } else if (group == piece) {
        F->own.front->pivots(&f, SLI_GROUP_TILES * group, scratch);
    } else {
        F->own.front->rows(&f, SLI_GROUP_TILES * group, t0, t1, scratch);
    }
}

/* Factors the subtrees of a bundle. A failure ends the subtree only: the failure to report is the
 * first one in the order of supernodes, and another subtree may hold it. */
static void sli_subtrees_run(sl_factor *F, const sli_source *from, sl_int bundle, sl_int worker) {
    const sli_schedule *p = &F->schedule;
    sl_int m = bundle > 0 ? p->bundle_end[bundle - 1] : 0;
    for (; m < p->bundle_end[bundle]; m++) {
        sli_failure failure;
        if (F->type->fronts->factor(F, from, p->first[m], p->last[m], worker, &failure) != SL_OK) {
            sli_keep_first_failure(&F->work.failures[worker], &failure);
        }
    }
}

static sl_status sli_task_run(sl_factor *F, const sli_source *from, const sli_task *task,
                              sl_int worker) {
    const sl_int s = task->kind == SLI_TASK_SUBTREES ? 0 : F->schedule.top[task->at];
    sli_failure failure;
    sli_front f;
    failure.status = SL_OK;
    switch (task->kind) {
    case SLI_TASK_SUBTREES:
        sli_subtrees_run(F, from, task->at, worker);
        break;
    case SLI_TASK_FRONT:
        (void)F->type->fronts->factor(F, from, s, s, worker, &failure);
        break;
    case SLI_TASK_LOAD:
        f = F->type->fronts->shared(F, s, 0);
        (void)F->type->fronts->load(F, from, &f, &failure);
        break;
    case SLI_TASK_FINISH:
        f = F->type->fronts->shared(F, s, 0);
        (void)F->type->fronts->finish(F, &f, &failure);
        break;
    default:
        sli_piece_run(F, task, worker);
        break;
    }
    sli_keep_first_failure(&F->work.failures[worker], &failure);
    return failure.status;
}

/* Draws and runs tasks until all are done. */
static void sli_worker_run(void *data, sl_int worker) {
    sli_job *job = (sli_job *)data;
    const sli_failure *failure = &job->F->work.failures[worker];
    sli_task task = {SLI_TASK_NONE, 0, 0, 0};
    sl_status status = SL_OK;
    sli_atomic seen;
    sl_int left;
    int turn;
    for (;;) {
        sli_lock(&job->lock);
        if (failure->status != SL_OK) {
            job->failed = sli_min(job->failed, failure->super);
        }
        if (task.kind != SLI_TASK_NONE) {
            sli_job_return(job, &task, status);
            sli_atomic_write(&job->changes, job->changes + 1);
        }
        task = sli_job_draw(job);
        left = job->left;
        seen = job->changes;
        sli_unlock(&job->lock);
        if (task.kind != SLI_TASK_NONE) {
            status = sli_task_run(job->F, job->from, &task, worker);
        } else if (left == 0) {
            return;
        }
        if (task.kind == SLI_TASK_NONE) {
            for (turn = 0; sli_atomic_read(&job->changes) == seen; turn++) {
                sli_pause(turn);
            }
        }
    }
}

/* Begins the list of tasks. */
static void sli_job_begin(sli_job *job, sl_factor *F, const sli_source *from) {
    const sli_schedule *p = &F->schedule;
    sl_int m, k;
    memset(job, 0, sizeof *job);
    job->F = F;
    job->from = from;
    job->left = p->n_bundles + p->n_tops;
    job->failed = F->S->n_supers;
    job->in_turn = -1;
    for (m = 0; m < p->n_tops; m++) {
        sli_top *top = &p->tops[m];
        top->waiting = top->children;
        top->cleared = top->pivots = top->eliminated = top->updated = 0;
        top->is_begun = top->is_loading = top->is_loaded = top->is_finishing = 0;
        for (k = 0; k < top->pieces; k++) {
            p->steps[top->first_piece + k] = SLI_STEP_CLEAR;
        }
        if (top->waiting == 0) {
            p->ready[job->n_ready++] = m;
        }
    }
    for (k = 0; k < p->workers; k++) {
        F->work.failures[k].status = SL_OK;
    }
}

/* Factors the whole matrix, which has the analyzed pattern. [DR83], [Liu92] */
static sl_status sli_multifrontal(sl_factor *F, const sli_source *from, sli_failure *failure) {
    sli_job job;
    sl_int k;
    if (F->schedule.workers == 1) {
        return F->type->fronts->factor(F, from, 0, F->S->n_supers - 1, 0, failure);
    }
    sli_job_begin(&job, F, from);
    sli_parallel(&F->threads, F->schedule.workers, sli_worker_run, &job);
    for (k = 0; k < F->schedule.workers; k++) {
        sli_keep_first_failure(failure, &F->work.failures[k]);
    }
    return failure->status;
}

#endif

/* sparse_local_mex.c: what the classes of this folder call, in Octave and in MATLAB: objects of
 * sparse_local.h, named by numbers
 *
 *     [out, ...] = sparse_local_mex(command, in, ...)
 *
 * Rows and columns begin with 1 here, also in messages. Objects live until `free`, and the file
 * stays loaded as long as there is one. mexErrMsgIdAndTxt does not return: it is called where no
 * object of the library is held; arrays of mxMalloc are released by the interpreter. This is the
 * one file to compile: its commands are in headers beside it. */
#include "mex_factors.h"
#include "mex_constraints.h"
#include "mex_errors.h"
#include "mex_queries.h"

/* ---- commands of all objects ---- */

/* free(id): of any object; nothing if there is none */
static sl_status free_object(call *c) {
    object **at = &objects, *o;
    const double id = id_of(c->in[0]);
    while (*at != NULL && (*at)->id != id)
        at = &(*at)->next;
    o = *at;
    if (o == NULL) return SL_OK;
    *at = o->next;
    release(o);
    if (objects == NULL) mexUnlock();
    return SL_OK;
}

/* count = live(): how many objects there are, for tests */
static sl_status live(call *c) {
    const object *o;
    double *count = new_output(c, 0, 1, 1);
    for (o = objects; o != NULL; o = o->next) {
        *count += 1;
    }
    return SL_OK;
}

/* ---- the function ---- */

static const struct {
    const char *name;
    sl_status (*run)(call *c);
    int inputs, outputs;
} commands[] = {
    {"create", create, 2, 1},
    {"refactor", refactor, 2, 0},
    {"solve", solve, 2, 1},
    {"refine", refine, 4, 2},
    {"rcond", rcond, 2, 1},
    {"logdet", logdet, 1, 2},
    {"factors", factors, 1, 4},
    {"info", info, 1, 1},
    {"local", local, 4, 1},
    {"plan", plan, 3, 1},
    {"plan_solve", plan_solve, 3, 1},
    {"diagonal", diagonal, 2, 1},
    {"pairs", pairs, 3, 1},
    {"block", block, 3, 1},
    {"rank_update", rank_update, 3, 0},
    {"change_entries", change_entries, 5, 0},
    {"constraints", constraints, 1, 1},
    {"constraints_add", constraints_add, 2, 0},
    {"constraints_release", constraints_release, 2, 0},
    {"constraints_refactor", constraints_refactor, 1, 0},
    {"constraints_solve", constraints_solve, 6, 1},
    {"free", free_object, 1, 0},
    {"live", live, 0, 1},
    {"own_names", own_names, 1, 1},
    {"statuses", statuses, 0, 1},
};

void mexFunction(int n_out, mxArray **out, int n_in, const mxArray **in) {
    char name[32] = "";
    size_t k;
    int i;
    mxArray *results[4] = {NULL, NULL, NULL, NULL};
    call c;
    sl_status status;
    mexAtExit(release_all);
    c.out = results;
    c.in = in + 1;
    if (n_in > 0 && mxIsChar(in[0])) (void)mxGetString(in[0], name, sizeof name);
    for (k = 0; k < sizeof commands / sizeof commands[0]; k++) {
        if (strcmp(commands[k].name, name) != 0) continue;
        if (n_in - 1 != commands[k].inputs || n_out > commands[k].outputs) {
            refuse("a command of sparse_local_mex has other arguments; see help sparse_local");
        }
        status = commands[k].run(&c);
        if (status != SL_OK) fail(status);
        for (i = 0; i < commands[k].outputs; i++) {
            if (i == 0 || i < n_out)
                out[i] = results[i];
            else
                mxDestroyArray(results[i]);
        }
        return;
    }
    refuse("sparse_local_mex has no such command; see help sparse_local");
}

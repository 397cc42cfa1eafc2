/* handle_script.c: reads a script of handles that are grabbed, moved and released */
#include "handle_script.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tools/io/input.h"

enum { N_ACTIONS = SCRIPT_FRAME + 1 };

static const char *const words[N_ACTIONS] = {"grab", "move", "turn", "release", "frame"};

const char *script_word(script_action action) {
    return words[action];
}

void handle_script_free(handle_script *s) {
    for (sl_int k = 0; k < s->n_handles; k++) {
        free(s->handles[k].vertices);
    }
    free(s->handles);
    free(s->steps);
    memset(s, 0, sizeof *s);
}

/* State of the reader. */
typedef struct reader {
    input in;
    handle_script *out;
    const mesh *m;
    size_t room;    /* steps for which out->steps has room */
    sl_int *holder; /* handle that holds each vertex, or -1 */
} reader;

/* Adds a vertex to the last handle, which has room for all vertices. */
static bool add_vertex(reader *r, sl_int v) {
    const sl_int number = r->out->n_handles - 1;
    script_handle *h = &r->out->handles[number];
    if (r->holder[v] == number) {
        return true;
    }
    if (r->holder[v] >= 0) {
        return input_error(&r->in, "vertex %d is held by handle %d", (int)v, (int)r->holder[v]);
    }
    r->holder[v] = number;
    h->vertices[h->count++] = v;
    return true;
}

static bool read_vertex(reader *r, sl_int *v) {
    int64_t number;
    if (!input_integer(&r->in, &number)) {
        return input_error(&r->in, "grab: expected a vertex, as in: grab 3,17,100-200");
    }
    if (number < 0 || number >= r->m->n_vertices) {
        return input_error(&r->in, "there is no vertex %lld; the last one is %d", (long long)number,
                           (int)r->m->n_vertices - 1);
    }
    *v = (sl_int)number;
    return true;
}

static double distance(const double *a, const double *b) {
    return hypot(hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]);
}

/* Adds the vertices within a distance of the first `count` ones of the last handle. */
static bool add_ball(reader *r, double radius, sl_int count) {
    const script_handle *h = &r->out->handles[r->out->n_handles - 1];
    bool ok = true;
    for (sl_int v = 0; v < r->m->n_vertices && ok; v++) {
        for (sl_int k = 0; k < count; k++) {
            if (distance(r->m->xyz + 3 * (size_t)v, r->m->xyz + 3 * (size_t)h->vertices[k]) <=
                radius) {
                ok = add_vertex(r, v);
                break;
            }
        }
    }
    return ok;
}

/* "within R" at the end of a grab. */
static bool read_radius(reader *r) {
    char word[16];
    double radius;
    input_word(&r->in, word, sizeof word);
    if (strcmp(word, "within") != 0) {
        return input_error(&r->in, "grab: expected a vertex or: within R");
    }
    if (!input_number(&r->in, &radius) || !(radius >= 0) || !isfinite(radius)) {
        return input_error(&r->in, "within: expected a distance, 0 or more");
    }
    return add_ball(r, radius, r->out->handles[r->out->n_handles - 1].count);
}

static bool read_grab(reader *r) {
    handle_script *s = r->out;
    script_handle *larger =
        (script_handle *)realloc(s->handles, ((size_t)s->n_handles + 1) * sizeof *larger);
    if (larger == NULL) {
        return input_error(&r->in, "out of memory");
    }
    s->handles = larger;
    script_handle *h = &s->handles[s->n_handles];
    memset(h, 0, sizeof *h);
    h->vertices = (sl_int *)malloc(((size_t)r->m->n_vertices + 1) * sizeof *h->vertices);
    if (h->vertices == NULL) {
        return input_error(&r->in, "out of memory");
    }
    s->n_handles++;
    s->steps[s->n_steps].handle = s->n_handles - 1;
    do {
        sl_int first, last;
        if (!read_vertex(r, &first)) {
            return false;
        }
        last = first;
        if (*r->in.at == '-') {
            r->in.at++;
            if (!read_vertex(r, &last) || last < first) {
                return last < first &&
                       input_error(&r->in, "%d-%d is an empty range", (int)first, (int)last);
            }
        }
        for (sl_int v = first; v <= last; v++) {
            if (!add_vertex(r, v)) {
                return false;
            }
        }
        if (*r->in.at == ',') {
            r->in.at++;
        } else if (!input_at_word_end(&r->in)) {
            return input_error(&r->in, "grab: expected a comma or a blank between vertices");
        }
    } while (input_more_in_line(&r->in) && *r->in.at >= '0' && *r->in.at <= '9');
    if (input_more_in_line(&r->in) && !read_radius(r)) {
        return false;
    }
    h->vertices = (sl_int *)realloc(h->vertices, ((size_t)h->count + 1) * sizeof *h->vertices);
    return h->vertices != NULL || input_error(&r->in, "out of memory");
}

/* The handle of a move, a turn or a release. */
static bool read_handle(reader *r, const char *word) {
    int64_t number;
    if (!input_integer(&r->in, &number) || !input_at_word_end(&r->in)) {
        return input_error(&r->in, "%s: expected the number of a handle", word);
    }
    if (number < 0 || number >= r->out->n_handles) {
        return input_error(&r->in, "%s: there is no handle %lld: %d were grabbed", word,
                           (long long)number, (int)r->out->n_handles);
    }
    if (r->out->handles[number].is_released) {
        return input_error(&r->in, "%s: handle %d was released", word, (int)number);
    }
    r->out->steps[r->out->n_steps].handle = (sl_int)number;
    return true;
}

static bool read_values(reader *r, const char *word, int count, const char *names) {
    double *values = r->out->steps[r->out->n_steps].values;
    for (int k = 0; k < count; k++) {
        if (!input_number(&r->in, &values[k]) || !(fabs(values[k]) <= 1e100)) {
            return input_error(&r->in, "%s: expected HANDLE %s", word, names);
        }
    }
    if (count == 4 && !(hypot(hypot(values[0], values[1]), values[2]) > 0)) {
        return input_error(&r->in, "turn: the axis has no length");
    }
    return true;
}

static bool read_step(reader *r) {
    handle_script *s = r->out;
    char word[16];
    int action = 0;
    bool ok;
    if (s->n_steps == r->room) {
        const size_t room = 2 * r->room + 64;
        script_step *larger = (script_step *)realloc(s->steps, room * sizeof *larger);
        if (larger == NULL) {
            return input_error(&r->in, "out of memory");
        }
        s->steps = larger;
        r->room = room;
    }
    script_step *step = &s->steps[s->n_steps];
    memset(step, 0, sizeof *step);
    step->line = (long)r->in.line;
    input_word(&r->in, word, sizeof word);
    while (action < N_ACTIONS && strcmp(word, words[action]) != 0) {
        action++;
    }
    switch (action) {
    case SCRIPT_GRAB:
        ok = read_grab(r);
        break;
    case SCRIPT_MOVE:
        ok = read_handle(r, word) && read_values(r, word, 3, "DX DY DZ");
        break;
    case SCRIPT_TURN:
        ok = read_handle(r, word) && read_values(r, word, 4, "AX AY AZ DEGREES");
        break;
    case SCRIPT_RELEASE:
        ok = read_handle(r, word);
        break;
    case SCRIPT_FRAME:
        step->handle = s->n_frames++;
        ok = true;
        break;
    default:
        return input_error(&r->in, "%s: expected grab, move, turn, release or frame", word);
    }
    if (ok && action == SCRIPT_RELEASE) {
        script_handle *h = &s->handles[step->handle];
        h->is_released = true;
        for (sl_int k = 0; k < h->count; k++) {
            r->holder[h->vertices[k]] = -1;
        }
    }
    step->action = (script_action)action;
    s->n_steps += ok;
    if (ok && input_more_in_line(&r->in)) {
        return input_error(&r->in, "%s: more on the line than expected", word);
    }
    return ok;
}

bool handle_script_read(handle_script *out, const char *path, const mesh *m, char *message,
                        size_t message_size) {
    reader r;
    memset(out, 0, sizeof *out);
    memset(&r, 0, sizeof r);
    if (!input_open(&r.in, path, message, message_size)) {
        return false;
    }
    r.in.comment = '#';
    r.out = out;
    r.m = m;
    r.holder = (sl_int *)malloc(((size_t)m->n_vertices + 1) * sizeof *r.holder);
    bool ok = r.holder != NULL;
    if (!ok) {
        (void)input_error(&r.in, "out of memory");
    }
    for (sl_int v = 0; v < m->n_vertices && ok; v++) {
        r.holder[v] = -1;
    }
    while (ok && input_more(&r.in)) {
        ok = read_step(&r);
    }
    free(r.holder);
    input_close(&r.in);
    if (!ok) {
        handle_script_free(out);
    }
    return ok;
}

void script_step_apply(const script_step *step, double *points, sl_int count) {
    const double pi = 3.14159265358979323846;
    double mean[3] = {0, 0, 0}, axis[3];
    const double *v = step->values;
    if (step->action == SCRIPT_MOVE) {
        for (sl_int k = 0; k < 3 * count; k++) {
            points[k] += v[k % 3];
        }
    }
    if (step->action != SCRIPT_TURN) {
        return;
    }
    const double length = hypot(hypot(v[0], v[1]), v[2]);
    const double c = cos(v[3] * pi / 180), s = sin(v[3] * pi / 180);
    for (int d = 0; d < 3; d++) {
        axis[d] = v[d] / length;
    }
    for (sl_int k = 0; k < 3 * count; k++) {
        mean[k % 3] += points[k] / (double)count;
    }
    for (sl_int k = 0; k < count; k++) { /* Rodrigues' formula */
        double x[3], along = 0;
        for (int d = 0; d < 3; d++) {
            x[d] = points[3 * k + d] - mean[d];
            along += axis[d] * x[d];
        }
        for (int d = 0; d < 3; d++) {
            const int e = (d + 1) % 3, g = (d + 2) % 3;
            points[3 * k + d] = mean[d] + c * x[d] + s * (axis[e] * x[g] - axis[g] * x[e]) +
                                (1 - c) * along * axis[d];
        }
    }
}

const script_handle *script_step_handle(const handle_script *s, const script_step *step) {
    return step->action == SCRIPT_FRAME ? NULL : &s->handles[step->handle];
}

static void extend_box(double box[6], const double *points, size_t count) {
    for (size_t k = 0; k < 3 * count; k++) {
        box[k % 3] = fmin(box[k % 3], points[k]);
        box[3 + k % 3] = fmax(box[3 + k % 3], points[k]);
    }
}

bool handle_script_box(double box[6], const handle_script *s, const mesh *m) {
    const size_t n = (size_t)m->n_vertices;
    double *target = (double *)malloc((3 * n + 1) * sizeof *target);
    double *points = (double *)malloc((3 * n + 1) * sizeof *points);
    if (target == NULL || points == NULL) {
        free(target);
        free(points);
        return false;
    }
    memcpy(target, m->xyz, 3 * n * sizeof *target);
    for (int c = 0; c < 3; c++) {
        box[c] = HUGE_VAL;
        box[3 + c] = -HUGE_VAL;
    }
    extend_box(box, target, n);
    for (size_t k = 0; k < s->n_steps; k++) {
        const script_handle *h = script_step_handle(s, &s->steps[k]);
        const sl_int count = h != NULL ? h->count : 0;
        for (sl_int v = 0; v < count; v++) {
            memcpy(points + 3 * v, target + 3 * (size_t)h->vertices[v], 3 * sizeof *points);
        }
        script_step_apply(&s->steps[k], points, count);
        for (sl_int v = 0; v < count; v++) {
            memcpy(target + 3 * (size_t)h->vertices[v], points + 3 * v, 3 * sizeof *points);
        }
        extend_box(box, points, (size_t)count);
    }
    free(target);
    free(points);
    return true;
}

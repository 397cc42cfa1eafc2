/* laplacian_choice.c: the option --laplacian: of the faces, or of a Delaunay triangulation */
#include "laplacian_choice.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void laplacian_check(const char *name) {
    if (name != NULL && strcmp(name, "auto") != 0 && strcmp(name, "cotangent") != 0 &&
        strcmp(name, "intrinsic") != 0) {
        app_die_usage("--laplacian %s: expected auto, cotangent or intrinsic", name);
    }
}

/* The sentence on the choice, which is printed after the results. */
static char note[400];

static void print_note(void) {
    (void)fputs(note, stdout);
}

static void note_choice(sl_off flips, sl_off negative, sl_int flat) {
    char otherwise[120];
    (void)snprintf(otherwise, sizeof otherwise,
                   negative > 0 ? "%lld of its weights would be negative, and heat could be"
                                : "no weight would be negative; %lld faces have no area",
                   (long long)(negative > 0 ? negative : flat));
    if (note[0] != '\0' || atexit(print_note) == 0) {
        (void)snprintf(note, sizeof note,
                       "The Laplacian is that of an intrinsic Delaunay triangulation, the same "
                       "surface with %lld edges flipped. With --laplacian cotangent, that of the "
                       "faces as they are, %s.\n",
                       (long long)flips, otherwise);
    }
}

bool laplacian_choose(intrinsic *out, const mesh *m, const char *name) {
    sl_off negative = 0;
    sl_int flat = 0;
    memset(out, 0, sizeof *out);
    laplacian_check(name);
    bool needed = intrinsic_is_needed(m, &negative, &flat);
    bool is_auto = name == NULL || strcmp(name, "auto") == 0;
    if (is_auto ? !needed : strcmp(name, "cotangent") == 0) {
        if (needed) {
            app_warn(
                "the cotangent Laplacian has %lld negative weights, and %d faces have no area: "
                "heat can be negative, and distances wrong",
                (long long)negative, (int)flat);
        }
        return false;
    }
    if (!intrinsic_create(out, m)) {
        app_warn("no Delaunay triangulation: the edges have no length, or memory is short; the "
                 "cotangent Laplacian is used");
        return false;
    }
    note_choice(out->flips, negative, flat);
    app_detail(
        "Laplacian  intrinsic: %lld edges flipped%s; %.3g added to lengths (negative weights "
        "before: %lld; faces without area: %d)\n",
        (long long)out->flips, out->share < 1 ? " in a double cover" : "", out->added,
        (long long)negative, (int)flat);
    if (!out->delaunay) {
        app_warn("the flips of edges did not end after %lld: weights remain negative",
                 (long long)out->flips);
    }
    return true;
}

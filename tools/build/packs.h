/* packs.h: packs of the library, the conditions that select them, and the calls that need them */
#ifndef BUILD_PACKS_H
#define BUILD_PACKS_H

#include "part_text.h"

enum { PACKS_MAX = 32, PACK_NAME_SIZE = 32, CONDITION_SIZE = 256 };

/* Packs, each by its macro without SL_WITH_. */
typedef struct pack_set {
    char names[PACKS_MAX][PACK_NAME_SIZE];
    size_t count;
} pack_set;

/* An #if, #ifdef or #ifndef opens a block, an #elif or #else begins its next branch. */
typedef enum directive { NO_DIRECTIVE, OPENS, NEXT_BRANCH, CLOSES } directive;

int has_pack(const pack_set *set, const char *name);

/* Adds the packs whose macros a text names, but not SL_WITH_ALL. */
void add_named_packs(pack_set *set, const char *text, size_t length);

/* Adds the packs of a list such as "change save". `known` are those that there are. */
void add_listed_packs(pack_set *set, const char *list, const pack_set *known);

/* Adds the packs that public/packs.h, whose text this is, defines where those of the set are. */
void add_implied_packs(pack_set *set, const char *bytes);

/* Writes the packs of a set, in the order of `known` and in small letters: "change, save". */
void append_packs(text *t, const pack_set *set, const pack_set *known);

/* The number of bytes of a line and of the lines that continue it. */
size_t whole_line(const char *line);

directive directive_of(const char *line);

/* Whether a directive's condition holds where these packs are on: 0 or 1; 1 for #else, -1 if the
 * condition reads anything but macros of packs. */
int condition_holds(const char *line, const pack_set *on);

/* Writes the condition of a block of the manifest in words: "SL_WITH_A and SL_WITH_B". Returns 0 if
 * it is not made of defined(SL_WITH_X) with && and || between them. to: CONDITION_SIZE bytes. */
int condition_in_words(char *to, const char *line);

/* Appends the names of the public functions that a part declares, one a line. */
void append_calls(text *names, const char *bytes);

/* Appends a macro for each of these names that turns a call into an identifier which says what the
 * call needs: sl_name_needs_SL_WITH_X. */
void append_needs(text *lines, const char *names, const char *condition);

#endif

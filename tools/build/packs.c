/* packs.c: packs of the library, the conditions that select them, and the calls that need them */
#include "packs.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

static const char prefix[] = "SL_WITH_";

static size_t identifier_length(const char *s) {
    size_t length = 0;
    while (isalnum((unsigned char)s[length]) || s[length] == '_')
        length++;
    return length;
}

int has_pack(const pack_set *set, const char *name) {
    for (size_t k = 0; k < set->count; k++) {
        if (strcmp(set->names[k], name) == 0) return 1;
    }
    return 0;
}

/* Adds a pack in capitals. */
static void add_pack(pack_set *set, const char *name, size_t length) {
    char capitals[PACK_NAME_SIZE];
    if (length >= PACK_NAME_SIZE) fail(name, 0, "name of a pack too long", NULL);
    for (size_t k = 0; k < length; k++)
        capitals[k] = (char)toupper((unsigned char)name[k]);
    capitals[length] = 0;
    if (has_pack(set, capitals)) return;
    if (set->count == PACKS_MAX) fail(capitals, 0, "too many packs", NULL);
    strcpy(set->names[set->count++], capitals);
}

void add_named_packs(pack_set *set, const char *bytes, size_t length) {
    const char *end = bytes + length;
    while ((bytes = strstr(bytes, prefix)) != NULL && bytes < end) {
        bytes += sizeof prefix - 1;
        size_t width = identifier_length(bytes);
        if (!(width == 3 && strncmp(bytes, "ALL", 3) == 0)) add_pack(set, bytes, width);
    }
}

void append_packs(text *t, const pack_set *set, const pack_set *known) {
    int is_first = 1;
    for (size_t k = 0; k < known->count; k++) {
        if (!has_pack(set, known->names[k])) continue;
        if (!is_first) append_string(t, ", ");
        for (const char *c = known->names[k]; *c; c++) {
            char small = (char)tolower((unsigned char)*c);
            append(t, &small, 1);
        }
        is_first = 0;
    }
}

void add_listed_packs(pack_set *set, const char *list, const pack_set *known) {
    for (list += strspn(list, " "); *list; list += strspn(list, " ")) {
        size_t length = strcspn(list, " ");
        pack_set one = {{{0}}, 0};
        add_pack(&one, list, length);
        if (!has_pack(known, one.names[0])) {
            text fix = {NULL, 0, 0};
            append_string(&fix, known->count ? "name some of: " : "there are no packs");
            append_packs(&fix, known, known);
            fail(one.names[0], 0, "no condition of the manifest names this pack", fix.bytes);
        }
        add_pack(set, list, length);
        list += length;
    }
}

size_t whole_line(const char *line) {
    size_t length = 0;
    do
        length += strcspn(line + length, "\n") + 1;
    while (length > 1 && line[length - 2] == '\\' && line[length]);
    return length;
}

/* The name of a directive, after # and blanks; "" for any other line. */
static const char *directive_name(const char *line) {
    line += strspn(line, " \t");
    return *line == '#' ? line + 1 + strspn(line + 1, " \t") : "";
}

static int is_word(const char *s, const char *word) {
    size_t length = strlen(word);
    return identifier_length(s) == length && strncmp(s, word, length) == 0;
}

directive directive_of(const char *line) {
    const char *name = directive_name(line);
    if (is_word(name, "if") || is_word(name, "ifdef") || is_word(name, "ifndef")) return OPENS;
    if (is_word(name, "elif") || is_word(name, "else")) return NEXT_BRANCH;
    return is_word(name, "endif") ? CLOSES : NO_DIRECTIVE;
}

/* ---- values of conditions ---- */

typedef struct condition {
    const char *at;
    const pack_set *on;
    int is_foreign; /* reads something other than macros of packs */
} condition;

static void skip_blanks_of(condition *c) {
    while (*c->at == ' ' || *c->at == '\t' || (c->at[0] == '\\' && c->at[1] == '\n'))
        c->at += *c->at == '\\' ? 2 : 1;
}

/* Skips a token if it is next. */
static int next_is(condition *c, const char *token) {
    skip_blanks_of(c);
    size_t length = strlen(token);
    if (strncmp(c->at, token, length) != 0) return 0;
    c->at += length;
    return 1;
}

/* Whether the pack of the macro that is next is on. */
static int macro_holds(condition *c) {
    skip_blanks_of(c);
    const size_t length = identifier_length(c->at), width = sizeof prefix - 1;
    char name[PACK_NAME_SIZE] = "";
    const char *macro = c->at;
    c->at += length;
    if (length <= width || length - width >= sizeof name || strncmp(macro, prefix, width) != 0) {
        c->is_foreign = 1;
        return 0;
    }
    memcpy(name, macro + width, length - width);
    return has_pack(c->on, name);
}

static int either_holds(condition *c);

static int operand_holds(condition *c) {
    int value;
    if (next_is(c, "!")) return !operand_holds(c);
    if (next_is(c, "(")) {
        value = either_holds(c);
        if (!next_is(c, ")")) c->is_foreign = 1;
        return value;
    }
    if (!next_is(c, "defined")) {
        c->is_foreign = 1;
        return 0;
    }
    const int has_parenthesis = next_is(c, "(");
    value = macro_holds(c);
    if (has_parenthesis && !next_is(c, ")")) c->is_foreign = 1;
    return value;
}

static int both_hold(condition *c) {
    int value = operand_holds(c);
    while (next_is(c, "&&"))
        value = operand_holds(c) && value;
    return value;
}

static int either_holds(condition *c) {
    int value = both_hold(c);
    while (next_is(c, "||"))
        value = both_hold(c) || value;
    return value;
}

/* The value of the condition of a directive. Macros other than those of packs are not defined. */
static int evaluate(const char *line, const pack_set *on, int *is_foreign) {
    const char *name = directive_name(line);
    condition c = {name + identifier_length(name), on, 0};
    *is_foreign = 0;
    if (is_word(name, "else")) return 1;
    int value;
    if (is_word(name, "ifdef") || is_word(name, "ifndef"))
        value = macro_holds(&c) == is_word(name, "ifdef");
    else
        value = either_holds(&c);
    skip_blanks_of(&c);
    *is_foreign = c.is_foreign || !(*c.at == '\n' || strncmp(c.at, "/*", 2) == 0);
    return value;
}

int condition_holds(const char *line, const pack_set *on) {
    int is_foreign, value = evaluate(line, on, &is_foreign);
    return is_foreign ? -1 : value;
}

int condition_in_words(char *to, const char *line) {
    const char *name = directive_name(line);
    pack_set none = {{{0}}, 0};
    size_t used = 0;
    condition c = {name + identifier_length(name), &none, 0};
    const int is_ifdef = is_word(name, "ifdef");
    if (!is_ifdef && !is_word(name, "if")) return 0;
    for (;;) {
        int closes = 0;
        if (!is_ifdef && !next_is(&c, "defined")) return 0;
        if (!is_ifdef) closes = next_is(&c, "(");
        skip_blanks_of(&c);
        const char *macro = c.at;
        macro_holds(&c);
        const size_t width = (size_t)(c.at - macro);
        if (c.is_foreign || (closes && !next_is(&c, ")"))) return 0;
        if (used + width + 6 > CONDITION_SIZE) fail(macro, 0, "condition too long", NULL);
        memcpy(to + used, macro, width);
        to[used += width] = 0;
        const int is_and = next_is(&c, "&&");
        if (!is_and && !next_is(&c, "||")) break;
        used += (size_t)sprintf(to + used, is_and ? " and " : " or ");
    }
    skip_blanks_of(&c);
    return *c.at == '\n' || strncmp(c.at, "/*", 2) == 0;
}

void add_implied_packs(pack_set *set, const char *bytes) {
    enum { BLOCKS_MAX = 16 };
    int holds[BLOCKS_MAX], was_taken[BLOCKS_MAX], is_foreign;
    size_t n_blocks = 0, n_off = 0; /* open blocks; those of them whose branch does not hold */
    for (const char *line = bytes; *line; line += whole_line(line)) {
        const directive d = directive_of(line);
        if (d == OPENS) {
            if (n_blocks == BLOCKS_MAX) fail("public/packs.h", 0, "blocks nest too deep", NULL);
            holds[n_blocks] = was_taken[n_blocks] = evaluate(line, set, &is_foreign);
            n_off += !holds[n_blocks++];
        } else if (d != NO_DIRECTIVE && n_blocks > 0) {
            n_off -= !holds[--n_blocks];
            if (d == CLOSES) continue;
            holds[n_blocks] = !was_taken[n_blocks] && evaluate(line, set, &is_foreign);
            was_taken[n_blocks] |= holds[n_blocks];
            n_off += !holds[n_blocks++];
        } else if (is_word(directive_name(line), "define") && n_off == 0) {
            add_named_packs(set, line, whole_line(line));
        }
    }
}

/* ---- calls of packs ---- */

void append_calls(text *names, const char *bytes) {
    static const char linkage[] = "SL_API ";
    for (const char *line = bytes; *line; line += strcspn(line, "\n") + 1) {
        if (strncmp(line, linkage, sizeof linkage - 1) != 0) continue;
        const char *end = line + strcspn(line, "("), *begin = end;
        while (begin > line && (isalnum((unsigned char)begin[-1]) || begin[-1] == '_'))
            begin--;
        append(names, begin, (size_t)(end - begin));
        append_string(names, "\n");
    }
}

void append_needs(text *lines, const char *names, const char *words) {
    for (const char *name = names; *name; name += strcspn(name, "\n") + 1) {
        const size_t length = strcspn(name, "\n");
        append_string(lines, "#define ");
        append(lines, name, length);
        append_string(lines, "(...) ");
        append(lines, name, length);
        append_string(lines, "_needs_");
        for (const char *c = words; *c; c++)
            append(lines, *c == ' ' ? "_" : c, 1);
        append_string(lines, "\n");
    }
}

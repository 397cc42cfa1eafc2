/* structure.h: rows of the supernodes, relative indices, and the scatter map of A into L */
#ifndef SLI_ANALYSIS_STRUCTURE_H
#define SLI_ANALYSIS_STRUCTURE_H

#include "pattern.h"

/* scatter_begin := sums of the numbers of entries of A in each supernode's columns. */
static void sli_scatter_map_count(sl_symbolic *S, const sli_pattern *columns,
                                  const sl_int *old_of) {
    sl_int s, k = 0;
    sl_off total = 0;
    for (s = 0; s < S->n_supers; s++) {
        S->scatter_begin[s] = total;
        for (; k < S->super_first[s + 1]; k++) {
            total += columns->begin[old_of[k] + 1] - columns->begin[old_of[k]];
        }
    }
    S->scatter_begin[S->n_supers] = total;
}

/* Sets the bit of row r. The words with bits are listed, as keys. Returns their number. */
SLI_ALWAYS_INLINE sl_int sli_structure_set(uint64_t *bits, uint64_t *word, sl_int count, sl_int r) {
    const uint32_t at = (uint32_t)r / 64;
    const uint64_t before = bits[at];
    word[count] = (uint64_t)at << 32;
    bits[at] = before | (uint64_t)1 << ((uint32_t)r % 64);
    return count + (before == 0);
}

/* Copies the entries of A in the columns of supernode s: each with its row, its position in A and
 * its column in the supernode. Sets the bits of the rows. */
static sl_int sli_structure_gather(const sli_analysis *w, sl_int s, uint64_t *bits, uint64_t *word,
                                   sl_int *copy) {
    const sl_symbolic *S = w->S;
    const sl_int *new_of = w->new_of;
    sl_int k, count = 0;
    for (k = S->super_first[s]; k < S->super_first[s + 1]; k++) {
        const sl_int *begin = w->columns.begin + w->old_of[k];
        const sl_int *entry = w->columns.entry + 2 * (size_t)begin[0];
        const sl_int *stop = w->columns.entry + 2 * (size_t)begin[1];
        for (; entry < stop; entry += 2, copy += 3) {
            const sl_int row = new_of[entry[0]];
            copy[0] = row;
            copy[1] = entry[1];
            copy[2] = k - S->super_first[s];
            count = sli_structure_set(bits, word, count, row);
        }
    }
    return count;
}

/* Fills the rows below supernode s: those whose bits are set, and those below its children. The
 * bits are cleared again by the search for them, in ascending words.
 *
 * A row of one part of a supernode that was split is also a row of the parts before it: those have
 * fewer rows than they should until sli_structure_parts. */
static void sli_structure_rows(const sl_symbolic *S, sl_int s, sl_int count, uint64_t *bits,
                               uint64_t *word, uint64_t *scratch) {
    const sl_int end = S->super_first[s + 1];
    const sl_int first = S->super_first[s];
    sl_off at = S->rows_begin[s], r;
    sl_int c, q;
    for (c = s - 1; c >= S->first_descendant[s]; c = S->first_descendant[c] - 1) {
        for (r = S->rows_begin[c]; r < S->rows_begin[c + 1]; r++) {
            count = sli_structure_set(bits, word, count, S->rows[r]);
        }
    }
    /* without its own columns */
    memset(bits + first / 64, 0, (size_t)(end / 64 - first / 64) * sizeof *bits);
    bits[end / 64] &= ~(uint64_t)0 << (end % 64);
    sli_sort(word, count, scratch);
    for (q = 0; q < count; q++) {
        uint64_t *here = bits + sli_key(word[q]), left = *here;
        for (*here = 0; left != 0; left &= left - 1) {
            S->rows[at++] = 64 * sli_key(word[q]) + sli_lowest_bit(left);
        }
    }
    for (; at < S->rows_begin[s + 1]; at++) { /* a part: its parent has this column */
        S->rows[at] = S->super_first[S->super_parent[s]];
    }
    SLI_ASSERT(at == S->rows_begin[s + 1]);
}

/* Each part of a supernode that was split has the columns of the next one and its rows. */
static void sli_structure_parts(const sli_analysis *w) {
    const sl_symbolic *S = w->S;
    sl_int s, k;
    for (s = S->n_supers - 1; s >= 0; s--) {
        if (w->earlier[s] != -1) {
            sl_int *rows = S->rows + S->rows_begin[w->earlier[s]];
            for (k = S->super_first[s]; k < S->super_first[s + 1]; k++) {
                *rows++ = k;
            }
            memcpy(rows, S->rows + S->rows_begin[s],
                   (size_t)(S->rows_begin[s + 1] - S->rows_begin[s]) * sizeof(sl_int));
        }
    }
}

/* Fills the relative indices of the children of supernode s. local: n of scratch; on return it has
 * the local rows of s. */
static void sli_fill_relative_of(const sl_symbolic *S, sl_int s, sl_int *local) {
    const sl_off begin = S->rows_begin[s];
    const sl_int first = S->super_first[s], width = S->super_first[s + 1] - first;
    sl_int c;
    sl_off at;
    for (c = 0; c < width; c++) {
        local[first + c] = c;
    }
    for (at = begin; at < S->rows_begin[s + 1]; at++) {
        local[S->rows[at]] = width + (sl_int)(at - begin);
    }
    for (c = s - 1; c >= S->first_descendant[s]; c = S->first_descendant[c] - 1) {
        for (at = S->rows_begin[c]; at < S->rows_begin[c + 1]; at++) {
            S->relative[at] = local[S->rows[at]];
        }
    }
}

/* Fills the scatter map of supernode s, sorted by rows. Entries of one position are neighbors, in
 * the order of A. local: the local row of each row; next, tile: scratch, as many as s has local
 * rows and row tiles. */
static void sli_structure_map(const sl_symbolic *S, sl_int s, const sl_int *entry,
                              const sl_int *local, sl_int *next, sl_off *tile) {
    const sl_int width = S->super_first[s + 1] - S->super_first[s];
    const sl_int height = width + (sl_int)(S->rows_begin[s + 1] - S->rows_begin[s]);
    const sl_int count = (sl_int)(S->scatter_begin[s + 1] - S->scatter_begin[s]);
    sl_int total = (sl_int)S->scatter_begin[s], e, r; /* fits: at most the entries of A */
    memset(next, 0, (size_t)height * sizeof(sl_int));
    for (e = 0; e < count; e++) {
        next[local[entry[3 * (size_t)e]]]++;
    }
    for (r = 0; r < height; r++) {
        const sl_int here = next[r];
        next[r] = total;
        total += here;
    }
    for (r = 0; r < sli_tiles(height); r++) {
        tile[r] = S->panel_begin[s] + sli_tile_offset(width, r);
    }
    for (e = 0; e < count; e++, entry += 3) {
        const sl_int row = local[entry[0]], to = next[row]++;
        S->scatter_from[to] = entry[1];
        S->scatter_to[to] = tile[(uint32_t)row / SLI_TILE] + (uint32_t)row % SLI_TILE +
                            SLI_TILE * (sl_off)entry[2];
    }
}

/* Fills the rows of supernodes first .. last, then the relative indices of their children and the
 * scatter map. Where supernodes were split, all rows are filled before the rest. */
static void sli_structure_run(const sli_analysis *w, sl_int first, sl_int last, sl_int worker) {
    const sl_symbolic *S = w->S;
    const size_t words = (size_t)w->n / 64 + 1;
    sl_int *local = w->room + (uint64_t)worker * SLI_ANALYSIS_ROOM(w->n);
    uint64_t *bits = (uint64_t *)(void *)(local + 2 * (size_t)w->n), *word = bits + words;
    sl_off *tile = (sl_off *)(void *)(word + 2 * words);
    sl_int *copy = w->spare + 3 * (size_t)S->scatter_begin[first], s, q;
    memset(bits, 0, words * sizeof(uint64_t));
    for (s = first; s <= last; s++) {
        const sl_int count = sli_structure_gather(w, s, bits, word, copy);
        if (!w->has_rows) {
            sli_structure_rows(S, s, count, bits, word, word + words);
        }
        for (q = 0; q < count && w->has_rows; q++) {
            bits[sli_key(word[q])] = 0;
        }
        if (w->has_rows || w->earlier == NULL) {
            sli_fill_relative_of(S, s, local);
            sli_structure_map(S, s, copy, local, local + w->n, tile);
        }
    }
}

/* The rows and entries of supernodes first .. last. */
SLI_INLINE sl_off sli_structure_size(const sl_symbolic *S, sl_int first, sl_int last) {
    return S->rows_begin[last + 1] - S->rows_begin[first] + S->scatter_begin[last + 1] -
           S->scatter_begin[first];
}

/* Finds runs: each of whole subtrees, a quarter of a worker's share at most. */
static void sli_structure_divide(sli_analysis *w) {
    const sl_symbolic *S = w->S;
    const sl_off most = sli_structure_size(S, 0, S->n_supers - 1) / (4 * (sl_off)w->workers);
    sl_int s = S->n_supers - 1, last = -1; /* of the run under way */
    while (s >= 0) {
        const sl_int first = S->first_descendant[s];
        if (sli_structure_size(S, first, s) > most) {
            last = -1;
            s--;
            continue;
        }
        if (last == -1 || sli_structure_size(S, first, last) > most) {
            if (w->n_runs == SLI_ANALYSIS_RUNS) {
                return;
            }
            last = w->last[w->n_runs++] = s;
        }
        w->first[w->n_runs - 1] = first;
        s = first - 1;
    }
}

static void sli_structure_item(void *data, sl_int item, sl_int worker) {
    const sli_analysis *w = (const sli_analysis *)data;
    sli_structure_run(w, w->first[item], w->last[item], worker);
}

/* A pass over all supernodes: the runs by the team, then the rest. */
static void sli_structure_pass(sli_analysis *w, sli_team *team) {
    sl_int r, next = 0;
    if (w->n_runs > 0) {
        sli_team_loop(team, w->n_runs, NULL, sli_structure_item, w);
    }
    for (r = w->n_runs - 1; r >= 0; r--) {
        sli_structure_run(w, next, w->first[r] - 1, 0);
        next = w->last[r] + 1;
    }
    sli_structure_run(w, next, w->S->n_supers - 1, 0);
}

/* Fills the rows of all supernodes, then their relative indices and the scatter map. It needs
 * first_descendant. */
static void sli_fill_structure(sli_analysis *w, sl_symbolic *S, sli_team *team) {
    sli_scatter_map_count(S, &w->columns, w->old_of);
    w->S = S;
    w->n_runs = 0;
    w->has_rows = 0;
    if (w->workers > 1) {
        sli_structure_divide(w);
    }
    sli_structure_pass(w, team);
    if (w->earlier != NULL) {
        sli_structure_parts(w);
        w->has_rows = 1;
        sli_structure_pass(w, team);
    }
}

/* Fills the steps of a sweep over all supernodes: the vector has all n columns, so that `base` is
 * the column. */
static void sli_fill_steps(sl_symbolic *S) {
    sl_int s;
    S->tallest = 0;
    S->widest = 0;
    for (s = 0; s < S->n_supers; s++) {
        sli_step *step = &S->steps[s];
        step->panel = S->panel_begin[s];
        step->column = S->super_first[s];
        step->base = S->super_first[s];
        step->width = S->super_first[s + 1] - S->super_first[s];
        step->below = (sl_int)(S->rows_begin[s + 1] - S->rows_begin[s]);
        step->first_tile = 0;
        step->up = S->super_parent[s];
        S->widest = sli_max(S->widest, step->width);
        S->tallest = sli_max(S->tallest, step->width + step->below);
    }
}

/* Fills first_descendant. As supernodes are in postorder, the children of s are s - 1, then the
 * supernode before the first descendant of s - 1, and so on, down to the first descendant of s. */
static void sli_fill_descendants(sl_symbolic *S) {
    sl_int s;
    for (s = 0; s < S->n_supers; s++) {
        S->first_descendant[s] = s;
    }
    for (s = 0; s < S->n_supers; s++) {
        const sl_int up = S->super_parent[s];
        if (up != -1) {
            S->first_descendant[up] = sli_min(S->first_descendant[up], S->first_descendant[s]);
        }
    }
}

/* Fills the relative indices of all supernodes in their parents' fronts. local: n of scratch. */
static void sli_fill_relative(sl_symbolic *S, sl_int *local) {
    sl_int s;
    for (s = 0; s < S->n_supers; s++) {
        sli_fill_relative_of(S, s, local);
    }
}

/* The last row tile of supernode s. */
SLI_INLINE sl_int sli_last_tile(const sl_symbolic *S, sl_int s) {
    return sli_tiles(S->steps[s].width + S->steps[s].below) - 1;
}

/* Finds the pivots k >= j such that entry m of the scatter map goes to L(k, j). m belongs to
 * supernode s. tile: where to start, the row tile of m or a later one; set to the tile of m. Within
 * a supernode the rows ascend along the map: a backward pass that starts with the last tile visits
 * each tile once. */
static void sli_scatter_map_pivots(const sl_symbolic *S, sl_int s, sl_off m, sl_int *tile,
                                   sl_int *k, sl_int *j) {
    const sl_int first = S->super_first[s], w = S->steps[s].width;
    sl_off in_tile = S->scatter_to[m] - S->panel_begin[s];
    sl_int local;
    while (sli_tile_offset(w, *tile) > in_tile) {
        --*tile;
    }
    in_tile -= sli_tile_offset(w, *tile);
    local = SLI_TILE * *tile + (sl_int)(in_tile % SLI_TILE);
    *j = first + (sl_int)(in_tile / SLI_TILE);
    *k = local < w ? first + local : S->rows[S->rows_begin[s] + local - w];
    SLI_ASSERT(S->panel_begin[s] + sli_panel_at(w, local, *j - first) == S->scatter_to[m]);
}

#endif

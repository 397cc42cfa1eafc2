/* simd.h: the SIMD vocabulary of the kernel templates, and macros that repeat code */
#ifndef SLI_KERNELS_SIMD_H
#define SLI_KERNELS_SIMD_H

#include "../panel.h"

/* A template *.inl.h is compiled once for each instruction set. It uses two groups of words:
 * words_*.inl.h define SLV_, and lanes_*.inl.h define SLW_ for SLW_NRHS right-hand sides.
 * lanes_undef.inl.h undefines them. Lists of templates, *.list.h, are included by each_isa.list.h.
 * Who includes that defines the parameters before it, and undefines them:
 *
 *  SLV_SINGLE             1: L is in float; 0: double. All else is double
 *  SLV_COMPLEX            1: a column of a front is the first one of a pair of real columns; else 0
 *
 * each_lanes.list.h compiles a list once for each number of right-hand sides that an instruction
 * set has lanes for. lanes_*.inl.h say what these passes are:
 *
 *  SLW_PASS               1, 2 or 3, by each_lanes.list.h. Fronts and sweeps of one vector are
 *                         compiled in pass 1
 *  SLW_NRHS               the number of right-hand sides of the pass
 *  SLW_GROUPS             defined: sweeps take several groups of SLW_NRHS right-hand sides, up to
 *                         SLW_GROUPS in all: the largest SLW_NRHS of an instruction set, and those
 *                         of complex matrices
 *  SLW_TWO                defined: two_rhs.inl.h is compiled in this pass
 *  SLW_LAST               defined: this is the last pass, in which tables are filled
 *
 * A list without passes defines SLW_NRHS, if its templates use SLW_, and SLW_LAST.
 *
 * SLV_: a, b, c are vectors of 8 doubles, the lanes: one column of a row tile.
 *
 *  SLV_NAME(f)            name of function f in this instruction set
 *  SLV_NAME_SHORT(f)      name of f where it gains nothing from longer registers: for 2 and 4
 *                         right-hand sides, supernodes of at most 8 columns, tiles of pivots
 *  SLV_OWN_SHORT          defined: this is SLV_NAME, and f is compiled for this instruction set
 *  SLV_OWN_ROUND          defined: sli_single_round_ of this instruction set is in intrinsics, and
 *                         not the plain C of float_set.inl.h
 *  SLV_PLAIN              defined: this is plain C
 *  SLV_ARRAYS             defined: vectors are arrays, and tiles of fronts are computed in loops;
 *                         not with SLV_COMPLEX 1
 *  SLV_ISA, SLV_WIDTH     its sl_isa; the doubles of a register, 1 in plain C
 *  SLV_FUNCTION           the attributes of a function
 *  SLV_FNMA1(a, b, c)     scalars: c - a b, fused where the vectors are
 *  SLV_DECLARE(a)         declares a
 *  SLV_ZERO(a)            a = 0
 *  SLV_LOAD(a, p)         a = p[0..7]; p is 64-byte aligned
 *  SLV_LOAD_PINNED(a, p)  the same; the compiler may not load it again at each use
 *  SLV_LOAD_PART(a, p, count, rest)   lanes 0 .. count-1 = p[lane], the others = rest
 *  SLV_STORE(p, a)        p[0..7] = a; p is 64-byte aligned. SLV_STORE_ANY: p is not aligned
 *  SLV_STREAM(p, a)       SLV_STORE of a cache line around the caches; other threads may see it
 *                         after SLV_STREAM_END; SLV_STORE where there is no such instruction
 *  SLV_BROADCAST(b, p)    every lane of b = *p
 *  SLV_LANE(b, a, k)      every lane of b = lane k of a; k is a constant
 *  SLV_GATHER(a, x, at)   lane k of a = x[at(k)]; at is a macro
 *  SLV_FIRST(a, count)    lanes count .. 7 of a = 0
 *  SLV_BELOW(a, k)        lanes 0 .. k of a = 0
 *  SLV_ADD(a, b)          a += b
 *  SLV_TURN(a, b)         pairs of lanes as complex numbers: a = i b. SLV_TURN_BACK: a = -i b
 *  SLV_MULTIPLY(a, b, c)  a = b c. SLV_DIVIDE: a = b / c. SLV_FNMA: a -= b c
 *  SLV_AXPY(a, l, p)      a -= l[0..7] * *p
 *  SLV_DOT(a, l, v)       a -= l[0..7] v, lane by lane
 *  SLV_TRANSPOSE(to, from)            8 x 8 doubles, both 64-byte aligned
 *  SLV_EXPAND(mask, lanes, count)     prepares SLV_EXPAND_ADD(to, from), which adds from[i] to
 *                                     to[lanes[i]], i < count. mask has the bits of the lanes
 *  SLV_REPEAT_ROWS(t, l, k)           t = l[4k] l[4k] l[4k+1] l[4k+1] .. l[4k+3] l[4k+3], k = 0, 1
 *  SLV_REPEAT(b, p)       b = p[0] p[1] p[0] p[1] p[0] p[1] p[0] p[1]
 *
 *  What depends on the type of L:
 *
 *  SLV_VALUE              the type of an entry of L
 *  SLV_SWEEP(f)           SLV_NAME of a function that reads L. SLV_SWEEP_SHORT(f): its
 *                         SLV_NAME_SHORT, SLW_SWEEP(f): its SLW_NAME
 *  SLV_READ(l)            what SLV_AXPY, SLV_DOT, SLV_SUM_DOT and SLV_REPEAT_ROWS load, as doubles;
 *                         each instruction set defines SLV_READ_0 for double, SLV_READ_1 for float
 *  SLV_WIDE(v, columns)   declares v for SLV_WIDEN(v, l, columns, rows): v = columns 0 .. columns-1
 *                         from l on, their first 4 or 8 rows, as doubles, [column][8]. For scalars
 *                         of L; L in double is not copied. SLV_WIDEN_ROWS(v, l, rows): one column
 *
 *  Fronts of complex matrices keep every other column (panel.h):
 *
 *  SLV_PARTS              the real columns that a column of a front is kept for: 1 or 2
 *  SLV_FRONT(f)           SLV_NAME of a function of fronts
 *
 *  SLV_SUM_: an accumulator of partial sums, at most 8, as many as suit the registers.
 *  SLV_SUM_DECLARE, _ZERO, _LOAD, _STORE as above; an accumulator has room for 8 doubles in memory
 *  SLV_SUM_DOT(a, l, v)   a -= l[0..7] v, in partial sums
 *  SLV_SUMS(r, a)         lane k of vector r = the sum of accumulator a##k, k = 0 .. 7
 *
 *  SLV_TILES, SLV_COLUMNS             row tiles and columns of the register block of a product
 *  SLV_VECTOR_TILES                   row tiles of a vector in products and below the pivots: 1, or
 *                                     2 with SLV_LOAD_TILES(a, p, q), SLV_STORE_TILES(p, q, a)
 *  SLV_HAS_HALF           defined: the second vector of that block has 4 lanes, two blocks are
 *                         SLV_TILES = 3 row tiles, and the words SLV_HALF_ are those of 4 lanes
 *  SLV_AHEAD              entries of A that a block of more than one vector prefetches for each
 *                         column of A: SLV_TILES row tiles in the blocks of 64 columns
 *  SLV_EACH_COLUMN(op, t)             op(0, t) op(1, t) .. over the columns of that block
 *
 * SLW_: a, b are vectors of SLW_NRHS doubles: one row of as many right-hand sides; s is a scalar.
 *
 *  SLW_NAME(f)            name of function f
 *  SLW_ROWS               rows that are kept in registers, 4 or 8: a0, a1, ..
 *  SLW_EACH(op, k)        op(0, k) op(1, k) .. over these rows. SLW_EACH_AGAIN: the same inside
 *                         SLW_EACH. SLW_HIGH, SLW_LOW: its halves in descending order
 *  SLW_HALF(f)            defined where 8 rows do not fit in the registers: name of f for half as
 *                         many right-hand sides, which supernodes of at most 8 columns take in turn
 *  SLW_DECLARE, SLW_ZERO, SLW_ADD     as above; SLW_LOAD and SLW_STORE need no alignment
 *  SLW_FNMA(a, s, b)      a -= s b; s is a double, with SLW_TAKES_FLOATS an SLV_VALUE
 *  SLW_DIVIDE(a, s)       a /= s
 */

/* op(0, k) op(1, k) .. over 4 or 8 values; _AGAIN is the same macro for use inside itself; HIGH and
 * LOW are the two halves in descending order. */
#define SLI_EACH4(op, k) op(0, k) op(1, k) op(2, k) op(3, k)
#define SLI_EACH8(op, k) SLI_EACH4(op, k) op(4, k) op(5, k) op(6, k) op(7, k)
#define SLI_EACH4_AGAIN(op, k) op(0, k) op(1, k) op(2, k) op(3, k)
#define SLI_EACH8_AGAIN(op, k) SLI_EACH4_AGAIN(op, k) op(4, k) op(5, k) op(6, k) op(7, k)
#define SLI_HIGH4(op, k) op(3, k) op(2, k)
#define SLI_HIGH8(op, k) op(7, k) op(6, k) op(5, k) op(4, k)
#define SLI_LOW4(op, k) op(1, k) op(0, k)
#define SLI_LOW8(op, k) op(3, k) op(2, k) op(1, k) op(0, k)
/* Is the constant k one of 0 .. count-1? There is at least 0. */
#define SLI_IS_IN(k, count) ((k) == 0 || (k) < (count))

/* One case of a switch over the numbers that a function is compiled for as constants. */
#define SLI_CASE(k, call) \
    case k: \
        call(k); \
        break;

/* SLV_EXPAND and SLV_EXPAND_ADD for instruction sets that have no instruction for them. */
#define SLI_EXPAND_PLAIN(mask, lanes, count) \
    const sl_int *lanes_ = (lanes), count_ = (count); \
    (void)(mask);
#define SLI_EXPAND_ADD_PLAIN(to, from) \
    { \
        SLV_VALUE *to_ = (to); \
        const SLV_VALUE *from_ = (from); \
        sl_int i_; \
        for (i_ = 0; i_ < count_; i_++) { \
            to_[lanes_[i_]] += from_[i_]; \
        } \
    }

/* Repeats a statement over i_, where a vector is an array. */
#define SLI_LOOP(count, statement) \
    { \
        int i_; \
        for (i_ = 0; i_ < (count); i_++) { \
            statement; \
        } \
    }

/* SLI_EACH8 of vectors in an array a: in op, a##k and a##j are ak_ and aj_. */
#define SLI_EACH_ARRAY(op, k) \
    { \
        int k_; \
        for (k_ = 0; k_ < SLI_TILE; k_++) { \
            double *ak_ = a[k_]; \
            op(k_, k)(void) ak_; \
        } \
    }
#define SLI_EACH_ARRAY_AGAIN(op, k) \
    { \
        int j_; \
        for (j_ = 0; j_ < SLI_TILE; j_++) { \
            double *aj_ = a[j_]; \
            op(j_, k) \
        } \
    }

/* What depends on the type of L. */
#define SLI_PASTE(a, b) a##b
#define SLI_BY_TYPE(word, is_single) SLI_PASTE(word, is_single)
#define SLI_VALUE_0 double
#define SLI_VALUE_1 float
#define SLI_SWEEP_0(name, f) name(f)
#define SLI_SWEEP_1(name, f) name(single_##f)
#define SLI_FRONT_0(name, f) name(f)
#define SLI_FRONT_1(name, f) name(complex_##f)
#define SLI_WIDE_0(v, columns) const double *v;
#define SLI_WIDE_1(v, columns) SLI_ALIGNED(double v[SLI_TILE * (columns)]);
#define SLI_WIDEN_0(v, l, columns, rows) v = (l);
#define SLI_WIDEN_1(v, l, columns, rows) \
    { \
        sl_int c_; \
        for (c_ = 0; c_ < (columns); c_++) { \
            SLV_WIDEN_ROWS(v + SLI_TILE * c_, (l) + SLI_TILE * c_, rows) \
        } \
    }
#define SLV_VALUE SLI_BY_TYPE(SLI_VALUE_, SLV_SINGLE)
#define SLV_PARTS (1 + SLV_COMPLEX)
#define SLV_FRONT(f) SLI_BY_TYPE(SLI_FRONT_, SLV_COMPLEX)(SLV_NAME, f)
#define SLV_FRONT_SHORT(f) SLI_BY_TYPE(SLI_FRONT_, SLV_COMPLEX)(SLV_NAME_SHORT, f)
#define SLV_SWEEP(f) SLI_BY_TYPE(SLI_SWEEP_, SLV_SINGLE)(SLV_NAME, f)
#define SLV_SWEEP_SHORT(f) SLI_BY_TYPE(SLI_SWEEP_, SLV_SINGLE)(SLV_NAME_SHORT, f)
#define SLW_SWEEP(f) SLI_BY_TYPE(SLI_SWEEP_, SLV_SINGLE)(SLW_NAME, f)
#define SLW_SWEEP_HALF(f) SLI_BY_TYPE(SLI_SWEEP_, SLV_SINGLE)(SLW_HALF, f)
#define SLV_READ(l) SLI_BY_TYPE(SLV_READ_, SLV_SINGLE)(l)
/* Two columns of L in float share a cache line. column: a constant */
#define SLV_PREFETCH(l, column, bytes) \
    if (!SLV_SINGLE || (column) % 2 == 0) { \
        SLI_PREFETCH((l) + SLI_TILE * (column), bytes); \
    }
#define SLV_WIDE(v, columns) SLI_BY_TYPE(SLI_WIDE_, SLV_SINGLE)(v, columns)
#define SLV_WIDEN(v, l, columns, rows) SLI_BY_TYPE(SLI_WIDEN_, SLV_SINGLE)(v, l, columns, rows)

#endif

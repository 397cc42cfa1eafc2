/* unit_triangle.inl.h: one right-hand side through the unit triangle of a diagonal tile */

/* In scalars: 28 FMAs; the longest chain of dependent ones has 7. */

#define SLI_X(k, j) r##k = SLV_FNMA1(v[SLI_TILE * j + k], r##j, r##k);  /* r(k) -= L(k, j) r(j) */
#define SLI_XT(j, k) r##j = SLV_FNMA1(v[SLI_TILE * j + k], r##k, r##j); /* r(j) -= L(k, j) r(k) */

/* clang-format off */

/* r := L^-1 r. l: diagonal part of the tile, 8 x 8, column-major. */
SLV_FUNCTION SLI_INLINE void SLV_SWEEP(tile_forward)(const SLV_VALUE *l, double *r) {
    SLV_WIDE(v, SLI_TILE)
    double r0 = r[0], r1 = r[1], r2 = r[2], r3 = r[3], r4 = r[4], r5 = r[5], r6 = r[6], r7 = r[7];
    SLV_WIDEN(v, l, SLI_TILE, SLI_TILE)
    SLI_X(1, 0) SLI_X(2, 0) SLI_X(3, 0) SLI_X(4, 0) SLI_X(5, 0) SLI_X(6, 0) SLI_X(7, 0)
    SLI_X(2, 1) SLI_X(3, 1) SLI_X(4, 1) SLI_X(5, 1) SLI_X(6, 1) SLI_X(7, 1)
    SLI_X(3, 2) SLI_X(4, 2) SLI_X(5, 2) SLI_X(6, 2) SLI_X(7, 2)
    SLI_X(4, 3) SLI_X(5, 3) SLI_X(6, 3) SLI_X(7, 3)
    SLI_X(5, 4) SLI_X(6, 4) SLI_X(7, 4)
    SLI_X(6, 5) SLI_X(7, 5)
    SLI_X(7, 6)
    r[1] = r1, r[2] = r2, r[3] = r3, r[4] = r4, r[5] = r5, r[6] = r6, r[7] = r7;
}

/* r := L'^-1 r */
SLV_FUNCTION SLI_INLINE void SLV_SWEEP(tile_backward)(const SLV_VALUE *l, double *r) {
    SLV_WIDE(v, SLI_TILE)
    double r0 = r[0], r1 = r[1], r2 = r[2], r3 = r[3], r4 = r[4], r5 = r[5], r6 = r[6], r7 = r[7];
    SLV_WIDEN(v, l, SLI_TILE, SLI_TILE)
    SLI_XT(6, 7) SLI_XT(5, 7) SLI_XT(4, 7) SLI_XT(3, 7) SLI_XT(2, 7) SLI_XT(1, 7) SLI_XT(0, 7)
    SLI_XT(5, 6) SLI_XT(4, 6) SLI_XT(3, 6) SLI_XT(2, 6) SLI_XT(1, 6) SLI_XT(0, 6)
    SLI_XT(4, 5) SLI_XT(3, 5) SLI_XT(2, 5) SLI_XT(1, 5) SLI_XT(0, 5)
    SLI_XT(3, 4) SLI_XT(2, 4) SLI_XT(1, 4) SLI_XT(0, 4)
    SLI_XT(2, 3) SLI_XT(1, 3) SLI_XT(0, 3)
    SLI_XT(1, 2) SLI_XT(0, 2)
    SLI_XT(0, 1)
    r[0] = r0, r[1] = r1, r[2] = r2, r[3] = r3, r[4] = r4, r[5] = r5, r[6] = r6;
}

/* clang-format on */

#undef SLI_X
#undef SLI_XT

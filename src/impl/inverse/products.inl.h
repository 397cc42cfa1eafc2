/* products.inl.h: sums of products of 8 by 8 right-hand sides, for blocks of the inverse */

#define SLI_DECLARE(r, k) SLW_DECLARE(a##r)
#define SLI_LOAD(r, p) SLW_LOAD(a##r, (p) + (r)*distance)
#define SLI_STORE(r, p) SLW_STORE((p) + (r)*distance, a##r)
#define SLI_APPLY(r, l) SLW_FNMA(a##r, (l)[r], b)

/* Computes SLW_ROWS rows of sums at a time; see sli_products_kernel. */
SLV_FUNCTION static void SLW_NAME(products)(sl_int count, const double *y, const double *z,
                                            double *sums) {
    enum { distance = SLW_NRHS };
    sl_int row, k;
    for (row = 0; row < SLW_NRHS; row += SLW_ROWS) {
        const double *l = y + row, *p = z;
        double *s = sums + row * SLW_NRHS;
        SLW_EACH(SLI_DECLARE, 0)
        SLW_DECLARE(b)
        SLW_EACH(SLI_LOAD, s)
        for (k = 0; k < count; k++, l += SLW_NRHS, p += SLW_NRHS) {
            SLW_LOAD(b, p)
            SLW_EACH(SLI_APPLY, l)
        }
        SLW_EACH(SLI_STORE, s)
    }
}

#undef SLI_DECLARE
#undef SLI_LOAD
#undef SLI_STORE
#undef SLI_APPLY

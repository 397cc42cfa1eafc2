/* version.c: is the library new enough, and is the compiled one that of the header? */
#include "example.h"

#if SL_VERSION < 10000 || SL_VERSION_MAJOR > 1
#error "this program needs sparse_local.h 1.x"
#endif

int main(void) {
    /* a compiled library may be newer than the header, but not older */
    const int version = sl_version();
    printf("sparse_local %d.%d.%d\n", version / 10000, version / 100 % 100, version % 100);
    return version / 10000 != SL_VERSION_MAJOR || version < SL_VERSION;
}

/* old_glibc.c: log, stat and fstat as every glibc has them, for wheels that run on old systems
 *
 * glibc gave log a new version in 2.29, without the error handler of SVID, and stat and fstat
 * became functions of their own in 2.33. A library that is linked on a newer system needs that
 * one or a newer one, for these three names alone. Linked with this object it calls the functions
 * that glibc keeps for old programs, which compute the same.
 */
#include <features.h>

#if defined(__GLIBC__) && (defined(__x86_64__) || defined(__aarch64__))
#include <sys/stat.h>

#if defined(__x86_64__)
#define FIRST "GLIBC_2.2.5" /* of this processor */
enum { STAT_VERSION = 1 };
#else
#define FIRST "GLIBC_2.17"
enum { STAT_VERSION = 0 };
#endif
#define HIDDEN __attribute__((visibility("hidden")))

#if __GLIBC_PREREQ(2, 29)
__asm__(".symver first_log, log@" FIRST);
double first_log(double x);
double log(double x);

HIDDEN double log(double x) {
    return first_log(x);
}
#endif

#if __GLIBC_PREREQ(2, 33)
__asm__(".symver first_stat, __xstat@" FIRST);
__asm__(".symver first_fstat, __fxstat@" FIRST);
int first_stat(int version, const char *path, struct stat *to);
int first_fstat(int version, int file, struct stat *to);

HIDDEN int stat(const char *path, struct stat *to) {
    return first_stat(STAT_VERSION, path, to);
}

HIDDEN int fstat(int file, struct stat *to) {
    return first_fstat(STAT_VERSION, file, to);
}
#endif
#endif

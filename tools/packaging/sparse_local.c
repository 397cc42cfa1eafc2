/* sparse_local.c: the bodies of sparse_local.h with all packs, for the compiled library */
#ifndef SL_API
#if defined(_WIN32) && defined(SL_SHARED)
#define SL_API __declspec(dllexport)
#elif defined(__GNUC__)
#define SL_API __attribute__((visibility("default")))
#endif
#endif
#if !defined(SL_WITH_ALL)
#define SL_WITH_ALL
#endif
#define SPARSE_LOCAL_IMPLEMENTATION
#include "sparse_local.h"

/* sparse_local.c: the bodies of sparse_local.h with all packs, for the compiled library
 *
 * For bindings of other languages: sl_matrix_view, sl_symbolic_view, sl_factor_view,
 * sl_selected_view, sl_region_view and sl_fixed_view return a struct by value. ctypes, cffi, Julia,
 * Rust, Go, C# and Java's linker take its members. Where only numbers and pointers can
 * be declared: each of these structs has more than 16 bytes, and the ABI passes the address of the
 * result. On x86-64, with any system, and in WebAssembly it is a first argument, before the object:
 *
 *     void *sl_factor_view(sl_factor_arrays *result, const sl_factor *F);      as it is called
 *
 * On aarch64 the address is in register x8, which no declaration reaches: write a C function that
 * stores the struct. The arrays belong to the object, as the declaration says. */
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

/* heat_system.h: the factored diffusion operator M + t L of a mesh, and the options for its time */
#ifndef TOOLS_HEAT_SYSTEM_H
#define TOOLS_HEAT_SYSTEM_H

#include "laplacian_choice.h"
#include "solve_accuracy.h"

/** Values of the options --time, --scaled-time, --area-time, --laplacian; all 0 initially. */
typedef struct heat_time {
    double time;
    double scaled;
    double area;
    const char *laplacian;
} heat_time;

/** (M + t L) x = b diffuses heat b for a time t by one implicit step; M is the lumped mass, L the
 *  cotangent Laplacian (laplacian.h).
 *
 *  With L phi = lambda M phi and phi' M phi = 1, an entry of the inverse is a sum over all
 *  eigenvectors: x_ij = sum phi_i phi_j / (1 + t lambda). It is the heat per unit of area that a
 *  unit at j leaves at i.
 *
 *  Like all functions of this folder, those below end the program with a message on errors.
 */
typedef struct heat_system {
    sl_int n;
    double t;             /* of F; NAN: F is of a file, which does not say */
    double *terms[2];     /* M and L in the pattern of the analysis; M + t L combines them */
    sl_matrix *laplacian; /* L, lower triangle; NULL: of a file */
    double *mass;         /* n: the diagonal of M */
    accuracy_faces faces; /* of the triangulation that L is of */
    sl_symbolic *S;
    sl_factor *F;            /* NULL: analyzed only */
    sl_selected *selected;   /* of a file that has one; or NULL */
    sl_stats stats;          /* of analysis and factorization */
    double seconds_assemble; /* for L and M */
} heat_system;

/** Assembles M and L and analyzes their pattern.
 *
 *  h          [out]  release with heat_system_free.
 *  m          [in]   needed during the call only.
 *  laplacian  [in]   the value of --laplacian (laplacian_choice.h).
 *  opt        [in]   of sl_symbolic_create; may be NULL.
 */
void heat_system_analyze(heat_system *h, const mesh *m, const char *laplacian,
                         const sl_options *opt);

/** heat_system_analyze, then factors M + t L to h->F.
 *
 *  t    [in]  above 0, at most 1e200, in squared units of length.
 *  opt  [in]  of sl_symbolic_create and sl_factor_create; may be NULL.
 */
void heat_system_create(heat_system *h, const mesh *m, double t, const char *laplacian,
                        const sl_options *opt);

/** The system of a command's operand: of a mesh, whose time the options select as in
 *  heat_time_value, or of a file of sparse-local save, which is mapped.
 *
 *  h       [out]  of a file: S, F and, if it has one, the selected inverse.
 *  m       [out]  the mesh; of a file: as many vertices as there are rows, without coordinates and
 *                 faces.
 *  output  [in]   with a file, options that need the mesh are refused: times, pictures, meshes.
 */
void heat_system_open(heat_system *h, mesh *m, const char *operand, const heat_time *time,
                      double default_area, const app_output *output);

/** Dies unless t is above 0 and at most 1e200. */
void heat_check_time(double t);

/** "t = 0.01", or that the time is the one that the file was saved with; valid until the next
 *  call. */
const char *heat_system_time(const heat_system *h);

/** The auto-diffusion function of some vertices: diagonal entries of the inverse of h->F, read from
 *  the selected inverse if it has all of them.
 *
 *  values    [out]  count values.
 *  vertices  [in]   count vertices; NULL: all n, which count must be.
 */
void heat_system_diagonal(const heat_system *h, double *values, const sl_int *vertices,
                          sl_int count);

/** Factors M + t[k] L for several times in one call.
 *
 *  factors  [in,out]  count factors: either all NULL, or all from an earlier call with this h,
 *                     which are then refactored in place. Release with sl_factor_free.
 *  t        [in]      count times, each as in heat_system_create.
 *  threads  [in]      as in sl_factor_create_sums.
 */
void heat_system_factors(heat_system *h, sl_factor **factors, const double *t, sl_int count,
                         const sl_threads *threads);

/** Warns on standard error if the mesh leaves few digits to the solutions with M + t L
 *  (solve_accuracy.h); F is its factor. heat_system_create and heat_system_open have done this for
 *  h->F. */
void heat_system_warn(const heat_system *h, const sl_factor *F, double t);

/** Releases everything and sets h to all zero. */
void heat_system_free(heat_system *h);

/* The four entries of a command's table of options; h is a heat_time *. */
#define HEAT_TIME_OPTIONS(h, default_text) \
    {OPTION_ABOVE_0, "time", &(h)->time, "T", "diffuse for the time T"}, \
        {OPTION_ABOVE_0, "scaled-time", &(h)->scaled, "S", \
         "diffuse for S times the squared mean edge length"}, \
        LAPLACIAN_OPTION(&(h)->laplacian), { \
        OPTION_ABOVE_0, "area-time", &(h)->area, "A", \
            "diffuse for A times the area of the surface; " default_text \
    }

/** The time that the options select. Without an option: default_area times the area of the mesh if
 *  that is positive, else the squared mean edge length. Ends the program if more than one option is
 *  given or the time is not positive. */
double heat_time_value(const heat_time *h, const mesh *m, double default_area);

/** The total area of the faces. */
double heat_area(const mesh *m);

#endif

/* path_weight.c: the entries of L that a local solve at one row reads */
#include <stdlib.h>

#include "bench.h"

double bench_path_weight(const sl_symbolic *S, double *largest) {
    const sl_symbolic_arrays v = sl_symbolic_view(S);
    double *path = bench_alloc((size_t)v.n, sizeof *path), mean = 0, most = 0;
    for (sl_int k = v.n; k-- > 0;) {
        path[k] = (double)v.counts[k] + (v.parent[k] == -1 ? 0 : path[v.parent[k]]);
        mean += path[k] / (double)v.n;
        most = path[k] > most ? path[k] : most;
    }
    free(path);
    if (largest) {
        *largest = most;
    }
    return mean;
}

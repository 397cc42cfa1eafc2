/* peers_eigen.cpp: Eigen's simplicial LDL' of a matrix that comes permuted */
#include "peers.h"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <cstdio>
#include <cstdlib>

typedef Eigen::SparseMatrix<double> matrix;

struct peer_eigen {
    explicit peer_eigen(const sl_csc &C)
        : A(Eigen::Map<const matrix>(C.n_rows, C.n_cols, C.p[C.n_cols], C.p, C.i, C.x)) {
    }
    matrix A;
    Eigen::SimplicialLDLT<matrix, Eigen::Lower, Eigen::NaturalOrdering<int>> solver;
};

static void must(const peer_eigen *peer, const char *doing) {
    if (peer->solver.info() != Eigen::Success) {
        std::fprintf(stderr, "bench: Eigen failed: %s\n", doing);
        std::exit(2);
    }
}

extern "C" {

peer_eigen *peer_eigen_create(const sl_csc *C) {
    peer_eigen *peer = new peer_eigen(*C);
    peer_eigen_analyse(peer);
    return peer;
}

void peer_eigen_free(peer_eigen *peer) {
    delete peer;
}

void peer_eigen_analyse(peer_eigen *peer) {
    peer->solver.analyzePattern(peer->A);
}

void peer_eigen_factor(peer_eigen *peer) {
    peer->solver.factorize(peer->A);
    must(peer, "factorization");
}

void peer_eigen_solve(peer_eigen *peer, double *X, const double *B, sl_int nrhs) {
    Eigen::Index n = peer->A.rows();
    Eigen::Map<const Eigen::MatrixXd> b(B, n, nrhs);
    Eigen::Map<Eigen::MatrixXd> x(X, n, nrhs);
    x = peer->solver.solve(b);
}
}

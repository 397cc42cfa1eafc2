/* peers_eigen.cpp: Eigen's simplicial LDL' in a given permutation and with AMD */
#include "peers.h"

#if defined(__GNUC__) && !defined(__clang__)
/* gcc 12: its own _mm512_undefined_pd, in complex packets */
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#pragma GCC diagnostic ignored "-Wuninitialized"
#endif

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <complex>
#include <cstdio>
#include <cstdlib>
#include <memory>

typedef Eigen::SparseMatrix<double> matrix;

struct peer_eigen {
    explicit peer_eigen(const sl_csc &C)
        : A(Eigen::Map<const matrix>(C.n_rows, C.n_cols, C.p[C.n_cols], C.p, C.i, C.x)) {
    }
    matrix A;
    Eigen::SimplicialLDLT<matrix, Eigen::Lower, Eigen::NaturalOrdering<int>> solver;
};

/* Makes the column counts visible, which are known after the analysis. */
struct amd_solver : Eigen::SimplicialLDLT<matrix, Eigen::Lower> {
    double entries(int power) const {
        const int *p = m_matrix.outerIndexPtr();
        double sum = 0;
        for (Eigen::Index j = 0; j < m_matrix.cols(); j++) {
            const double count = p[j + 1] - p[j] + 1; /* the diagonal is stored elsewhere */
            sum += power == 2 ? count * count : count;
        }
        return sum;
    }
};

struct peer_eigen_amd {
    explicit peer_eigen_amd(const sl_csc &C)
        : A(Eigen::Map<const matrix>(C.n_rows, C.n_cols, C.p[C.n_cols], C.p, C.i, C.x)) {
    }
    matrix A;
    std::unique_ptr<amd_solver> solver;
};

struct peer_eigen_complex {
    typedef std::complex<double> number;
    typedef Eigen::SparseMatrix<number> sparse;
    typedef Eigen::Matrix<number, Eigen::Dynamic, 1> vector;
    explicit peer_eigen_complex(const sl_hermitian &H)
        : A(Eigen::Map<const sparse>(H.n, H.n, H.p[H.n], H.p, H.i,
                                     reinterpret_cast<const number *>(H.x))) {
    }
    sparse A;
    Eigen::SimplicialLDLT<sparse, Eigen::Lower> solver;
};

template <typename solver_type> static void must(const solver_type &solver, const char *doing) {
    if (solver.info() != Eigen::Success) {
        std::fprintf(stderr, "bench: Eigen failed: %s\n", doing);
        std::exit(2);
    }
}

extern "C" {

peer_eigen *peer_eigen_create(const sl_csc *C) {
    peer_eigen *peer = new peer_eigen(*C);
    peer_eigen_analyze(peer);
    return peer;
}

void peer_eigen_free(peer_eigen *peer) {
    delete peer;
}

void peer_eigen_analyze(peer_eigen *peer) {
    peer->solver.analyzePattern(peer->A);
}

void peer_eigen_factor(peer_eigen *peer) {
    peer->solver.factorize(peer->A);
    must(peer->solver, "factorization");
}

void peer_eigen_solve(peer_eigen *peer, double *X, const double *B, sl_int nrhs) {
    Eigen::Index n = peer->A.rows();
    Eigen::Map<const Eigen::MatrixXd> b(B, n, nrhs);
    Eigen::Map<Eigen::MatrixXd> x(X, n, nrhs);
    x = peer->solver.solve(b);
}

peer_eigen_amd *peer_eigen_amd_create(const sl_csc *A) {
    return new peer_eigen_amd(*A);
}

void peer_eigen_amd_free(peer_eigen_amd *peer) {
    delete peer;
}

double peer_eigen_amd_analyze(peer_eigen_amd *peer) {
    peer->solver.reset(new amd_solver);
    peer->solver->analyzePattern(peer->A);
    return peer->solver->entries(2);
}

void peer_eigen_amd_compute(peer_eigen_amd *peer) {
    peer->solver.reset(new amd_solver);
    peer->solver->compute(peer->A);
    must(*peer->solver, "compute");
}

void peer_eigen_amd_factor(peer_eigen_amd *peer) {
    peer->solver->factorize(peer->A);
    must(*peer->solver, "factorization with AMD");
}

void peer_eigen_amd_solve(peer_eigen_amd *peer, double *X, const double *B, sl_int nrhs) {
    Eigen::Index n = peer->A.rows();
    Eigen::Map<const Eigen::MatrixXd> b(B, n, nrhs);
    Eigen::Map<Eigen::MatrixXd> x(X, n, nrhs);
    x = peer->solver->solve(b);
}

double peer_eigen_amd_nnz(const peer_eigen_amd *peer) {
    return peer->solver->entries(1);
}

peer_eigen_complex *peer_eigen_complex_create(const sl_hermitian *H) {
    peer_eigen_complex *peer = new peer_eigen_complex(*H);
    peer->solver.compute(peer->A);
    must(peer->solver, "complex compute");
    return peer;
}

void peer_eigen_complex_free(peer_eigen_complex *peer) {
    delete peer;
}

void peer_eigen_complex_factor(peer_eigen_complex *peer) {
    peer->solver.factorize(peer->A);
    must(peer->solver, "complex factorization");
}

void peer_eigen_complex_solve(peer_eigen_complex *peer, double *x, const double *b) {
    typedef peer_eigen_complex::vector vector;
    typedef peer_eigen_complex::number number;
    const Eigen::Index n = peer->A.rows();
    Eigen::Map<const vector> rhs(reinterpret_cast<const number *>(b), n);
    Eigen::Map<vector> result(reinterpret_cast<number *>(x), n);
    result = peer->solver.solve(rhs);
}
}

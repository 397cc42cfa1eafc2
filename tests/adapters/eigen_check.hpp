/* eigen_check.hpp: matrices and comparisons of the tests of sparse_local_eigen.hpp */
#ifndef SL_TESTS_ADAPTERS_EIGEN_CHECK_HPP
#define SL_TESTS_ADAPTERS_EIGEN_CHECK_HPP

#include "tools/adapters/sparse_local_eigen.hpp"

#include <Eigen/Dense>

#include "check.hpp"

namespace check {

typedef Eigen::SparseMatrix<double> Sparse;
typedef Eigen::VectorXd Vector;
typedef Eigen::MatrixXd Dense;

/* The lower triangle of a grid with side x side vertices. */
inline Sparse grid_matrix(int side, double shift = 0.1) {
    const Grid grid(side, shift);
    return Eigen::Map<const Sparse>(grid.n, grid.n, grid.p[std::size_t(grid.n)], grid.p.data(),
                                    grid.i.data(), grid.x.data());
}

/* The grid as a matrix of Eigen with the triangles of UpLo. */
template <class M, int UpLo> M grid_matrix(int side, double shift = 0.1) {
    Sparse full = grid_matrix(side, shift).selfadjointView<Eigen::Lower>();
    Sparse out = full;
    if (UpLo == Eigen::Lower) out = full.triangularView<Eigen::Lower>();
    if (UpLo == Eigen::Upper) out = full.triangularView<Eigen::Upper>();
    return M(out.template cast<typename M::Scalar>());
}

inline Vector some_vector(Eigen::Index n) {
    Vector b(n);
    for (Eigen::Index k = 0; k < n; k++) b[k] = std::sin(1.0 + double(k));
    return b;
}

inline Dense some_matrix(Eigen::Index n, Eigen::Index columns) {
    Dense B(n, columns);
    for (Eigen::Index c = 0; c < columns; c++) B.col(c) = some_vector(n) * double(c + 1);
    return B;
}

template <class A, class B> bool close(const A &a, const B &b, double tolerance = 1e-12) {
    return a.rows() == b.rows() && a.cols() == b.cols() &&
           (a.size() == 0 || double((a - b).cwiseAbs().maxCoeff()) <= tolerance);
}

template <class A> bool all_nan(const A &a) {
    return a.size() > 0 && (a.array() != a.array()).all();
}

} // namespace check

#endif

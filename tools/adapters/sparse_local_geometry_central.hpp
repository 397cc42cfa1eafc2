/* sparse_local_geometry_central.hpp: PositiveDefiniteSolver of geometry-central over this library
 *
 * geometry-central declares the class in numerical/linear_solvers.h. This one takes its place for
 * double, float and std::complex of these: the same checks of the matrix and the right-hand side,
 * which GC_NLINALG_DEBUG leaves out, and the same types of exceptions. Base is
 * geometrycentral::LinearSolver<T>.
 *
 * Or the edit of two lines in src/numerical/positive_definite_solvers.cpp that
 * bench/world/recipes/geometry-central.patch has: there the checks are geometry-central's own.
 */
#ifndef SPARSE_LOCAL_GEOMETRY_CENTRAL_HPP
#define SPARSE_LOCAL_GEOMETRY_CENTRAL_HPP

#include "sparse_local_eigen.hpp"

#include <stdexcept>

namespace sl {

template <class T, class Base> class PositiveDefiniteSolver : public Base {
  public:
    typedef Eigen::SparseMatrix<T> Matrix;
    typedef Eigen::Matrix<T, Eigen::Dynamic, 1> Vector;
    explicit PositiveDefiniteSolver(Matrix &A) : Base(A) {
        check(A);
        A.makeCompressed();
        solver_.compute(A);
        if (solver_.info() != Eigen::Success) fail();
    }
    void solve(Vector &x, const Vector &b) override {
        if (b.rows() != solver_.rows()) {
            throw std::logic_error("sparse_local: the right-hand side has " +
                                   std::to_string(b.rows()) + " rows, the matrix " +
                                   std::to_string(solver_.rows()));
        }
#ifndef GC_NLINALG_DEBUG
        for (Eigen::Index i = 0; i < b.rows(); i++) {
            if (is_finite(b[i])) continue;
            throw std::logic_error("sparse_local: the right-hand side is not finite in row " +
                                   std::to_string(i));
        }
#endif
        x = solver_.solve(b);
        if (solver_.info() != Eigen::Success) fail();
    }
    Vector solve(const Vector &b) override {
        Vector x;
        solve(x, b);
        return x;
    }

  private:
    static bool is_finite(const T &value) {
        return std::isfinite(std::abs(value));
    }
    void fail() const {
        throw std::invalid_argument("sparse_local: " + solver_.lastErrorMessage());
    }
    static std::string at(const typename Matrix::InnerIterator &entry) {
        return " at [" + std::to_string(entry.row()) + "," + std::to_string(entry.col()) + "]";
    }
    /* Square, finite, and Hermitian up to 1e-8 of the mean magnitude. */
    static void check(const Matrix &A) {
        if (A.rows() != A.cols()) throw std::logic_error("sparse_local: the matrix is not square");
#ifndef GC_NLINALG_DEBUG
        double sum = 0;
        for (Eigen::Index j = 0; j < A.outerSize(); j++) {
            for (typename Matrix::InnerIterator entry(A, j); entry; ++entry) {
                sum += double(std::abs(entry.value()));
                if (is_finite(entry.value())) continue;
                throw std::logic_error("sparse_local: an entry is not finite" + at(entry));
            }
        }
        const Matrix adjoint = A.adjoint(), difference = A - adjoint;
        for (Eigen::Index j = 0; j < A.outerSize(); j++) {
            for (typename Matrix::InnerIterator entry(difference, j); entry; ++entry) {
                if (double(std::abs(entry.value())) <= 1e-8 * sum / double(A.nonZeros())) continue;
                throw std::logic_error("sparse_local: the matrix is not Hermitian" + at(entry));
            }
        }
#endif
    }
    SimplicialLDLT<Matrix> solver_;
};

} // namespace sl

#endif

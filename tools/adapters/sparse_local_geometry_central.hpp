/* sparse_local_geometry_central.hpp: PositiveDefiniteSolver of geometry-central over this library
 *
 * geometry-central declares the class in numerical/linear_solvers.h. This one takes its place for
 * double and float, but not for complex matrices. Base is geometrycentral::LinearSolver<T>.
 */
#ifndef SPARSE_LOCAL_GEOMETRY_CENTRAL_HPP
#define SPARSE_LOCAL_GEOMETRY_CENTRAL_HPP

#include "sparse_local_eigen.hpp"

#include <stdexcept>

namespace sl {

template <class T, class Base> class PositiveDefiniteSolver : public Base {
public:
    typedef Eigen::Matrix<T, Eigen::Dynamic, 1> Vector;
    explicit PositiveDefiniteSolver(Eigen::SparseMatrix<T> &A) : Base(A), solver_(A) {
        if (solver_.info() != Eigen::Success) throw std::runtime_error("sparse_local: no factor");
    }
    void solve(Vector &x, const Vector &b) override {
        x = solver_.solve(b);
    }
    Vector solve(const Vector &b) override {
        return solver_.solve(b);
    }

private:
    SimplicialLDLT<Eigen::SparseMatrix<T>> solver_;
};

} // namespace sl

#endif

/* libigl.cpp: what libigl solves by min_quad_with_fixed
 *
 *     program SQUARES [size]
 */
#include "meshes.hpp"
#include "report.h"

#include <igl/active_set.h>
#include <igl/arap.h>
#include <igl/cotmatrix.h>
#include <igl/harmonic.h>
#include <igl/heat_geodesics.h>
#include <igl/lscm.h>
#include <igl/massmatrix.h>
#include <igl/min_quad_with_fixed.h>

#include <cstdlib>

typedef Eigen::SparseMatrix<double> Matrix;

static void take(const world::Mesh &mesh, Eigen::MatrixXd &V, Eigen::MatrixXi &F) {
    V.resize(Eigen::Index(mesh.vertices.size()), 3);
    F.resize(Eigen::Index(mesh.faces.size()), 3);
    for (Eigen::Index i = 0; i < V.rows(); i++) {
        for (int k = 0; k < 3; k++) V(i, k) = mesh.vertices[std::size_t(i)][std::size_t(k)];
    }
    for (Eigen::Index i = 0; i < F.rows(); i++) {
        for (int k = 0; k < 3; k++) F(i, k) = mesh.faces[std::size_t(i)][std::size_t(k)];
    }
}

static void show(const char *feature, const Eigen::MatrixXd &x) {
    for (Eigen::Index k = 0; k < x.size(); k++) report(feature, x.data()[k]);
}

static Eigen::VectorXd distances(const Eigen::MatrixXd &V, const Eigen::MatrixXi &F) {
    igl::HeatGeodesicsData<double> data;
    Eigen::VectorXd x;
    igl::heat_geodesics_precompute(V, F, data);
    igl::heat_geodesics_solve(data, Eigen::VectorXi::Constant(1, 3), x);
    return x;
}

/* The quadratic energy with two values given, and the equations Aeq x = beq. */
static void minimum(const char *feature, const Matrix &A, const Matrix &Aeq, double beq,
                    bool is_definite) {
    const Eigen::Index n = A.rows();
    Eigen::VectorXi known(2);
    known << 0, int(n / 2);
    const Eigen::MatrixXd Y = (Eigen::MatrixXd(2, 2) << 1, 2, -1, 3).finished();
    const Eigen::VectorXd B = Eigen::VectorXd::LinSpaced(n, -1e-3, 2e-3);
    igl::min_quad_with_fixed_data<double> data;
    Eigen::MatrixXd x;
    igl::min_quad_with_fixed_precompute(A, known, Aeq, is_definite, data);
    igl::min_quad_with_fixed_solve(data, B, Y, Eigen::VectorXd::Constant(Aeq.rows(), beq), x);
    show(feature, x);
}

int main(int argc, char **argv) {
    const int squares = std::atoi(argv[1]);
    Eigen::MatrixXd V, x;
    Eigen::MatrixXi F;
    take(world::torus(squares), V, F);
    if (argc > 2) {
        const double begin = seconds();
        const Eigen::VectorXd d = distances(V, F);
        report_time(seconds() - begin);
        show("size", d);
        return 0;
    }
    show("heat_closed", distances(V, F));
    Matrix L, M;
    igl::cotmatrix(V, F, L);
    igl::massmatrix(V, F, igl::MASSMATRIX_TYPE_VORONOI, M);
    const Eigen::Index n = V.rows();
    Matrix none(0, n), mean(1, n), twice(2, n);
    for (int j = 0; j < n; j++) {
        mean.insert(0, j) = M.coeff(j, j);
        twice.insert(0, j) = M.coeff(j, j);
        twice.insert(1, j) = 2 * M.coeff(j, j);
    }
    minimum("fixed", -L, none, 0, true);
    minimum("equation", -L, mean, 0, true);
    minimum("dependent_equations", -L, twice, 0, true);
    minimum("indefinite", -L - 30 * M, none, 0, false);
    minimum("indefinite_equation", -L - 30 * M, mean, 0.5, false);

    take(world::sheet(squares), V, F);
    show("heat_open", distances(V, F));
    Eigen::VectorXi held(3);
    held << 0, squares, int(V.rows()) - 1;
    Eigen::MatrixXd at(3, 3);
    for (int k = 0; k < 3; k++) at.row(k) = V.row(held(k)) * (1 + 0.1 * k);
    igl::harmonic(V, F, held, at, 1, x);
    show("harmonic", x);
    igl::harmonic(V, F, held, at, 2, x);
    show("biharmonic", x);
    igl::ARAPData arap;
    arap.max_iter = 5;
    igl::arap_precomputation(V, F, 3, held, arap);
    x = V;
    igl::arap_solve(at, arap, x);
    show("arap", x);
    igl::lscm(V, F, held.head(2), Eigen::MatrixXd(at.topLeftCorner(2, 2)), x);
    show("lscm", x);
    igl::cotmatrix(V, F, L);
    igl::massmatrix(V, F, igl::MASSMATRIX_TYPE_VORONOI, M);
    igl::active_set_params params;
    params.max_iter = 20;
    const Eigen::VectorXd lower = Eigen::VectorXd::Constant(V.rows(), -0.01);
    Eigen::VectorXd y = Eigen::VectorXd::Zero(V.rows());
    igl::active_set(Matrix(M - L), Eigen::VectorXd(M * V.col(0)), Eigen::VectorXi(held.head(1)),
                    Eigen::VectorXd(Eigen::VectorXd::Zero(1)), Matrix(0, V.rows()),
                    Eigen::VectorXd(), Matrix(0, V.rows()), Eigen::VectorXd(), lower,
                    Eigen::VectorXd(-lower), params, y);
    show("active_set", y);
}

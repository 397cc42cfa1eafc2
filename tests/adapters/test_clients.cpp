/* test_clients.cpp: what libigl and geometry-central do with a solver, on ours and on Eigen's
 *
 * The functions take the solver as a template argument and contain what their namesakes in libigl
 * compute: min_quad_with_fixed, harmonic, heat_geodesics, arap. (Debian has no libigl.)
 */
#include "tools/adapters/sparse_local_eigen.hpp"
#include "tools/adapters/sparse_local_geometry_central.hpp"

#include <Eigen/Dense>
#include <Eigen/SVD>
#include <Eigen/SparseCholesky>

#include "check.hpp"

namespace {

typedef Eigen::SparseMatrix<double> Sparse;
typedef Eigen::VectorXd Vector;
typedef Eigen::MatrixXd Dense;
typedef std::vector<int> Rows;
typedef Eigen::Triplet<double> Triplet;
typedef sl::SimplicialLDLT<Sparse> Ours;
typedef Eigen::SimplicialLDLT<Sparse> Theirs;

// ---- a surface and its operators ----

/* A wavy square of side x side vertices, and its boundary. */
struct Mesh {
    explicit Mesh(int side) : V(side * side, 3), F(2 * (side - 1) * (side - 1), 3) {
        int f = 0;
        for (int v = 0; v < side * side; v++) {
            const int x = v % side, y = v / side;
            const double s = double(x) / (side - 1), t = double(y) / (side - 1);
            V.row(v) << s + 0.02 * std::sin(9 * t), t, 0.2 * std::sin(4 * s) * std::cos(3 * t);
            if (x == 0 || y == 0 || x == side - 1 || y == side - 1) boundary.push_back(v);
            if (x == side - 1 || y == side - 1) continue;
            F.row(f++) << v, v + 1, v + side;
            F.row(f++) << v + 1, v + side + 1, v + side;
        }
    }
    Eigen::Vector3d corner(Eigen::Index f, int k) const {
        return V.row(F(f, k % 3)).transpose();
    }
    /* Half of the cotangent of the angle at corner k. */
    double cotangent(Eigen::Index f, int k) const {
        const Eigen::Vector3d a = corner(f, k + 1) - corner(f, k);
        const Eigen::Vector3d b = corner(f, k + 2) - corner(f, k);
        return 0.5 * a.dot(b) / a.cross(b).norm();
    }
    double area(Eigen::Index f) const {
        return 0.5 * (corner(f, 1) - corner(f, 0)).cross(corner(f, 2) - corner(f, 0)).norm();
    }
    Dense V;
    Eigen::MatrixXi F;
    Rows boundary;
};

/* The cotangent Laplacian, positive semidefinite, both triangles. */
Sparse cotangent_matrix(const Mesh &mesh) {
    std::vector<Triplet> t;
    for (Eigen::Index f = 0; f < mesh.F.rows(); f++) {
        for (int k = 0; k < 3; k++) {
            const int i = mesh.F(f, (k + 1) % 3), j = mesh.F(f, (k + 2) % 3);
            const double w = mesh.cotangent(f, k);
            t.push_back(Triplet(i, i, w));
            t.push_back(Triplet(j, j, w));
            t.push_back(Triplet(i, j, -w));
            t.push_back(Triplet(j, i, -w));
        }
    }
    Sparse L(mesh.V.rows(), mesh.V.rows());
    L.setFromTriplets(t.begin(), t.end());
    return L;
}

Vector vertex_areas(const Mesh &mesh) {
    Vector m = Vector::Zero(mesh.V.rows());
    for (Eigen::Index f = 0; f < mesh.F.rows(); f++) {
        for (int k = 0; k < 3; k++) m[mesh.F(f, k)] += mesh.area(f) / 3;
    }
    return m;
}

// ---- min_quad_with_fixed ----

/* Minimizes x' A x / 2 + x' b with x(known) = y: A is factored once without the known rows. */
template <class Solver> class MinQuadWithFixed {
public:
    MinQuadWithFixed(const Sparse &A, const Rows &known) : A_(A), known_(known) {
        std::vector<int> number(std::size_t(A.rows()), 0);
        for (int row : known) number[std::size_t(row)] = -1;
        for (int row = 0; row < A.rows(); row++) {
            if (number[std::size_t(row)] == -1) continue;
            number[std::size_t(row)] = int(unknown_.size());
            unknown_.push_back(row);
        }
        std::vector<Triplet> t;
        for (int j = 0; j < A.outerSize(); j++) {
            for (Sparse::InnerIterator a(A, j); a; ++a) {
                const int r = number[std::size_t(a.row())], c = number[std::size_t(a.col())];
                if (r >= 0 && c >= 0) t.push_back(Triplet(r, c, a.value()));
            }
        }
        Auu_.resize(Eigen::Index(unknown_.size()), Eigen::Index(unknown_.size()));
        Auu_.setFromTriplets(t.begin(), t.end());
        solver_.compute(Auu_);
    }
    bool solve(const Dense &b, const Dense &y, Dense &x) const {
        x = Dense::Zero(A_.rows(), y.cols());
        for (std::size_t k = 0; k < known_.size(); k++) x.row(known_[k]) = y.row(Eigen::Index(k));
        const Dense full = -(A_ * x + b);
        Dense right(Eigen::Index(unknown_.size()), y.cols());
        for (std::size_t k = 0; k < unknown_.size(); k++) {
            right.row(Eigen::Index(k)) = full.row(unknown_[k]);
        }
        const Dense part = solver_.solve(right);
        for (std::size_t k = 0; k < unknown_.size(); k++) {
            x.row(unknown_[k]) = part.row(Eigen::Index(k));
        }
        return solver_.info() == Eigen::Success;
    }
    const Solver &solver() const {
        return solver_;
    }
    const Sparse &system() const {
        return Auu_;
    }

private:
    Sparse A_, Auu_;
    Rows known_, unknown_;
    Solver solver_;
};

double relative(const Dense &a, const Dense &b) {
    return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}

/* ||b - A x|| / (||A|| ||x|| + ||b||) in the infinity norm. */
double backward_error(const Sparse &A, const Dense &x, const Dense &b) {
    const double size = (A.cwiseAbs() * Vector::Ones(A.cols())).maxCoeff();
    return (b - A * x).cwiseAbs().maxCoeff() /
           (size * x.cwiseAbs().maxCoeff() + b.cwiseAbs().maxCoeff());
}

void min_quad_with_fixed() {
    const Mesh mesh(30);
    const Sparse A = cotangent_matrix(mesh);
    const Rows known = {0, 17, 899};
    Dense y(3, 2), x, z, b = mesh.V.leftCols(2) * 0.01;
    y << 1, 0, -2, 5, 3, 1;
    CHECK((MinQuadWithFixed<Ours>(A, known).solve(b, y, x)));
    CHECK((MinQuadWithFixed<Theirs>(A, known).solve(b, y, z)));
    CHECK(relative(x, z) < 1e-11 && x(17, 1) == 5);
}

// ---- harmonic ----

/* The k-harmonic energy: L, L M^-1 L, L M^-1 L M^-1 L. */
Sparse harmonic_energy(const Mesh &mesh, int k) {
    const Sparse L = cotangent_matrix(mesh);
    const Vector inverse = vertex_areas(mesh).cwiseInverse();
    Sparse Q = L;
    for (int p = 1; p < k; p++) Q = Sparse(Q * (inverse.asDiagonal() * L));
    return 0.5 * (Q + Sparse(Q.transpose()));
}

void harmonic() {
    const Mesh mesh(30);
    Dense y(Eigen::Index(mesh.boundary.size()), 3);
    for (std::size_t k = 0; k < mesh.boundary.size(); k++) {
        y.row(Eigen::Index(k)) = mesh.V.row(mesh.boundary[k]);
    }
    for (int k = 1; k <= 3; k++) {
        const Sparse Q = harmonic_energy(mesh, k);
        const MinQuadWithFixed<Ours> ours(Q, mesh.boundary);
        const MinQuadWithFixed<Theirs> theirs(Q, mesh.boundary);
        const Dense zero = Dense::Zero(Q.rows(), 3);
        Dense x, z;
        CHECK(ours.solve(zero, y, x) && theirs.solve(zero, y, z));
        /* two solutions differ by what the condition allows */
        const double rcond = ours.solver().rcond(ours.system());
        CHECK(rcond > 0 && relative(x, z) < 1e-13 / rcond);
        CHECK(relative(x, z) < (k == 1 ? 1e-11 : k == 2 ? 1e-8 : 1e-4));
    }
}

/* On a finer and thinner mesh a triharmonic system has no correct digit left. The solver says so:
 * either it has no factor, or rcond is near epsilon; the backward error stays small, because x is
 * the exact solution of a system nearby. */
void triharmonic_says_what_to_expect() {
    Mesh mesh(60);
    mesh.V.col(1) *= 1e-3;
    const Sparse Q = harmonic_energy(mesh, 3);
    const MinQuadWithFixed<Ours> ours(Q, mesh.boundary);
    if (ours.solver().info() != Eigen::Success) {
        CHECK(ours.solver().status() == SL_ERR_PIVOT);
        return;
    }
    const double rcond = ours.solver().rcond(ours.system());
    CHECK(rcond < 1e-12);
    const Vector b = Vector::Ones(ours.system().rows());
    const Vector x = ours.solver().solve(b);
    CHECK(ours.solver().info() == Eigen::Success);
    CHECK(backward_error(ours.system(), x, b) < 1e-12);
}

// ---- heat geodesics ----

/* The distances from one vertex by the heat method: u = (M + t L)^-1 delta, X = -grad u / |grad u|,
 * L d = div X. */
template <class Solver, class Poisson>
bool heat_geodesics(const Mesh &mesh, int from, const Poisson &solve_poisson, Vector &d) {
    const Sparse L = cotangent_matrix(mesh);
    const Vector areas = vertex_areas(mesh);
    double edges = 0;
    for (Eigen::Index f = 0; f < mesh.F.rows(); f++) {
        for (int k = 0; k < 3; k++) edges += (mesh.corner(f, k + 1) - mesh.corner(f, k)).norm();
    }
    const double h = edges / double(3 * mesh.F.rows());
    Sparse M(L.rows(), L.rows());
    M.setIdentity();
    M = areas.asDiagonal() * M;
    Solver heat(Sparse(M + h * h * L));
    Vector delta = Vector::Zero(L.rows());
    delta[from] = 1;
    const Vector u = heat.solve(delta);
    if (heat.info() != Eigen::Success) return false;
    Vector divergence = Vector::Zero(L.rows());
    for (Eigen::Index f = 0; f < mesh.F.rows(); f++) {
        const Eigen::Vector3d normal =
            (mesh.corner(f, 1) - mesh.corner(f, 0)).cross(mesh.corner(f, 2) - mesh.corner(f, 0));
        Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
        for (int k = 0; k < 3; k++) {
            gradient += u[mesh.F(f, k)] *
                        normal.cross(mesh.corner(f, k + 2) - mesh.corner(f, k + 1)).eval();
        }
        const Eigen::Vector3d X = -gradient.normalized();
        for (int k = 0; k < 3; k++) {
            const Eigen::Vector3d e = mesh.corner(f, k + 1) - mesh.corner(f, k);
            const double w = mesh.cotangent(f, k + 2) * e.dot(X);
            divergence[mesh.F(f, k)] += w;
            divergence[mesh.F(f, (k + 1) % 3)] -= w;
        }
    }
    if (!solve_poisson(L, areas, Vector(-divergence), d)) return false;
    d = (d.array() - d[from]).matrix();
    if (d.sum() < 0) d = -d;
    return true;
}

void heat_distances() {
    const Mesh mesh(40);
    const int from = 820;
    /* the singular Poisson problem as it is, with a zero mean */
    const auto ours = [](const Sparse &L, const Vector &areas, const Vector &b, Vector &d) {
        Ours solver;
        solver.options().pivots = SL_PIVOTS_SKIP_NULL;
        solver.options().mass = areas.data();
        d = solver.compute(L).solve(b);
        return solver.info() == Eigen::Success && std::fabs(areas.dot(d)) < 1e-12;
    };
    /* one vertex fixed, as libigl does it */
    const auto theirs = [](const Sparse &L, const Vector &, const Vector &b, Vector &d) {
        Dense x;
        const MinQuadWithFixed<Theirs> fixed(L, {from});
        if (!fixed.solve(-b, Dense::Zero(1, 1), x)) return false;
        d = x.col(0);
        return true;
    };
    Vector d, e;
    CHECK(heat_geodesics<Ours>(mesh, from, ours, d));
    CHECK(heat_geodesics<Theirs>(mesh, from, theirs, e));
    CHECK(relative(d, e) < 1e-9 && e.maxCoeff() > 0.5 && e.maxCoeff() < 1.5);
}

// ---- as rigid as possible ----

/* A few iterations of a deformation with fixed vertices: rotations by SVD, positions by the solver,
 * which factors once. */
template <class Solver> bool arap(const Mesh &mesh, const Rows &fixed, const Dense &at, Dense &U) {
    const Sparse L = cotangent_matrix(mesh);
    const MinQuadWithFixed<Solver> solver(L, fixed);
    U = mesh.V;
    for (int iteration = 0; iteration < 6; iteration++) {
        std::vector<Eigen::Matrix3d> R(std::size_t(L.rows()), Eigen::Matrix3d::Zero());
        for (int j = 0; j < L.outerSize(); j++) {
            for (Sparse::InnerIterator w(L, j); w; ++w) {
                const Eigen::Index i = w.row();
                R[std::size_t(j)] -= w.value() * (mesh.V.row(j) - mesh.V.row(i)).transpose() *
                                     (U.row(j) - U.row(i));
            }
        }
        for (Eigen::Matrix3d &S : R) {
            const Eigen::JacobiSVD<Eigen::Matrix3d> svd(S, Eigen::ComputeFullU |
                                                               Eigen::ComputeFullV);
            Eigen::Matrix3d sign = Eigen::Matrix3d::Identity();
            sign(2, 2) = (svd.matrixV() * svd.matrixU().transpose()).determinant() < 0 ? -1 : 1;
            S = svd.matrixV() * sign * svd.matrixU().transpose();
        }
        Dense b = Dense::Zero(L.rows(), 3);
        for (int j = 0; j < L.outerSize(); j++) {
            for (Sparse::InnerIterator w(L, j); w; ++w) {
                const Eigen::Matrix3d both = R[std::size_t(j)] + R[std::size_t(w.row())];
                b.row(j) += 0.5 * w.value() * (mesh.V.row(j) - mesh.V.row(w.row())) *
                            both.transpose();
            }
        }
        if (!solver.solve(b, at, U)) return false;
    }
    return true;
}

void as_rigid_as_possible() {
    const Mesh mesh(20);
    Rows fixed;
    for (int v = 0; v < 20; v++) fixed.push_back(v);
    for (int v = 380; v < 400; v++) fixed.push_back(v);
    Dense at(40, 3), U, W;
    for (int k = 0; k < 40; k++) {
        at.row(k) = mesh.V.row(fixed[std::size_t(k)]);
        if (k >= 20) at(k, 2) += 0.3;
    }
    CHECK(arap<Ours>(mesh, fixed, at, U) && arap<Theirs>(mesh, fixed, at, W));
    CHECK(relative(U, W) < 1e-9 && relative(U, mesh.V) > 0.05);
}

// ---- geometry-central ----

/* The base class of geometry-central's solvers. */
template <class T> class LinearSolver {
public:
    typedef Eigen::Matrix<T, Eigen::Dynamic, 1> V;
    explicit LinearSolver(const Eigen::SparseMatrix<T> &A) : nRows(A.rows()), nCols(A.cols()) {
    }
    virtual ~LinearSolver() {
    }
    virtual void solve(V &x, const V &b) = 0;
    virtual V solve(const V &b) = 0;

protected:
    Eigen::Index nRows, nCols;
};

template <class T> bool positive_definite_solver_agrees(double tolerance) {
    const Mesh mesh(25);
    Sparse A = cotangent_matrix(mesh);
    for (int k = 0; k < A.rows(); k++) A.coeffRef(k, k) += 0.01;
    Eigen::SparseMatrix<T> B = A.cast<T>();
    const Eigen::Matrix<T, Eigen::Dynamic, 1> b = mesh.V.col(0).cast<T>();
    sl::PositiveDefiniteSolver<T, LinearSolver<T>> ours(B);
    LinearSolver<T> &base = ours;
    Eigen::Matrix<T, Eigen::Dynamic, 1> x;
    base.solve(x, b);
    const Vector z = Theirs(A).solve(mesh.V.col(0));
    return relative(x.template cast<double>(), z) < tolerance && base.solve(b) == x;
}

template <class Exception> bool refuses(Sparse A, const Vector &b) {
    try {
        Vector x;
        sl::PositiveDefiniteSolver<double, LinearSolver<double>>(A).solve(x, b);
    } catch (const Exception &) {
        return true;
    }
    return false;
}

void geometry_central() {
    CHECK(positive_definite_solver_agrees<double>(1e-11));
    CHECK(positive_definite_solver_agrees<float>(1e-3));
    const Sparse zero(2, 2);
    CHECK(refuses<std::invalid_argument>(zero, Vector::Ones(2)));
    /* what geometry-central's own class checks */
    Sparse A = cotangent_matrix(Mesh(5));
    for (int k = 0; k < A.rows(); k++) A.coeffRef(k, k) += 0.01;
    Vector b = Vector::Ones(25);
    CHECK(!refuses<std::logic_error>(A, b));
    CHECK(refuses<std::logic_error>(A, Vector::Ones(10)));
    CHECK(refuses<std::logic_error>(A, Vector::Ones(26)));
    b[3] = NAN;
    CHECK(refuses<std::logic_error>(A, b));
    CHECK(refuses<std::logic_error>(A.leftCols(24), Vector::Ones(25)));
    Sparse wrong = A;
    wrong.coeffRef(0, 1) += 1;
    CHECK(refuses<std::logic_error>(wrong, Vector::Ones(25)));
    wrong = A;
    wrong.coeffRef(7, 7) = INFINITY;
    CHECK(refuses<std::logic_error>(wrong, Vector::Ones(25)));
}

/* A connection Laplacian: the Laplacian whose weights have a phase. */
void geometry_central_complex() {
    typedef std::complex<double> Complex;
    typedef Eigen::SparseMatrix<Complex> Hermitian;
    const Sparse L = cotangent_matrix(Mesh(12));
    Hermitian A = L.cast<Complex>();
    for (int j = 0; j < A.outerSize(); j++) {
        for (Hermitian::InnerIterator a(A, j); a; ++a) {
            if (a.row() != a.col()) a.valueRef() *= std::polar(1.0, double(a.row() - a.col()));
            if (a.row() == a.col()) a.valueRef() += 0.01;
        }
    }
    const Eigen::VectorXcd b = Eigen::VectorXcd::Random(A.rows());
    sl::PositiveDefiniteSolver<Complex, LinearSolver<Complex>> ours(A);
    const Eigen::VectorXcd x = static_cast<LinearSolver<Complex> &>(ours).solve(b);
    CHECK((A * x - b).norm() < 1e-12 * b.norm());
}

} // namespace

int main() {
    return check::run({{"min_quad_with_fixed", min_quad_with_fixed},
                       {"harmonic", harmonic},
                       {"triharmonic_says_what_to_expect", triharmonic_says_what_to_expect},
                       {"heat_distances", heat_distances},
                       {"as_rigid_as_possible", as_rigid_as_possible},
                       {"geometry_central", geometry_central},
                       {"geometry_central_complex", geometry_central_complex}});
}

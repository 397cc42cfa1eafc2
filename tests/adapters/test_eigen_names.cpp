/* test_eigen_names.cpp: programs written for Eigen's classes, with ours in their place */
#include "eigen_check.hpp"

#include <sstream>

using check::Sparse;
typedef Eigen::SparseMatrix<std::complex<double>> Hermitian;

/* Classes, all members of which are compiled. */
template class sl::SimplicialLDLT<Sparse>;
template class sl::SimplicialLLT<Sparse, Eigen::Upper>;
template class sl::SimplicialCholesky<Hermitian>;
template class sl::BasicSolver<sl::SimplicialLDLT<Eigen::SparseMatrix<float>>>;
template class sl::BasicSolver<sl::SimplicialLLT<Eigen::SparseMatrix<std::complex<float>>>>;

namespace {

using check::all_nan;
using check::close;
using check::Dense;
using check::grid_matrix;
using check::some_vector;
using check::Vector;
typedef std::complex<double> Complex;
typedef Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> Permutation;

/* A grid with edges that turn, both triangles; Hermitian. */
Hermitian turning_matrix(int side, double shift = 0.1) {
    const Sparse full = grid_matrix(side, shift).selfadjointView<Eigen::Lower>();
    Hermitian A = full.cast<Complex>();
    for (int j = 0; j < A.outerSize(); j++) {
        for (Hermitian::InnerIterator a(A, j); a; ++a) {
            const double angle = 0.3 * double(a.row() - a.col());
            if (a.row() != a.col()) a.valueRef() *= std::polar(1.0, angle);
        }
    }
    return A;
}

Eigen::VectorXcd some_complex(Eigen::Index n) {
    return some_vector(n).cast<Complex>() + Complex(0, 1) * some_vector(2 * n).tail(n);
}

template <class Solver> void views_of(const Sparse &A, bool &is_right) {
    Solver ours(A);
    const Sparse L = ours.matrixL(), U = ours.matrixU();
    const Vector b = some_vector(A.rows());
    Vector x = b;
    ours.matrixL().solveInPlace(x);
    is_right = close(L * x, b) && close(Vector(ours.matrixL() * x), b) &&
               close(U * Vector(ours.matrixU().solve(b)), b) &&
               close(Dense(U), Dense(L.transpose()), 0);
    const Sparse &first = ours.matrixL().nestedExpression();
    const Sparse &second = ours.matrixL().nestedExpression();
    is_right = is_right && &first == &second; /* L is computed once, and kept */
}

void triangular_views() {
    bool is_right = false;
    views_of<sl::SimplicialLDLT<Sparse>>(grid_matrix(9), is_right);
    CHECK(is_right);
    views_of<sl::SimplicialLLT<Sparse>>(grid_matrix(9), is_right);
    CHECK(is_right);
    sl::SimplicialLDLT<Sparse> ours(grid_matrix(3));
    CHECK(ours.matrixL().nestedExpression().nonZeros() > 0);
    CHECK(Dense(ours.matrixL().nestedExpression())(0, 0) == 0); /* as Eigen's */
    /* other numbers, other L */
    const double before = Sparse(ours.matrixL()).norm();
    ours.factorize(grid_matrix(3, 2.0));
    CHECK(Sparse(ours.matrixL()).norm() < before);
    sl::SimplicialLDLT<Sparse> diagonal(Sparse(Dense(Vector::Ones(3).asDiagonal()).sparseView()));
    CHECK(Sparse(diagonal.matrixL()).rows() == 3);
}

void mode_of_simplicial_cholesky() {
    const Sparse A = grid_matrix(6);
    const Vector b = some_vector(36), x = Eigen::SimplicialLDLT<Sparse>(A).solve(b);
    sl::SimplicialCholesky<Sparse> ours(A);
    CHECK(close(Vector(ours.solve(b)), x));
    const Eigen::Index before = ours.rawMatrix().nonZeros();
    ours.setMode(Eigen::SimplicialCholeskyLLT);
    CHECK(all_nan(Vector(ours.solve(b))));
    ours.setMode(Eigen::SimplicialCholeskyLLT).compute(A);
    CHECK(close(Vector(ours.solve(b)), x) && ours.rawMatrix().nonZeros() == before + 36);
    Sparse negative = A;
    negative.coeffRef(6, 6) = -50;
    CHECK(ours.compute(negative).info() == Eigen::NumericalIssue);
    CHECK(ours.lastErrorMessage().find("SimplicialLDLT") != std::string::npos);
    ours.setMode(Eigen::SimplicialCholeskyLDLT).compute(negative);
    CHECK(ours.info() == Eigen::Success && ours.lastErrorMessage().empty());
    std::stringstream text;
    ours.dumpMemory(text);
    CHECK(text.str().find("TOTAL") != std::string::npos);
}

void names_and_types() {
    typedef sl::SimplicialLLT<Sparse> Solver;
    const Sparse A = grid_matrix(4);
    Solver ours(A);
    const Permutation &P = ours.permutationP();
    CHECK(&P == &ours.permutationP());
    Solver::MatrixL L = ours.matrixL();
    Solver::MatrixU U = ours.matrixU();
    Solver::VectorType b = some_vector(16);
    Solver::CholMatrixType copy = L;
    const Vector y = L.solve(P * b), x = ours.permutationPinv() * Vector(U.solve(y));
    CHECK(copy.rows() == 16 && close(x, Vector(ours.solve(b))));
    CHECK(ours.options().purpose == SL_PURPOSE_ONE_FACTOR);
    CHECK(sl::LocalLLT<Sparse>(A).options().purpose == SL_PURPOSE_MANY_SOLVES);
    sl::LocalLDLT<Sparse> local(A);
    CHECK(local.options().purpose == SL_PURPOSE_MANY_SOLVES && close(Vector(local.solve(b)), x));
    typedef Eigen::SparseMatrix<float> Single;
    const Single A_single = A.cast<float>();
    const sl::SimplicialLDLT<Single> single(A_single);
    const Eigen::VectorXf D = single.vectorD();
    const Single L_single = single.matrixL();
    const Dense full = Sparse(A.selfadjointView<Eigen::Lower>());
    const Dense product = Dense(L_single.cast<double>()) * D.cast<double>().asDiagonal() *
                          Dense(L_single.cast<double>()).transpose();
    CHECK(close(product, Dense(single.permutationP() * full * single.permutationPinv()), 1e-5));
}

// ---- orders of the caller ----

Permutation reversed(int n) {
    Permutation order(n);
    for (int k = 0; k < n; k++)
        order.indices()[k] = n - 1 - k;
    return order;
}

struct ReversedOrdering {
    template <class M> void operator()(const M &A, Permutation &order) const {
        order = reversed(int(A.rows()));
    }
};
struct EmptyOrdering {
    template <class M> void operator()(const M &, Permutation &order) const {
        order.resize(0);
    }
};

/* A class that derives from Eigen's and prescribes its order, as g2o's does. */
template <class M> class Prescribed : public sl::SimplicialLLT<M, Eigen::Upper> {
  public:
    void analyze_with(M &A, const Permutation &order) {
        this->m_Pinv = order;
        this->m_P = order.inverse();
        M permuted(A.rows(), A.rows());
        permuted.template selfadjointView<Eigen::Upper>() =
            A.template selfadjointView<Eigen::Upper>().twistedBy(this->m_P);
        this->analyzePattern_preordered(permuted, false);
    }
};

void orders_of_the_caller() {
    const Sparse A = grid_matrix(4);
    const Vector b = some_vector(16), x = sl::SimplicialLLT<Sparse>(A).solve(b);
    /* a path keeps its order up to equivalence: its last pivot is the row that was given last */
    sl::SimplicialLDLT<Sparse> given;
    given.options().relaxation = SL_RELAXATION_NONE;
    given.analyzePattern(A, reversed(16)).factorize(A);
    CHECK(given.info() == Eigen::Success && given.permutationPinv().indices()[15] == 0);
    CHECK(close(Vector(given.solve(b)), x));
    CHECK(given.analyzePattern(A, reversed(15)).info() == Eigen::InvalidInput);
    CHECK(given.analyzePattern(A).info() == Eigen::Success);
    sl::SimplicialLDLT<Sparse, Eigen::Lower, ReversedOrdering> by_class(A);
    CHECK(by_class.permutationPinv().indices()[15] == 0 && close(Vector(by_class.solve(b)), x));
    sl::SimplicialLDLT<Sparse, Eigen::Lower, EmptyOrdering> natural(A);
    CHECK(natural.permutationPinv().indices()[15] == 15);
    CHECK(natural.compute(Sparse(2, 3)).info() == Eigen::InvalidInput);
    Prescribed<Sparse> prescribed;
    Sparse upper = A.transpose();
    prescribed.analyze_with(upper, reversed(16));
    CHECK(prescribed.info() == Eigen::Success);
    prescribed.factorize(upper);
    CHECK(prescribed.permutationPinv().indices()[15] == 0 && close(Vector(prescribed.solve(b)), x));
    CHECK(prescribed.analyses() == 1);
}

// ---- indefinite and singular matrices ----

/* [Q A'; A 0] over a grid, with or without stored zeros on the diagonal. */
Sparse kkt_matrix(bool has_zeros) {
    const Sparse Q = grid_matrix(6);
    std::vector<Eigen::Triplet<double>> t;
    for (int j = 0; j < 36; j++) {
        for (Sparse::InnerIterator q(Q, j); q; ++q)
            t.emplace_back(q.row(), q.col(), q.value());
    }
    for (int k = 0; k < 3; k++) {
        t.emplace_back(36 + k, 2 * k, 1.0);
        t.emplace_back(36 + k, 35 - k, -1.0);
        if (has_zeros) t.emplace_back(36 + k, 36 + k, 0.0);
    }
    Sparse K(39, 39);
    K.setFromTriplets(t.begin(), t.end());
    return K;
}

void equality_constraints() {
    const Vector b = some_vector(39);
    for (int has_zeros = 0; has_zeros < 2; has_zeros++) {
        const Sparse K = kkt_matrix(has_zeros != 0);
        const Dense full = Sparse(K.selfadjointView<Eigen::Lower>());
        const Vector x = full.partialPivLu().solve(b);
        sl::SimplicialLDLT<Sparse> ours(K);
        CHECK(ours.info() == Eigen::Success && close(Vector(ours.solve(b)), x, 1e-10));
        /* other values keep the pivots */
        const int analyses = ours.analyses();
        ours.factorize(2.0 * K);
        CHECK(ours.analyses() == analyses && close(Vector(ours.solve(b)), 0.5 * x, 1e-10));
        /* another pattern begins without them */
        CHECK(ours.compute(grid_matrix(4)).stats().symbolic.pairs == 0);
        CHECK(sl::SimplicialLLT<Sparse>(K).info() == Eigen::NumericalIssue);
    }
    /* singular and not semidefinite: as before the attempts */
    Sparse K = kkt_matrix(true);
    for (Sparse::InnerIterator q(K, 0); q; ++q)
        q.valueRef() = 0;
    sl::SimplicialLDLT<Sparse> ours(K);
    CHECK(ours.info() == Eigen::NumericalIssue && ours.analyses() == 1);
    CHECK(!ours.lastErrorMessage().empty());
    CHECK(ours.permutationP().size() == 39 && all_nan(Vector(ours.solve(b))));
}

/* Two grids without boundary conditions, as meshes of two parts have: Eigen's class solves it up to
 * constants, since rounding leaves the last pivots at 1e-16. */
template <class Solver> void null_pivots_are_skipped() {
    const Sparse part = grid_matrix(5, 0.0);
    std::vector<Eigen::Triplet<double>> t;
    for (int j = 0; j < 25; j++) {
        for (Sparse::InnerIterator q(part, j); q; ++q) {
            t.emplace_back(q.row(), j, q.value());
            t.emplace_back(25 + q.row(), 25 + j, 3.0 * q.value());
        }
    }
    Sparse A(50, 50);
    A.setFromTriplets(t.begin(), t.end());
    Vector b = some_vector(50);
    b.head(25).array() -= b.head(25).mean();
    b.tail(25).array() -= b.tail(25).mean();
    Solver ours(A);
    CHECK(ours.info() == Eigen::Success && ours.stats().factor.null == 2);
    CHECK((ours.vectorD().array() == 0).count() == 2 && ours.analyses() == 1);
    CHECK(ours.determinant() == 0);
    const Vector x = ours.solve(b);
    const Dense full = Sparse(A.template selfadjointView<Eigen::Lower>());
    CHECK(ours.info() == Eigen::Success && close(full * x, b, 1e-12));
    const auto is_null = [](const Vector &v) { return (v.array().abs() < 1e-300).count(); };
    CHECK(is_null(x.head(25)) == 1 && is_null(x.tail(25)) == 1);
    /* a b that no x solves */
    b[3] += 1;
    CHECK(all_nan(Vector(ours.solve(b))) && ours.info() == Eigen::NumericalIssue);
    CHECK(ours.lastErrorMessage().find("setZeroMean") != std::string::npos);
    /* another matrix of the pattern is judged anew */
    const Sparse shifted = grid_matrix(5);
    CHECK(ours.compute(shifted).info() == Eigen::Success && ours.stats().factor.null == 0);
    CHECK(ours.compute(A).info() == Eigen::Success && ours.stats().factor.null == 2);
    CHECK(ours.setNullPivots(false).compute(A).info() == Eigen::NumericalIssue);
    CHECK(ours.lastErrorMessage().find("setNullPivots") != std::string::npos);
}

/* Bars between the nodes of a grid whose places are random: a plane body that nothing holds. */
Sparse free_truss(int side, unsigned seed) {
    const auto place = [&](int node, int axis) {
        const double turn = std::sin(double(seed) + 7.0 * node + 3.0 * axis);
        return double(axis ? node / side : node % side) + 0.2 * turn;
    };
    std::vector<Eigen::Triplet<double>> t;
    const auto bar = [&](int a, int b) {
        const double x = place(b, 0) - place(a, 0), y = place(b, 1) - place(a, 1);
        const double cubed = std::pow(x * x + y * y, 1.5), d[2] = {x, y};
        for (int i = 0; i < 4; i++) {
            for (int j = 0; j < 4; j++) {
                const double k = d[i % 2] * d[j % 2] / cubed * (i / 2 == j / 2 ? 1 : -1);
                t.emplace_back(2 * (i < 2 ? a : b) + i % 2, 2 * (j < 2 ? a : b) + j % 2, k);
            }
        }
    };
    for (int node = 0; node < side * side; node++) {
        const bool is_left = (node + 1) % side != 0, is_low = node + side < side * side;
        if (is_left) bar(node, node + 1);
        if (is_low) bar(node, node + side);
        if (is_left && is_low) bar(node, node + side + 1);
        if (is_left && is_low) bar(node + 1, node + side);
    }
    Sparse K(2 * side * side, 2 * side * side);
    K.setFromTriplets(t.begin(), t.end());
    return K;
}

/* The lowest eigenvalues of a free body by inverse iteration at shift 0, as programs do with
 * Eigen's class: rounding errors in the last pivots stand for the shift. */
void free_bodies() {
    int done = 0;
    for (unsigned seed = 0; seed < 6; seed++) {
        const Sparse K = free_truss(6, seed);
        const Eigen::SelfAdjointEigenSolver<Dense> dense{Dense(K)};
        sl::SimplicialLDLT<Sparse> ours;
        /* by default the first step fails: b has no solution */
        CHECK(ours.compute(K).info() == Eigen::Success && ours.stats().factor.null > 0);
        CHECK(all_nan(Vector(ours.solve(some_vector(72)))));
        ours.options().null_tolerance = -1;
        if (ours.setNullPivots(false).setPivoted(false).compute(K).info() != Eigen::Success)
            continue; /* a pivot is exactly 0 */
        Dense X = Dense::Identity(72, 8);
        for (int step = 0; step < 60; step++) {
            const Dense Y = ours.solve(X);
            CHECK(ours.info() == Eigen::Success);
            X = Eigen::HouseholderQR<Dense>(Y).householderQ() * Dense::Identity(72, 8);
        }
        const Dense small = X.transpose() * K * X;
        const Eigen::SelfAdjointEigenSolver<Dense> found{small};
        const Vector ours_six = found.eigenvalues().head(6), six = dense.eigenvalues().head(6);
        CHECK(close(ours_six, six, 1e-8));
        done++;
    }
    CHECK(done >= 3);
}

/* Our own names refuse what is singular, and LLT what is not positive. */
void own_names_are_strict() {
    const Sparse A = grid_matrix(5, 0.0);
    CHECK(sl::LocalLDLT<Sparse>(A).status() == SL_ERR_PIVOT);
    CHECK(sl::LocalLLT<Sparse>(A).status() == SL_ERR_PIVOT);
    CHECK(sl::SimplicialLLT<Sparse>(Sparse(-A)).status() == SL_ERR_PIVOT);
    CHECK(sl::SimplicialLDLT<Sparse>(Sparse(-A)).info() == Eigen::Success);
    const Sparse both = A.selfadjointView<Eigen::Lower>();
    const sl::SimplicialLDLT<Hermitian> hermitian(both.cast<Complex>());
    Eigen::VectorXcd c = some_complex(25);
    c.array() -= c.mean();
    const Eigen::VectorXcd z = hermitian.solve(c);
    CHECK(hermitian.info() == Eigen::Success && close(both.cast<Complex>() * z, c, 1e-11));
}

/* Clients count the signs of vectorD(): with 2x2 pivots it has the eigenvalues of the blocks. */
void inertia_of_pivots() {
    const Sparse K = kkt_matrix(true);
    const Dense full = Sparse(K.selfadjointView<Eigen::Lower>());
    sl::SimplicialLDLT<Sparse> ours;
    ours.setPivoted().compute(K);
    CHECK(ours.info() == Eigen::Success && ours.stats().symbolic.pairs > 0);
    const Vector d = ours.vectorD();
    CHECK((d.array() < 0).count() == 3 && (d.array() > 0).count() == 36);
    CHECK(std::fabs(d.prod() / full.determinant() - 1) < 1e-10);
    sl::SimplicialLDLT<Hermitian> hermitian;
    const Sparse both = K.selfadjointView<Eigen::Lower>();
    hermitian.setPivoted().compute(both.cast<Complex>());
    CHECK(hermitian.info() == Eigen::Success && hermitian.vectorD().size() == 39);
    CHECK((hermitian.vectorD().real().array() < 0).count() == 3);
}

/* Every failure has a sentence, of the last call and not of an earlier one. */
void errors_have_a_sentence() {
    const auto has = [](const std::string &text, const char *part) {
        return text.find(part) != std::string::npos;
    };
    sl::LocalLDLT<Sparse> ours;
    const Vector one = Vector::Ones(1), b = some_vector(16);
    CHECK(all_nan(Dense(ours.solve({0}, one, {0}))) || ours.rows() == 0);
    CHECK(has(ours.lastErrorMessage(), "compute"));
    ours.compute(grid_matrix(4));
    CHECK(ours.lastErrorMessage().empty());
    CHECK(all_nan(Dense(ours.solve({1}, one, {16}))));
    CHECK(has(ours.lastErrorMessage(), "row 16"));
    CHECK(all_nan(Dense(ours.solve({1, 2}, one, {3}))));
    CHECK(has(ours.lastErrorMessage(), "as many rows as its set"));
    Vector broken = b;
    broken[3] = std::numeric_limits<double>::quiet_NaN();
    CHECK(all_nan(Vector(ours.solve(broken))) && has(ours.lastErrorMessage(), "finite"));
    CHECK(!all_nan(Vector(ours.solve(b))) && ours.lastErrorMessage().empty());
    ours.compute(grid_matrix(4, 0.0));
    const std::string refused = ours.lastErrorMessage();
    CHECK(has(refused, "pivot") && has(refused, "setNullPivots") && !has(refused, "sl_"));
    sl::LocalLDLT<Sparse> other(Sparse(2, 3)); /* does not change what ours says */
    CHECK(all_nan(Vector(ours.solve(b))) && ours.lastErrorMessage() == refused);
    CHECK(!other.lastErrorMessage().empty() && other.lastErrorMessage() != refused);
}

void zero_mean() {
    const Sparse A = grid_matrix(5, 0.0);
    const Dense full = Sparse(A.selfadjointView<Eigen::Lower>());
    sl::SimplicialLDLT<Sparse> ours;
    ours.setZeroMean().compute(A);
    CHECK(ours.info() == Eigen::Success && ours.stats().factor.null == 1);
    const Vector b = some_vector(25), x = ours.solve(b);
    const Vector consistent = b.array() - b.mean();
    CHECK(std::fabs(x.mean()) < 1e-13 && close(full * x, consistent));
    const Vector areas = some_vector(25).cwiseAbs();
    ours.options().mass = areas.data();
    const Vector y = ours.compute(A).solve(b);
    CHECK(std::fabs(areas.dot(y)) < 1e-12);
    CHECK(ours.setZeroMean(false).compute(grid_matrix(5)).info() == Eigen::Success);
    /* the complex constants are the null vectors of a Laplacian without phases */
    const Sparse both = A.selfadjointView<Eigen::Lower>();
    sl::SimplicialLDLT<Hermitian> hermitian;
    hermitian.setZeroMean().compute(both.cast<Complex>());
    CHECK(hermitian.info() == Eigen::Success);
    const Eigen::VectorXcd c = some_complex(25), z = hermitian.solve(c);
    const Eigen::VectorXcd centered = c.array() - c.mean();
    CHECK(std::abs(z.mean()) < 1e-12 && close(full.cast<Complex>() * z, centered, 1e-11));
}

// ---- complex numbers ----

template <class M, int UpLo> bool solves_hermitian(double tolerance) {
    typedef typename M::Scalar Scalar;
    const Hermitian A = turning_matrix(7);
    const Eigen::MatrixXcd full = A;
    const M stored = Hermitian(A.triangularView<UpLo>()).template cast<Scalar>();
    const sl::SimplicialLDLT<M, UpLo> ours(stored);
    const Eigen::VectorXcd b = some_complex(49), x = full.partialPivLu().solve(b);
    const Eigen::Matrix<Scalar, Eigen::Dynamic, 1> y = ours.solve(b.template cast<Scalar>());
    return ours.info() == Eigen::Success && close(y.template cast<Complex>(), x, tolerance);
}

void hermitian_matrices() {
    CHECK((solves_hermitian<Hermitian, Eigen::Lower>(1e-11)));
    CHECK((solves_hermitian<Hermitian, Eigen::Upper>(1e-11)));
    typedef Eigen::SparseMatrix<Complex, Eigen::RowMajor, std::int64_t> Rows;
    CHECK((solves_hermitian<Rows, Eigen::Lower>(1e-11)));
    CHECK((solves_hermitian<Rows, Eigen::Upper>(1e-11)));
    CHECK((solves_hermitian<Eigen::SparseMatrix<std::complex<float>>, Eigen::Lower>(1e-4)));
    /* the other triangle is ignored, as are imaginary parts of the diagonal */
    Hermitian A = turning_matrix(3);
    const Eigen::MatrixXcd full = A;
    A.coeffRef(0, 1) = 1e9;
    A.coeffRef(2, 2) += Complex(0, 5);
    sl::SimplicialLDLT<Hermitian> ours(A);
    const Eigen::VectorXcd b = some_complex(9), x = full.partialPivLu().solve(b);
    CHECK(close(Eigen::VectorXcd(ours.solve(b)), x));
    CHECK(close(Eigen::VectorXcd(sl::LocalLLT<Hermitian>(A).solve(b)), x));
    sl::SimplicialLDLT<Hermitian, Eigen::Lower, Eigen::NaturalOrdering<int>> natural(A);
    CHECK(close(Eigen::VectorXcd(natural.solve(b)), x) && natural.permutationP().indices()[0] == 0);
    ours.analyzePattern(A, reversed(9)).factorize(A);
    CHECK(close(Eigen::VectorXcd(ours.solve(b)), x) && ours.permutationPinv().size() == 9);
    /* errors name complex rows */
    A.coeffRef(4, 4) = NAN;
    CHECK(ours.compute(A).status() == SL_ERR_NOT_FINITE && ours.stats().error.row == 4);
    CHECK(ours.compute(Hermitian(2, 3)).info() == Eigen::InvalidInput);
    const Hermitian upper = turning_matrix(3).triangularView<Eigen::Upper>();
    CHECK(ours.compute(upper).status() == SL_ERR_MALFORMED);
    CHECK(ours.compute(Hermitian(0, 0)).info() == Eigen::Success);
    CHECK(ours.setNullPivots(false).compute(Hermitian(2, 2)).info() == Eigen::NumericalIssue);
    Hermitian missing(2, 2);
    missing.insert(1, 0) = Complex(0, 1);
    CHECK(ours.setShift(1).compute(missing).status() == SL_ERR_MALFORMED);
}

void hermitian_factors() {
    const Hermitian A = turning_matrix(5);
    const Eigen::MatrixXcd full = A, inverse = full.inverse();
    const sl::SimplicialLDLT<Hermitian> ours(A);
    const sl::SimplicialLLT<Hermitian> llt(A);
    const Eigen::MatrixXcd PAPt = ours.permutationP() * full * ours.permutationPinv();
    const Eigen::MatrixXcd L = Hermitian(ours.matrixL()), C = Hermitian(llt.matrixL());
    CHECK(close(Eigen::MatrixXcd(L * ours.vectorD().asDiagonal() * L.adjoint()), PAPt));
    CHECK(close(Eigen::MatrixXcd(C * C.adjoint()), PAPt));
    const Eigen::VectorXcd b = some_complex(25), x = inverse * b;
    CHECK(close(Eigen::VectorXcd(ours.matrixL().solve(b)), ours.solvePart(SL_PART_L, b)));
    CHECK(close(Eigen::VectorXcd(ours.matrixU().solve(b)), ours.solvePart(SL_PART_LT, b)));
    CHECK(std::abs(ours.determinant() / full.determinant() - 1.0) < 1e-11);
    CHECK(close(ours.inverseDiagonal(), Vector(inverse.diagonal().real())));
    const Vector two = ours.inverseDiagonal({20, 3});
    CHECK(std::fabs(two[0] - inverse(20, 20).real()) < 1e-12);
    const Eigen::MatrixXcd local = ours.solve({7, 3}, some_complex(2), {11});
    CHECK(std::abs(local(0, 0) - inverse(11, 7) * some_complex(2)[0] -
                   inverse(11, 3) * some_complex(2)[1]) < 1e-12);
    const sl::LocalPlan plan = ours.plan({7, 3}, {11});
    CHECK(plan.nb() == 2 && ours.solve(plan, some_complex(2)) == local);
    CHECK(ours.rcond(A) > 0 && ours.region({3, 4}));
    Hermitian sparse_b(25, 2);
    sparse_b.insert(7, 1) = Complex(1, 2);
    const Hermitian sparse_x = ours.solve(sparse_b);
    CHECK(close(Eigen::MatrixXcd(sparse_x), Eigen::MatrixXcd(inverse * sparse_b)));
}

/* [0 c; conj(c) 0]: pivots in pairs. */
void hermitian_pivots() {
    Hermitian A(2, 2);
    A.insert(1, 0) = Complex(3, 4);
    const sl::SimplicialLDLT<Hermitian> ours(A);
    CHECK(ours.info() == Eigen::Success && ours.permutationP().size() == 0);
    const Eigen::VectorXcd b = some_complex(2), x = ours.solve(b);
    CHECK(std::abs(x[0] - b[1] / Complex(3, 4)) < 1e-13);
    CHECK(std::abs(x[1] - b[0] / Complex(3, -4)) < 1e-13);
    CHECK(Hermitian(ours.matrixL()).rows() == 0 && ours.status() == SL_ERR_UNSUPPORTED);
}

void complex_right_hand_sides() {
    const Sparse A = grid_matrix(6);
    const sl::SimplicialLDLT<Sparse> ours(A);
    const Eigen::MatrixXcd full = Sparse(A.selfadjointView<Eigen::Lower>()).cast<Complex>();
    const Eigen::VectorXcd b = some_complex(36), x = ours.solve(b);
    CHECK(ours.info() == Eigen::Success && close(Eigen::VectorXcd(full * x), b));
    const Eigen::VectorXcf single = ours.solve(b.cast<std::complex<float>>());
    CHECK(close(Eigen::VectorXcd(single.cast<Complex>()), x, 1e-4));
    Hermitian B(36, 2);
    B.insert(4, 0) = Complex(1, -2);
    B.insert(30, 1) = Complex(0, 1);
    const Hermitian X = ours.solve(B);
    CHECK(close(Eigen::MatrixXcd(full * X), Eigen::MatrixXcd(B)));
    const sl::SimplicialLDLT<Sparse> failed(grid_matrix(6, 0.0));
    CHECK(all_nan(Eigen::VectorXcd(failed.solve(b))));
    CHECK(failed.info() == Eigen::NumericalIssue);
}

/* What Eigen's solve asserts, is checked in programs without assertions, too. */
void wrong_sizes() {
    const sl::SimplicialLDLT<Sparse> ours(grid_matrix(3));
    Vector x(9), b(4);
    b.setOnes();
    ours._solve_impl(b, x);
    CHECK(all_nan(x) && ours.status() == SL_ERR_ARGUMENT && ours.info() == Eigen::InvalidInput);
    CHECK(!ours.lastErrorMessage().empty());
    Sparse X, B(4, 1);
    ours._solve_impl(B, X);
    CHECK(ours.status() == SL_ERR_ARGUMENT);
}

} // namespace

int main() {
    return check::run({{"triangular_views", triangular_views},
                       {"mode_of_simplicial_cholesky", mode_of_simplicial_cholesky},
                       {"names_and_types", names_and_types},
                       {"orders_of_the_caller", orders_of_the_caller},
                       {"equality_constraints", equality_constraints},
                       {"null_pivots_are_skipped",
                        null_pivots_are_skipped<sl::SimplicialLDLT<Sparse>>},
                       {"null_pivots_are_skipped_llt",
                        null_pivots_are_skipped<sl::SimplicialLLT<Sparse>>},
                       {"free_bodies", free_bodies},
                       {"own_names_are_strict", own_names_are_strict},
                       {"inertia_of_pivots", inertia_of_pivots},
                       {"errors_have_a_sentence", errors_have_a_sentence},
                       {"zero_mean", zero_mean},
                       {"hermitian_matrices", hermitian_matrices},
                       {"hermitian_factors", hermitian_factors},
                       {"hermitian_pivots", hermitian_pivots},
                       {"complex_right_hand_sides", complex_right_hand_sides},
                       {"wrong_sizes", wrong_sizes}});
}

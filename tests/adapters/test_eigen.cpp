/* test_eigen.cpp: tools/adapters/sparse_local_eigen.hpp against Eigen's own solvers */
#include "tools/adapters/sparse_local_eigen.hpp"

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>

#include "check.hpp"

#include <thread>

namespace {

using check::Grid;
typedef Eigen::SparseMatrix<double> Sparse;
typedef Eigen::VectorXd Vector;
typedef Eigen::MatrixXd Dense;

/* The grid as a matrix of Eigen with the triangles of UpLo. */
template <class M, int UpLo> M grid_matrix(int side, double shift = 0.1) {
    const Grid grid(side, shift);
    Sparse lower = Eigen::Map<const Sparse>(grid.n, grid.n, grid.p[std::size_t(grid.n)],
                                            grid.p.data(), grid.i.data(), grid.x.data());
    Sparse full = lower.selfadjointView<Eigen::Lower>();
    Sparse out = full;
    if (UpLo == Eigen::Lower) out = full.triangularView<Eigen::Lower>();
    if (UpLo == Eigen::Upper) out = full.triangularView<Eigen::Upper>();
    return M(out.template cast<typename M::Scalar>());
}

Vector some_vector(Eigen::Index n) {
    Vector b(n);
    for (Eigen::Index k = 0; k < n; k++) b[k] = std::sin(1.0 + double(k));
    return b;
}

Dense some_matrix(Eigen::Index n, Eigen::Index columns) {
    Dense B(n, columns);
    for (Eigen::Index c = 0; c < columns; c++) B.col(c) = some_vector(n) * double(c + 1);
    return B;
}

template <class A, class B> bool close(const A &a, const B &b, double tolerance = 1e-12) {
    return a.rows() == b.rows() && a.cols() == b.cols() &&
           (a.size() == 0 || (a - b).cwiseAbs().maxCoeff() <= tolerance);
}

template <class A> bool all_nan(const A &a) {
    return a.size() > 0 && (a.array() != a.array()).all();
}

/* L, D and P of our solver, one by one, against the matrices that it returns. */
void parts_of_solves() {
    const Sparse A = grid_matrix<Sparse, Eigen::Lower>(13);
    const sl::SimplicialLDLT<Sparse> ours(A);
    const Dense B = some_matrix(169, 3), whole = ours.solve(B);
    const Sparse L = ours.matrixL();
    const Dense PB = ours.permutationP() * B;
    CHECK(close(ours.solvePart(SL_PART_P, B), PB, 0));
    CHECK(close(L * ours.solvePart(SL_PART_L, B), B));
    CHECK(close(ours.multiplyPart(SL_PART_L, B), L * B));
    CHECK(close(L.transpose() * ours.solvePart(SL_PART_LT, B), B));
    CHECK(close(ours.vectorD().asDiagonal() * ours.solvePart(SL_PART_D, B), B));
    const Dense half = ours.solvePart(SL_PART_P | SL_PART_L, B);
    const Dense rest = ours.solvePart(SL_PART_D | SL_PART_LT | SL_PART_PT, half);
    CHECK(close(rest, whole, 0));
    CHECK(ours.info() == Eigen::Success);
    CHECK(all_nan(ours.solvePart(64, B)) && ours.status() == SL_ERR_ARGUMENT);
    CHECK(all_nan(ours.solvePart(SL_PART_L, B.topRows(5))));
}

// ---- the solver concept ----

/* The same matrix and right-hand side through Eigen's solver and ours. */
template <class M, int UpLo> bool agrees(double tolerance) {
    typedef Eigen::Matrix<typename M::Scalar, Eigen::Dynamic, 1> V;
    const M A = grid_matrix<M, UpLo>(13);
    const Vector in_double = some_vector(A.rows());
    const V b = in_double.template cast<typename M::Scalar>();
    Eigen::SimplicialLDLT<M, UpLo> theirs(A);
    sl::SimplicialLDLT<M, UpLo> ours(A);
    sl::SimplicialLLT<M, UpLo> llt;
    llt.analyzePattern(A);
    llt.factorize(A);
    const V x = theirs.solve(b), y = ours.solve(b), z = llt.solve(b);
    return ours.info() == Eigen::Success && llt.info() == Eigen::Success &&
           ours.rows() == A.rows() && llt.analyses() == 1 && close(x, y, tolerance) &&
           close(y, z, tolerance);
}

void triangles_and_orders() {
    CHECK((agrees<Sparse, Eigen::Lower>(1e-12)));
    CHECK((agrees<Sparse, Eigen::Upper>(1e-12)));
    /* Eigen's solvers take one triangle; here both may be given */
    const Vector b = some_vector(169);
    sl::SimplicialLDLT<Sparse, Eigen::Lower | Eigen::Upper> both(
        grid_matrix<Sparse, Eigen::Lower | Eigen::Upper>(13));
    Eigen::SimplicialLDLT<Sparse> lower(grid_matrix<Sparse, Eigen::Lower>(13));
    CHECK(close(Vector(both.solve(b)), Vector(lower.solve(b))));
    CHECK((agrees<Eigen::SparseMatrix<double, Eigen::RowMajor>, Eigen::Lower>(1e-12)));
    CHECK((agrees<Eigen::SparseMatrix<double, Eigen::RowMajor>, Eigen::Upper>(1e-12)));
}

void index_and_number_types() {
    typedef Eigen::SparseMatrix<double, Eigen::ColMajor, std::int64_t> Long;
    typedef Eigen::SparseMatrix<double, Eigen::RowMajor, std::int64_t> LongRows;
    CHECK((agrees<Long, Eigen::Lower>(1e-12)));
    CHECK((agrees<LongRows, Eigen::Upper>(1e-12)));
    CHECK((agrees<Eigen::SparseMatrix<float>, Eigen::Lower>(1e-4)));
    CHECK((agrees<Eigen::SparseMatrix<float, Eigen::RowMajor, std::int64_t>, Eigen::Lower>(1e-4)));
}

/* The other triangle of a full matrix is ignored, whatever is in it. */
void other_triangle_is_ignored() {
    Sparse A = grid_matrix<Sparse, Eigen::Lower | Eigen::Upper>(6);
    Sparse lower = A.triangularView<Eigen::Lower>();
    A.coeffRef(0, 1) = 1e9;
    A.coeffRef(0, 30) = NAN;
    A.makeCompressed();
    const Vector b = some_vector(36);
    sl::SimplicialLDLT<Sparse> ours(A), clean(lower);
    CHECK(ours.info() == Eigen::Success);
    CHECK(close(Vector(ours.solve(b)), Vector(clean.solve(b)), 1e-13));
    sl::SimplicialLDLT<Eigen::SparseMatrix<double, Eigen::RowMajor>, Eigen::Upper> rows(
        Sparse(A.transpose()));
    CHECK(close(Vector(rows.solve(b)), Vector(clean.solve(b)), 1e-13));
}

/* Every form of right-hand side and destination that Eigen's solve takes. */
void dense_right_hand_sides() {
    const Sparse A = grid_matrix<Sparse, Eigen::Lower>(9);
    Eigen::SimplicialLDLT<Sparse> theirs(A);
    sl::SimplicialLDLT<Sparse> ours(A);
    const Dense B = some_matrix(81, 11), X = theirs.solve(B);
    CHECK(close(Dense(ours.solve(B)), X));
    /* expressions, blocks with strides, rows of matrices, maps, row-major ones, floats */
    CHECK(close(Dense(ours.solve(2.0 * B)), 2 * X));
    Dense wide = Dense::Zero(100, 30);
    wide.block(3, 2, 81, 11) = B;
    CHECK(close(Dense(ours.solve(wide.block(3, 2, 81, 11))), X));
    Dense turned = B.transpose();
    CHECK(close(Vector(ours.solve(turned.row(4).transpose())), X.col(4)));
    CHECK(close(Dense(ours.solve(turned.transpose())), X));
    typedef Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> RowMajor;
    const RowMajor row_major = B;
    RowMajor out = ours.solve(row_major);
    CHECK(close(out, X));
    const Eigen::MatrixXf single = B.cast<float>();
    const Eigen::SparseMatrix<float> short_A = A.cast<float>();
    sl::SimplicialLDLT<Eigen::SparseMatrix<float>> floats(short_A);
    Eigen::MatrixXf single_x = floats.solve(single);
    CHECK(close(Dense(single_x.cast<double>()), X, 1e-4));
    CHECK(close(Dense(ours.solve(single.cast<double>())), X, 1e-4));
    /* into blocks, and in place */
    wide.block(3, 2, 81, 11) = ours.solve(B);
    CHECK(close(wide.block(3, 2, 81, 11), X) && wide(2, 2) == 0 && wide(84, 12) == 0);
    wide.block(3, 2, 81, 11) = B;
    wide.block(3, 2, 81, 11) = ours.solve(wide.block(3, 2, 81, 11));
    CHECK(close(wide.block(3, 2, 81, 11), X));
    Dense in_place = B;
    in_place = ours.solve(in_place);
    CHECK(close(in_place, X));
    Vector v = B.col(2);
    v = ours.solve(v);
    CHECK(close(v, X.col(2)));
    turned.row(5) = ours.solve(B.col(5)).transpose();
    CHECK(close(turned.row(5).transpose(), X.col(5)));
    /* shifted overlap: the result is that of the old right-hand side */
    Vector long_vector = Vector::Zero(90);
    long_vector.segment(4, 81) = B.col(0);
    long_vector.segment(0, 81) = ours.solve(long_vector.segment(4, 81));
    CHECK(close(long_vector.segment(0, 81), X.col(0)));
    CHECK(Dense(ours.solve(Dense(81, 0))).cols() == 0);
}

void sparse_right_hand_sides() {
    const Sparse A = grid_matrix<Sparse, Eigen::Lower>(9);
    Eigen::SimplicialLDLT<Sparse> theirs(A);
    sl::SimplicialLDLT<Sparse> ours(A);
    Sparse B(81, 19);
    for (int c = 0; c < 19; c++) {
        if (c == 7) continue; /* a column without entries */
        B.insert((c * 37) % 81, c) = 1 + c;
        if (c % 3 == 0) B.insert((c * 37 + 11) % 81, c) = -1;
    }
    const Sparse X = theirs.solve(B), Y = ours.solve(B);
    CHECK(ours.info() == Eigen::Success && close(Dense(X), Dense(Y)) && Y.col(7).sum() == 0);
    const Eigen::SparseMatrix<double, Eigen::RowMajor> by_rows = B;
    const Sparse from_rows = ours.solve(by_rows);
    CHECK(close(Dense(from_rows), Dense(X)));
    const Eigen::SparseVector<double> b = B.col(3);
    const Eigen::SparseVector<double> x = ours.solve(b);
    CHECK(close(Vector(x), Vector(X.col(3))));
    const Sparse none = ours.solve(Sparse(81, 0));
    CHECK(none.cols() == 0);
}

void refactorization() {
    Sparse A = grid_matrix<Sparse, Eigen::Lower>(8);
    const Vector b = some_vector(64);
    sl::SimplicialLDLT<Sparse> ours;
    ours.analyzePattern(A);
    CHECK(ours.info() == Eigen::Success);
    for (int k = 1; k <= 3; k++) {
        A.coeffRef(5, 5) += 1;
        ours.factorize(A);
        CHECK(close(Vector(ours.solve(b)), Vector(Eigen::SimplicialLDLT<Sparse>(A).solve(b))));
    }
    ours.compute(A);
    CHECK(ours.analyses() == 1);
    /* another pattern is analyzed, also one of another size */
    A.coeffRef(63, 0) = -0.5;
    A.makeCompressed();
    ours.factorize(A);
    CHECK(ours.analyses() == 2);
    CHECK(close(Vector(ours.solve(b)), Vector(Eigen::SimplicialLDLT<Sparse>(A).solve(b))));
    ours.compute(grid_matrix<Sparse, Eigen::Lower>(5));
    CHECK(ours.analyses() == 3 && ours.rows() == 25);
}

void determinant_and_factors() {
    const Sparse A = grid_matrix<Sparse, Eigen::Lower>(4);
    Eigen::SimplicialLDLT<Sparse> theirs(A);
    sl::SimplicialLDLT<Sparse> ours(A);
    sl::SimplicialLLT<Sparse> llt(A);
    const Dense full = Dense(Sparse(A.selfadjointView<Eigen::Lower>()));
    CHECK(std::fabs(ours.determinant() / theirs.determinant() - 1) < 1e-12);
    CHECK(std::fabs(ours.logAbsDeterminant() - std::log(theirs.determinant())) < 1e-12);
    CHECK(ours.signDeterminant() == 1 && ours.logDeterminant() == ours.logAbsDeterminant());
    const Dense PAPt = ours.permutationP() * full * ours.permutationPinv();
    const Dense L = Sparse(ours.matrixL());
    CHECK(close(PAPt, Dense(L * ours.vectorD().asDiagonal() * L.transpose()), 1e-13));
    const Dense C = llt.matrixL();
    CHECK(close(Dense(llt.permutationP() * full * llt.permutationPinv()), Dense(C * C.transpose()),
                1e-13));
    const double exact =
        1 / (full.cwiseAbs().colwise().sum().maxCoeff() *
             full.inverse().cwiseAbs().colwise().sum().maxCoeff());
    CHECK(ours.rcond(A) >= exact * (1 - 1e-9) && ours.rcond(A) <= 3 * exact);
}

void shifted() {
    const Sparse A = grid_matrix<Sparse, Eigen::Lower>(6);
    const Vector b = some_vector(36);
    Eigen::SimplicialLDLT<Sparse> theirs;
    sl::SimplicialLDLT<Sparse> ours;
    theirs.setShift(0.5, 2).compute(A);
    ours.setShift(0.5, 2).compute(A);
    CHECK(close(Vector(theirs.solve(b)), Vector(ours.solve(b))));
    Sparse missing(2, 2);
    missing.insert(0, 0) = 1;
    missing.insert(1, 0) = 0.5;
    CHECK(ours.compute(missing).info() == Eigen::InvalidInput);
}

void natural_order() {
    const Sparse A = grid_matrix<Sparse, Eigen::Lower>(5);
    sl::SimplicialLDLT<Sparse, Eigen::Lower, Eigen::NaturalOrdering<int>> ours;
    ours.options().relaxation = SL_RELAXATION_NONE;
    ours.compute(A);
    sl::SimplicialLDLT<Sparse> dissected(A);
    const Vector b = some_vector(25);
    CHECK(ours.permutationP().indices()[0] == 0);
    CHECK(close(Vector(ours.solve(b)), Vector(dissected.solve(b))));
}

// ---- local calls ----

void local_solves() {
    const Sparse A = grid_matrix<Sparse, Eigen::Lower>(15);
    sl::SimplicialLDLT<Sparse> ours(A);
    Eigen::VectorXi bset(2), xset(3);
    bset << 17, 200;
    xset << 5, 224, 17;
    const Dense B = some_matrix(2, 3);
    Dense full = Dense::Zero(225, 3);
    for (int k = 0; k < 2; k++) full.row(bset[k]) = B.row(k);
    const Dense X = ours.solve(full);
    const Dense x = ours.solve(bset, B, xset);
    CHECK(ours.info() == Eigen::Success && x.rows() == 3 && x.cols() == 3);
    for (int k = 0; k < 3; k++) CHECK(x.row(k) == X.row(xset[k]));
    const std::vector<std::int64_t> same_set = {17, 200};
    CHECK(ours.solve(same_set, B, {5, 224, 17}) == x);
    CHECK(ours.solve({17, 200}, B, sl::RowSet::all()) == X);
    CHECK(ours.solve({}, Dense(0, 2), {3}) == Dense::Zero(1, 2));
    CHECK(ours.solve(bset, B, {}).rows() == 0);

    const sl::LocalPlan plan = ours.plan(bset, xset);
    CHECK(plan && plan.nb() == 2 && plan.nx() == 3 && ours.solve(plan, B) == x);
    Vector single = ours.solve(plan, B.col(1));
    CHECK(close(single, x.col(1), 1e-14));
    /* the plan serves other values of the pattern, also after the solver went to another one */
    Sparse twice = 2 * A;
    ours.factorize(twice);
    CHECK(close(ours.solve(plan, B), 0.5 * x, 1e-14));
    ours.compute(grid_matrix<Sparse, Eigen::Lower>(4));
    CHECK(all_nan(ours.solve(plan, B)) && ours.status() == SL_ERR_STATE);
    ours.compute(A);
    CHECK(ours.solve(sl::LocalPlan(), Dense(0, 1)).size() == 0);
    CHECK(ours.info() == Eigen::InvalidInput);
}

void regions() {
    const Sparse A = grid_matrix<Sparse, Eigen::Lower>(30);
    sl::SimplicialLDLT<Sparse> ours(A);
    const std::vector<int> set = {400, 401, 402, 430, 431, 432};
    sl::LocalRegion region = ours.region(set);
    CHECK(region && region.stats().rows >= 6);
    sl::LocalPlan plan = ours.plan(set, set, region);
    CHECK(plan.stats().in_region == 1);
    const Dense B = some_matrix(6, 2), x = ours.solve(set, B, set);
    CHECK(close(ours.solve(plan, B), x, 1e-13));
    /* other numbers: refused until the region is updated; the plan keeps its region alive */
    Sparse twice = 2 * A;
    ours.factorize(twice);
    CHECK(all_nan(ours.solve(plan, B)) && ours.status() == SL_ERR_STALE);
    CHECK(ours.update(region) && close(ours.solve(plan, B), 0.5 * x, 1e-13));
    region = sl::LocalRegion();
    CHECK(close(ours.solve(plan, B), 0.5 * x, 1e-13));
    CHECK(!ours.update(region) && ours.info() == Eigen::InvalidInput);
}

void inverse_diagonal() {
    const Sparse A = grid_matrix<Sparse, Eigen::Lower>(6);
    sl::SimplicialLDLT<Sparse> ours(A);
    const Dense inverse = Dense(Sparse(A.selfadjointView<Eigen::Lower>())).inverse();
    CHECK(close(ours.inverseDiagonal(), inverse.diagonal(), 1e-13));
    const Vector two = ours.inverseDiagonal({20, 3});
    CHECK(std::fabs(two[0] - inverse(20, 20)) < 1e-13 && std::fabs(two[1] - inverse(3, 3)) < 1e-13);
}

void threads() {
    const Sparse A = grid_matrix<Sparse, Eigen::Lower>(20);
    const sl::SimplicialLDLT<Sparse> ours(A);
    const sl::LocalPlan plan = ours.plan({7}, {390});
    const Vector one = Vector::Ones(1), b = some_vector(400), x = ours.solve(b);
    const Dense wanted = ours.solve(plan, one);
    std::vector<int> wrong(4, 0);
    std::vector<std::thread> all;
    for (int t = 0; t < 4; t++) {
        all.push_back(std::thread([&, t] {
            for (int k = 0; k < 100; k++) {
                const Vector y = ours.solve(b);
                if (y != x || ours.solve(plan, one) != wanted) wrong[std::size_t(t)]++;
            }
        }));
    }
    for (std::thread &thread : all) thread.join();
    CHECK(wrong == std::vector<int>(4, 0));
}

// ---- hostile matrices ----

void not_compressed_and_not_sorted() {
    const Sparse A = grid_matrix<Sparse, Eigen::Lower>(6);
    const Vector b = some_vector(36), x = sl::SimplicialLDLT<Sparse>(A).solve(b);
    Sparse loose = A;
    loose.reserve(Eigen::VectorXi::Constant(36, 9));
    CHECK(!loose.isCompressed());
    CHECK(close(Vector(sl::SimplicialLDLT<Sparse>(loose).solve(b)), x, 1e-14));
    /* rows of each column in descending order */
    std::vector<int> p(A.outerIndexPtr(), A.outerIndexPtr() + 37);
    std::vector<int> i(A.innerIndexPtr(), A.innerIndexPtr() + A.nonZeros());
    std::vector<double> v(A.valuePtr(), A.valuePtr() + A.nonZeros());
    for (int j = 0; j < 36; j++) {
        std::reverse(i.begin() + p[std::size_t(j)], i.begin() + p[std::size_t(j) + 1]);
        std::reverse(v.begin() + p[std::size_t(j)], v.begin() + p[std::size_t(j) + 1]);
    }
    const Sparse turned = [&] {
        Sparse copy = A;
        std::copy(i.begin(), i.end(), copy.innerIndexPtr());
        std::copy(v.begin(), v.end(), copy.valuePtr());
        return copy;
    }();
    CHECK(close(Vector(sl::SimplicialLDLT<Sparse>(turned).solve(b)), x, 1e-13));
    /* positions and rows out of range */
    Sparse broken = A;
    broken.innerIndexPtr()[3] = 36;
    sl::SimplicialLDLT<Sparse> ours(broken);
    CHECK(ours.info() == Eigen::InvalidInput && ours.status() == SL_ERR_PATTERN);
    CHECK(ours.stats().error.row == 36 && all_nan(Vector(ours.solve(b))));
    broken.innerIndexPtr()[3] = -1;
    CHECK(ours.setShift(1).compute(broken).info() == Eigen::InvalidInput);
    broken = A;
    broken.outerIndexPtr()[5] = broken.outerIndexPtr()[4] - 1;
    CHECK(ours.compute(broken).info() == Eigen::InvalidInput);
}

void not_square() {
    Sparse A(3, 2);
    A.insert(0, 0) = 1;
    A.insert(1, 1) = 1;
    A.makeCompressed();
    sl::SimplicialLDLT<Sparse> ours(A);
    CHECK(ours.info() == Eigen::InvalidInput && ours.status() == SL_ERR_ARGUMENT);
    CHECK(all_nan(Vector(ours.solve(Vector::Ones(3)))));
    ours.analyzePattern(A);
    CHECK(ours.info() == Eigen::InvalidInput);
    CHECK(!ours.plan({0}, {0}) && !ours.region({0}) && ours.permutationP().size() == 0);
    CHECK(ours.matrixL().rows() == 0 && ours.vectorD().size() == 0);
}

void empty_and_zero() {
    sl::SimplicialLDLT<Sparse> ours;
    ours.compute(Sparse());
    CHECK(ours.info() == Eigen::Success && ours.rows() == 0);
    CHECK(Vector(ours.solve(Vector())).size() == 0 && ours.info() == Eigen::Success);
    CHECK(ours.inverseDiagonal().size() == 0 && ours.determinant() == 1);
    ours.compute(Sparse(3, 3)); /* no entry at all */
    CHECK(ours.info() == Eigen::NumericalIssue && ours.stats().error.row >= 0);
    CHECK(all_nan(Vector(ours.solve(Vector::Ones(3)))));
}

void singular_and_indefinite() {
    const Sparse A = grid_matrix<Sparse, Eigen::Lower>(7, 0.0);
    sl::SimplicialLDLT<Sparse> ours(A);
    CHECK(ours.info() == Eigen::NumericalIssue && ours.status() == SL_ERR_PIVOT);
    const Sparse failed = ours.solve(Sparse(Dense::Identity(49, 2).sparseView()));
    CHECK(all_nan(Dense(failed)) && ours.info() == Eigen::NumericalIssue);
    /* as a Laplacian: one null pivot; inconsistent right-hand sides are refused one by one */
    ours.options().null_pivots = SL_NULL_PIVOT_SKIP;
    CHECK(ours.compute(A).info() == Eigen::Success && ours.stats().factor.null == 1);
    CHECK(ours.analyses() == 1);
    Vector b = some_vector(49);
    CHECK(all_nan(Vector(ours.solve(b))) && ours.info() == Eigen::NumericalIssue);
    b.array() -= b.mean();
    const Vector x = ours.solve(b);
    CHECK(ours.info() == Eigen::Success);
    CHECK(close(Vector(A.selfadjointView<Eigen::Lower>() * x), b, 1e-12));
    /* LDLT accepts a negative pivot, LLT refuses it and names its row */
    Sparse indefinite = grid_matrix<Sparse, Eigen::Lower>(4);
    indefinite.coeffRef(6, 6) = -50;
    sl::SimplicialLDLT<Sparse> ldlt(indefinite);
    CHECK(ldlt.info() == Eigen::Success && ldlt.signDeterminant() == -1);
    CHECK(ldlt.logDeterminant() != ldlt.logDeterminant());
    sl::CholmodSupernodalLLT<Sparse> llt(indefinite);
    CHECK(llt.info() == Eigen::NumericalIssue && llt.stats().error.row == 6);
    CHECK(all_nan(Vector(llt.solve(some_vector(16)))));
    indefinite.coeffRef(6, 6) = 50;
    CHECK(llt.compute(indefinite).info() == Eigen::Success);
}

/* [H B'; B 0] with zeros on the diagonal, against a dense solution; then other values. */
void chosen_pivots() {
    Dense K = Dense::Zero(6, 6);
    for (int k = 0; k < 4; k++) K(4 + k % 2, k) = 1.0 + k;
    for (int k = 0; k < 3; k++) K(k + 1, k) = 0.5;
    K(0, 0) = 0.0;
    const Dense full = K.selfadjointView<Eigen::Lower>();
    const Sparse A = full.sparseView();
    const Vector b = some_vector(6);
    sl::SimplicialLDLT<Sparse> ours;
    CHECK(ours.setPivoted(false).compute(A).status() == SL_ERR_PIVOT);
    CHECK(ours.stats().error.what != nullptr);
    ours.setPivoted();
    CHECK(all_nan(Vector(ours.solve(b)))); /* no factor any more */
    CHECK(ours.compute(A).info() == Eigen::Success && ours.stats().symbolic.pairs > 0);
    CHECK(close(Vector(ours.solve(b)), Vector(full.partialPivLu().solve(b)), 1e-10));
    const int analyses = ours.analyses();
    CHECK(ours.compute(2.0 * A).info() == Eigen::Success && ours.analyses() == analyses);
    Sparse other = A; /* pivots that do not suit are chosen again */
    for (int k = 0; k < other.nonZeros(); k++) other.valuePtr()[k] = 0.0;
    CHECK(ours.compute(other).status() == SL_ERR_PIVOT && ours.analyses() == analyses + 1);
    CHECK(ours.compute(A).info() == Eigen::Success);
    ours.setPivoted(false).compute(A);
    CHECK(ours.status() == SL_ERR_PIVOT);
}

/* A matrix that stores only the triangle that is not read would pass for its diagonal. */
void the_wrong_triangle_is_refused() {
    const Sparse lower = grid_matrix<Sparse, Eigen::Lower>(4), upper = lower.transpose();
    Sparse diagonal(16, 16), whole = lower.selfadjointView<Eigen::Lower>();
    diagonal.setIdentity();
    sl::SimplicialLDLT<Sparse> ours(upper);
    CHECK(ours.info() != Eigen::Success && ours.status() == SL_ERR_PATTERN);
    CHECK(all_nan(Vector(ours.solve(some_vector(16)))));
    CHECK(ours.compute(lower).info() == Eigen::Success);
    CHECK(ours.compute(upper).status() == SL_ERR_PATTERN);
    CHECK(all_nan(Vector(ours.solve(some_vector(16)))));
    CHECK(ours.compute(whole).info() == Eigen::Success);
    CHECK(ours.compute(diagonal).info() == Eigen::Success);
    sl::SimplicialLDLT<Sparse, Eigen::Upper> other(lower);
    CHECK(other.status() == SL_ERR_PATTERN);
    CHECK(other.compute(upper).info() == Eigen::Success);
}

void values_that_are_not_finite() {
    Sparse A = grid_matrix<Sparse, Eigen::Lower>(5);
    A.coeffRef(7, 7) = NAN;
    sl::SimplicialLDLT<Sparse> ours(A);
    CHECK(ours.info() == Eigen::NumericalIssue && ours.status() == SL_ERR_NOT_FINITE);
    CHECK(ours.stats().error.row == 7);
    A.coeffRef(7, 7) = 4;
    ours.factorize(A);
    CHECK(ours.info() == Eigen::Success && ours.analyses() == 1);
}

void wrong_sets() {
    const Sparse A = grid_matrix<Sparse, Eigen::Lower>(5);
    sl::SimplicialLDLT<Sparse> ours(A);
    const Dense B = some_matrix(1, 1);
    CHECK(all_nan(ours.solve({25}, B, {0})) && ours.info() == Eigen::InvalidInput);
    CHECK(all_nan(ours.solve({-1}, B, {0})));
    CHECK(all_nan(ours.solve(std::vector<std::int64_t>(1, std::int64_t(1) << 32), B, {0})));
    CHECK(all_nan(ours.solve({0, 1}, B, {0}))); /* two rows, one value */
    CHECK(!ours.plan({0}, {99}) && ours.info() == Eigen::InvalidInput);
    CHECK(all_nan(ours.inverseDiagonal({3, 25})));
    sl::SimplicialLDLT<Sparse> none;
    CHECK(none.status() == SL_ERR_STATE && none.rows() == 0);
    CHECK(!none.plan({}, {}) && all_nan(none.solve({}, Dense(0, 1), {0})));
}

} // namespace

int main() {
    return check::run({{"triangles_and_orders", triangles_and_orders},
                       {"index_and_number_types", index_and_number_types},
                       {"other_triangle_is_ignored", other_triangle_is_ignored},
                       {"dense_right_hand_sides", dense_right_hand_sides},
                       {"sparse_right_hand_sides", sparse_right_hand_sides},
                       {"refactorization", refactorization},
                       {"determinant_and_factors", determinant_and_factors},
                       {"parts_of_solves", parts_of_solves},
                       {"shifted", shifted},
                       {"natural_order", natural_order},
                       {"local_solves", local_solves},
                       {"regions", regions},
                       {"inverse_diagonal", inverse_diagonal},
                       {"threads", threads},
                       {"not_compressed_and_not_sorted", not_compressed_and_not_sorted},
                       {"not_square", not_square},
                       {"empty_and_zero", empty_and_zero},
                       {"singular_and_indefinite", singular_and_indefinite},
                       {"chosen_pivots", chosen_pivots},
                       {"the_wrong_triangle_is_refused", the_wrong_triangle_is_refused},
                       {"values_that_are_not_finite", values_that_are_not_finite},
                       {"wrong_sets", wrong_sets}});
}

/* test_eigen.cpp: tools/adapters/sparse_local_eigen.hpp against Eigen's own solvers */
#include "eigen_check.hpp"

#include <Eigen/SparseCholesky>

#include <thread>

namespace {

using check::all_nan;
using check::close;
using check::Dense;
using check::grid_matrix;
using check::some_matrix;
using check::some_vector;
using check::Sparse;
using check::Vector;

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
    const double exact = 1 / (full.cwiseAbs().colwise().sum().maxCoeff() *
                              full.inverse().cwiseAbs().colwise().sum().maxCoeff());
    CHECK(ours.rcond(A) >= exact * (1 - 1e-9) && ours.rcond(A) <= 3 * exact);
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
    for (int k = 0; k < 2; k++)
        full.row(bset[k]) = B.row(k);
    const Dense X = ours.solve(full);
    const Dense x = ours.solve(bset, B, xset);
    CHECK(ours.info() == Eigen::Success && x.rows() == 3 && x.cols() == 3);
    for (int k = 0; k < 3; k++)
        CHECK(x.row(k) == X.row(xset[k]));
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
    CHECK(all_nan(ours.solve(plan, B)) && ours.status() == SL_ERR_MISMATCH);
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
    CHECK(ours.refactor(region) && close(ours.solve(plan, B), 0.5 * x, 1e-13));
    region = sl::LocalRegion();
    CHECK(close(ours.solve(plan, B), 0.5 * x, 1e-13));
    CHECK(!ours.refactor(region) && ours.info() == Eigen::InvalidInput);
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
    for (std::thread &thread : all)
        thread.join();
    CHECK(wrong == std::vector<int>(4, 0));
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
                       {"threads", threads}});
}

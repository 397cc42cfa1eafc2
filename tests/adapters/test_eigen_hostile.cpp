/* test_eigen_hostile.cpp: malformed, singular and indefinite matrices in our classes for Eigen */
#include "eigen_check.hpp"

namespace {

using check::all_nan;
using check::close;
using check::Dense;
using check::grid_matrix;
using check::some_matrix;
using check::some_vector;
using check::Sparse;
using check::Vector;

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
    CHECK(ours.info() == Eigen::InvalidInput && ours.status() == SL_ERR_MALFORMED);
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
    CHECK(ours.info() == Eigen::Success && ours.stats().factor.null == 3);
    CHECK(all_nan(Vector(ours.solve(Vector::Ones(3)))) && ours.info() == Eigen::NumericalIssue);
    CHECK(ours.setNullPivots(false).compute(Sparse(3, 3)).info() == Eigen::NumericalIssue);
    CHECK(ours.stats().error.row >= 0 && all_nan(Vector(ours.solve(Vector::Ones(3)))));
}

void singular_and_indefinite() {
    const Sparse A = grid_matrix<Sparse, Eigen::Lower>(7, 0.0);
    sl::SimplicialLDLT<Sparse> ours;
    ours.setNullPivots(false).compute(A);
    CHECK(ours.info() == Eigen::NumericalIssue && ours.status() == SL_ERR_PIVOT);
    const Sparse failed = ours.solve(Sparse(Dense::Identity(49, 2).sparseView()));
    CHECK(all_nan(Dense(failed)) && ours.info() == Eigen::NumericalIssue);
    /* as a Laplacian: one null pivot; inconsistent right-hand sides are refused one by one */
    ours.options().pivots = SL_PIVOTS_SKIP_NULL;
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
    for (int k = 0; k < 4; k++)
        K(4 + k % 2, k) = 1.0 + k;
    for (int k = 0; k < 3; k++)
        K(k + 1, k) = 0.5;
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
    for (int k = 0; k < other.nonZeros(); k++)
        other.valuePtr()[k] = 0.0;
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
    CHECK(ours.info() != Eigen::Success && ours.status() == SL_ERR_MALFORMED);
    CHECK(all_nan(Vector(ours.solve(some_vector(16)))));
    CHECK(ours.compute(lower).info() == Eigen::Success);
    CHECK(ours.compute(upper).status() == SL_ERR_MALFORMED);
    CHECK(all_nan(Vector(ours.solve(some_vector(16)))));
    CHECK(ours.compute(whole).info() == Eigen::Success);
    CHECK(ours.compute(diagonal).info() == Eigen::Success);
    sl::SimplicialLDLT<Sparse, Eigen::Upper> other(lower);
    CHECK(other.status() == SL_ERR_MALFORMED);
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
    CHECK(none.status() == SL_ERR_MISMATCH && none.rows() == 0);
    CHECK(!none.plan({}, {}) && all_nan(none.solve({}, Dense(0, 1), {0})));
}

} // namespace

int main() {
    return check::run({{"not_compressed_and_not_sorted", not_compressed_and_not_sorted},
                       {"not_square", not_square},
                       {"empty_and_zero", empty_and_zero},
                       {"singular_and_indefinite", singular_and_indefinite},
                       {"chosen_pivots", chosen_pivots},
                       {"the_wrong_triangle_is_refused", the_wrong_triangle_is_refused},
                       {"values_that_are_not_finite", values_that_are_not_finite},
                       {"wrong_sets", wrong_sets}});
}

/* test_eigen_pivots.cpp: 1x1 and 2x2 pivots by the values, and whether they suit later values */
#include "eigen_check.hpp"

#include <random>

namespace {

using check::all_nan;
using check::some_vector;
using check::Sparse;
using check::Vector;

/* max_i |b - A x|_i / (|A| |x| + |b|)_i for the lower triangle of A. */
double row_error(const Sparse &A, const Vector &x, const Vector &b) {
    const Sparse full = A.selfadjointView<Eigen::Lower>();
    const Vector r = (b - full * x).cwiseAbs();
    const Vector size = full.cwiseAbs() * x.cwiseAbs() + b.cwiseAbs();
    double error = 0;
    for (Eigen::Index k = 0; k < r.size(); k++) {
        const double e = r[k] == 0 ? 0 : r[k] / size[k];
        if (!(e <= error)) error = e;
    }
    return error;
}

/* The same of the system whose solution is all ones. */
template <class Solver> double error_of_ones(const Solver &solver, const Sparse &A) {
    const Sparse full = A.selfadjointView<Eigen::Lower>();
    const Vector b = full * Vector::Ones(A.rows());
    return row_error(A, solver.solve(b), b);
}

/* [s 0 1; 0 d 1; 1 1 0]. Rows 0 and 2 are a 2x2 pivot for s = 0; for a large s it loses d. */
Sparse small_matrix(double s, double d) {
    std::vector<Eigen::Triplet<double>> t;
    for (int k = 0; k < 3; k++)
        t.emplace_back(k, k, k == 0 ? s : k == 1 ? d : 0.0);
    for (int k = 0; k < 2; k++)
        t.emplace_back(2, k, 1.0);
    Sparse out(3, 3);
    out.setFromTriplets(t.begin(), t.end());
    return out;
}

template <class Solver> void values_that_grow(Solver &ours) {
    const Sparse first = small_matrix(0, 0.5), next = small_matrix(1e19, 1);
    Vector b(3);
    b << 1, 2, 3;
    ours.compute(first);
    CHECK(ours.info() == Eigen::Success && ours.stats().symbolic.pairs == 1);
    CHECK(row_error(first, ours.solve(b), b) < 1e-14);
    const int analyses = ours.analyses();
    ours.factorize(next);
    CHECK(ours.info() == Eigen::Success && ours.analyses() == analyses + 1);
    CHECK(row_error(next, ours.solve(b), b) < 1e-14);
    CHECK(ours.stats().refine.backward_error < 1e-14);
    /* these pivots are kept while they are good */
    CHECK(ours.factorize(small_matrix(1e18, 1)).info() == Eigen::Success);
    CHECK(ours.analyses() == analyses + 1);
    CHECK(ours.factorize(first).info() == Eigen::Success);
    CHECK(row_error(first, ours.solve(b), b) < 1e-14);
}

void values_that_grow_are_noticed() {
    sl::SimplicialLDLT<Sparse> if_needed, always;
    values_that_grow(if_needed);
    values_that_grow(always.setPivoted());
    sl::SimplicialLDLT<Sparse> in_float;
    in_float.options().storage = SL_STORAGE_FLOAT;
    in_float.setPivoted().compute(small_matrix(0, 0.5));
    CHECK(in_float.factorize(small_matrix(1e19, 1)).info() == Eigen::Success);
    CHECK(in_float.analyses() == 2 && error_of_ones(in_float, small_matrix(1e19, 1)) < 1e-6);
    CHECK(in_float.factorize(small_matrix(3e18, 0.7)).analyses() == 2);
}

/* The check reads the triangle that the factorization reads, and complex matrices as real ones. */
template <class M, int UpLo> bool reads_one_triangle(double other) {
    typedef Eigen::Matrix<typename M::Scalar, Eigen::Dynamic, 1> V;
    sl::SimplicialLDLT<M, UpLo> ours;
    Vector b(3);
    b << 1, 2, 3;
    ours.setPivoted();
    for (int step = 0; step < 2; step++) {
        const Sparse A = step == 0 ? small_matrix(0, 0.5) : small_matrix(1e19, 1);
        Sparse full = A.selfadjointView<Eigen::Lower>();
        for (int j = 0; j < 3; j++) {
            for (Sparse::InnerIterator q(full, j); q; ++q) {
                const bool is_read = q.row() == j || (q.row() > j) == (UpLo == Eigen::Lower);
                if (UpLo != (Eigen::Lower | Eigen::Upper) && !is_read) q.valueRef() = other;
            }
        }
        const M typed(full.cast<typename M::Scalar>());
        const V c = b.cast<typename M::Scalar>(), x = ours.compute(typed).solve(c);
        if (ours.info() != Eigen::Success || ours.analyses() != step + 1) return false;
        if (!(row_error(A, x.real().template cast<double>(), b) < 1e-14)) return false;
    }
    return true;
}

void triangles_and_types() {
    typedef Eigen::SparseMatrix<double, Eigen::RowMajor> Rows;
    typedef Eigen::SparseMatrix<std::complex<double>> Hermitian;
    const double garbage[] = {1e30, std::numeric_limits<double>::quiet_NaN()};
    for (double other : garbage) {
        CHECK((reads_one_triangle<Sparse, Eigen::Lower>(other)));
        CHECK((reads_one_triangle<Sparse, Eigen::Upper>(other)));
        CHECK((reads_one_triangle<Rows, Eigen::Lower>(other)));
        CHECK((reads_one_triangle<Rows, Eigen::Upper>(other)));
    }
    CHECK((reads_one_triangle<Sparse, Eigen::Lower | Eigen::Upper>(0)));
    CHECK((reads_one_triangle<Hermitian, Eigen::Lower>(1)));
    CHECK((reads_one_triangle<Hermitian, Eigen::Upper>(1)));
}

/* A fixed order that loses rows is given up, one that does not is kept. */
void orders_of_the_pattern() {
    typedef Eigen::SparseMatrix<std::complex<double>> Hermitian;
    sl::SimplicialLDLT<Sparse> ours(small_matrix(1e19, 1)), never;
    CHECK(ours.info() == Eigen::Success && error_of_ones(ours, small_matrix(1e19, 1)) < 1e-14);
    CHECK(ours.stats().symbolic.pairs == 1 && ours.analyses() == 2);
    never.setPivoted(false).compute(small_matrix(1e19, 1));
    CHECK(never.info() == Eigen::Success && never.analyses() == 1);
    const Sparse whole = small_matrix(1e19, 1).selfadjointView<Eigen::Lower>();
    const sl::SimplicialLDLT<Hermitian> hermitian(whole.cast<std::complex<double>>());
    const Vector b = some_vector(3);
    const Eigen::VectorXcd x = hermitian.solve(b.cast<std::complex<double>>());
    CHECK(row_error(small_matrix(1e19, 1), x.real(), b) < 1e-14);
    /* quasi-definite: pivots far apart, and no error */
    Sparse A(3, 3);
    A.setIdentity();
    A.coeffRef(0, 0) = 1e10;
    A.coeffRef(1, 1) = -1e-10;
    A.coeffRef(2, 0) = 1;
    CHECK(ours.compute(A).info() == Eigen::Success && ours.analyses() == 3);
    CHECK(ours.stats().symbolic.pairs == 0 && error_of_ones(ours, A) < 1e-14);
}

/* What new pivots do not mend is no success, and a negative limit checks nothing. */
void the_limit() {
    const Sparse first = small_matrix(0, 0.3), next = small_matrix(1e19, 1);
    const Vector b = some_vector(36);
    sl::SimplicialLDLT<Sparse> ours;
    ours.options().error_limit = 1e-300;
    ours.setPivoted().compute(check::grid_matrix(6));
    CHECK(ours.info() == Eigen::NumericalIssue && ours.status() == SL_ERR_INACCURATE);
    CHECK(ours.lastErrorMessage().find("options().error_limit") != std::string::npos);
    CHECK(ours.stats().error.row == -1 && ours.stats().error.value > 1e-300);
    CHECK(all_nan(Vector(ours.solve(b))) && ours.info() == Eigen::NumericalIssue);
    ours.options().error_limit = 0;
    CHECK(ours.compute(check::grid_matrix(6)).info() == Eigen::Success);
    CHECK(!all_nan(Vector(ours.solve(b))) && ours.lastErrorMessage().empty());
    ours.options().error_limit = -1;
    ours.compute(first);
    const int analyses = ours.analyses();
    CHECK(ours.factorize(next).info() == Eigen::Success && ours.analyses() == analyses);
    CHECK(error_of_ones(ours, next) > 0.1);
    /* after a null pivot, which remains the error */
    sl::SimplicialLDLT<Sparse> tried;
    tried.options().error_limit = 1e-300;
    tried.analyzePattern(first, Eigen::PermutationMatrix<Eigen::Dynamic>(Eigen::Vector3i(0, 1, 2)));
    CHECK(tried.factorize(first).status() == SL_ERR_PIVOT && tried.analyses() == 1);
    /* a regularized factor is that of another matrix */
    sl::SimplicialLDLT<Sparse> regular;
    regular.options().regularization = 1e-4;
    CHECK(regular.setPivoted().compute(small_matrix(-1, 1)).info() == Eigen::Success);
    CHECK(regular.stats().factor.regularized > 0 && regular.analyses() == 1);
}

void what_cannot_be_factored() {
    sl::SimplicialLDLT<Sparse> ours;
    ours.setPivoted();
    CHECK(ours.compute(Sparse()).info() == Eigen::Success);
    CHECK(ours.compute(Sparse(3, 3)).status() == SL_ERR_PIVOT);
    CHECK(ours.compute(Sparse(3, 2)).status() == SL_ERR_ARGUMENT);
    Sparse A = small_matrix(0, 0.5);
    A.valuePtr()[0] = std::numeric_limits<double>::infinity();
    CHECK(ours.compute(A).status() == SL_ERR_NOT_FINITE && ours.stats().error.row == 0);
    A = small_matrix(0, 0.5);
    A.innerIndexPtr()[1] = 7;
    CHECK(ours.compute(A).status() == SL_ERR_MALFORMED && ours.stats().error.row == 7);
}

// ---- sequences ----

/* KKT systems [D B'; B 0] with m variables and c constraints, rows in any order. */
class Kkt {
  public:
    Kkt(int m, int c, unsigned seed) : m_(m), c_(c), random_(seed) {
        order_.resize(std::size_t(m + c));
        for (int k = 0; k < m + c; k++)
            order_[std::size_t(k)] = k;
        for (std::size_t k = order_.size(); k > 1; k--)
            std::swap(order_[k - 1], order_[random_() % k]);
        for (int r = 0; r < c; r++) {
            for (int j = 0; j < m; j++) {
                if (j == r || unit() < 0.25) links_.emplace_back(m + r, j, 2 * unit() - 1);
            }
        }
    }
    int variables() const {
        return m_;
    }
    int constraints() const {
        return c_;
    }
    double unit() {
        return double(random_() >> 5) / double(1 << 27);
    }
    /* spread: links times 10^-spread to 10^spread */
    Sparse matrix(const Vector &diagonal, double spread = 0) {
        std::vector<Eigen::Triplet<double>> t;
        for (int k = 0; k < m_ + c_; k++)
            add(t, k, k, k < m_ ? diagonal[k] : 0.0);
        for (const Eigen::Triplet<double> &link : links_) {
            const double times = spread == 0 ? 1 : std::pow(10, spread * (2 * unit() - 1));
            add(t, link.row(), link.col(), link.value() * times);
        }
        Sparse out(m_ + c_, m_ + c_);
        out.setFromTriplets(t.begin(), t.end());
        return out;
    }

  private:
    void add(std::vector<Eigen::Triplet<double>> &t, int i, int j, double value) const {
        const int a = order_[std::size_t(i)], b = order_[std::size_t(j)];
        t.emplace_back(std::max(a, b), std::min(a, b), value);
    }
    int m_, c_;
    std::mt19937 random_;
    std::vector<int> order_;
    std::vector<Eigen::Triplet<double>> links_;
};

/* The backward error of a system whose solution is of the scales of A: where the diagonal is 1e19,
 * x is 3e-10. */
template <class Solver> double error_in_scale(const Solver &solver, const Sparse &A, Kkt &random) {
    const Sparse full = A.selfadjointView<Eigen::Lower>();
    Vector x(A.rows());
    for (Eigen::Index j = 0; j < A.rows(); j++) {
        double largest = 0;
        for (Sparse::InnerIterator q(full, j); q; ++q)
            largest = std::max(largest, std::fabs(q.value()));
        x[j] = (2 * random.unit() - 1) / std::sqrt(largest);
    }
    const Vector b = full * x;
    return row_error(A, solver.solve(b), b);
}

/* The diagonal of an interior-point method: 1 at first, but 0 for free variables; then it goes to
 * 1e19 for variables at their bounds, and to 1e-8 for the others. */
void interior_point() {
    int analyses = 0;
    for (unsigned seed = 0; seed < 40; seed++) {
        Kkt kkt(20, 8, seed);
        Vector rate(kkt.variables()), d(kkt.variables());
        for (int k = 0; k < kkt.variables(); k++)
            rate[k] = k % 3 == 0 ? -8 : 19 * kkt.unit();
        sl::SimplicialLDLT<Sparse> ours;
        ours.setPivoted();
        for (int step = 0; step <= 20; step++) {
            for (int k = 0; k < kkt.variables(); k++) {
                const bool is_free = k < kkt.constraints() && step == 0;
                d[k] = is_free ? 0 : std::pow(10, rate[k] * step / 20);
            }
            const Sparse A = kkt.matrix(d);
            CHECK(ours.compute(A).info() == Eigen::Success);
            CHECK(error_in_scale(ours, A, kkt) < 1e-8 && error_of_ones(ours, A) < 1e-8);
        }
        analyses += ours.analyses();
    }
    CHECK(analyses > 40 && analyses < 200); /* of 840 matrices */
}

/* Values of a pattern that have nothing in common: as good as with a new class. */
void random_values() {
    int count = 0, chosen_again = 0;
    for (unsigned seed = 0; seed < 1000; seed++) {
        Kkt kkt(2 + int(seed % 12), 1 + int(seed % 12) / 3, 1000 + seed);
        Vector before(kkt.variables()), d(kkt.variables());
        for (int k = 0; k < kkt.variables(); k++) {
            before[k] = k < kkt.constraints() ? 0 : kkt.unit();
            d[k] = std::pow(10, -8 + 27 * kkt.unit());
        }
        const Sparse first = kkt.matrix(before), A = kkt.matrix(d, seed % 2 ? 5 : 0);
        sl::SimplicialLDLT<Sparse> ours, fresh, by_default(A);
        CHECK(ours.setPivoted().compute(first).info() == Eigen::Success);
        ours.compute(A);
        fresh.setPivoted().compute(A);
        if (fresh.status() == SL_ERR_PIVOT) continue; /* singular to working precision */
        CHECK(ours.info() == Eigen::Success && fresh.info() == Eigen::Success);
        CHECK(error_in_scale(fresh, A, kkt) < 1e-10);
        CHECK(error_in_scale(ours, A, kkt) < 1e-7);
        CHECK(by_default.info() == Eigen::Success && error_in_scale(by_default, A, kkt) < 1e-6);
        chosen_again += ours.analyses() > 1;
        count++;
    }
    CHECK(count > 990 && chosen_again > 300 && chosen_again < 900);
}

} // namespace

int main() {
    return check::run({{"values_that_grow_are_noticed", values_that_grow_are_noticed},
                       {"triangles_and_types", triangles_and_types},
                       {"orders_of_the_pattern", orders_of_the_pattern},
                       {"the_limit", the_limit},
                       {"what_cannot_be_factored", what_cannot_be_factored},
                       {"interior_point", interior_point},
                       {"random_values", random_values}});
}

/* sparse_local_eigen.hpp: sparse_local.h as a sparse solver of Eigen, local solves on its vectors
 *
 *     #include "sparse_local_eigen.hpp"
 *
 *     sl::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(A);     as Eigen::SimplicialLDLT
 *     if (solver.info() != Eigen::Success) ...
 *     x = solver.solve(b);
 *     y = solver.solve(bset, B, xset);                  b on a few rows, x wanted on a few others
 *
 * SimplicialLDLT, SimplicialLLT and SimplicialCholesky of namespace sl take the place of Eigen's
 * classes of these names, and sl::CholmodSupernodalLLT that of Eigen::CholmodSupernodalLLT: the
 * same template arguments and members. One source file of the program defines SL_WITH_ALL and
 * SPARSE_LOCAL_IMPLEMENTATION and includes sparse_local.h, or the program is linked with the
 * compiled library.
 *
 * Matrices    any Eigen::SparseMatrix of float, double or std::complex of these, column- or
 *             row-major, with Lower, Upper or both (Lower | Upper), also unsorted or uncompressed.
 *             A compressed matrix of double with int indices is used in place. Others are
 *             converted; all arithmetic is in double. Complex matrices are Hermitian. Right-hand
 *             sides are dense or sparse, of any of these types; complex ones of a real matrix are
 *             solved as two real ones.
 * Ordering    the third template argument may be Eigen::NaturalOrdering or a class of the caller.
 *             AMDOrdering, COLAMDOrdering and MetisOrdering mean the library's own. It minimizes
 *             the time to the first solution (SL_PURPOSE_ONE_FACTOR), as Eigen's users expect.
 *             LocalLDLT and LocalLLT are the same classes with the order for many local solves.
 * Errors      no exceptions: info() is NumericalIssue for a null pivot, pivot growth, a NaN or an
 *             infinity, and for a negative pivot in SimplicialLLT; InvalidInput for all other
 *             errors. lastErrorMessage() says what is wrong and what helps; status() and stats()
 *             are the library's own. A solve that fails sets info() and fills its result with NaN.
 * Indefinite  SimplicialLDLT keeps the order of the pattern. If a pivot is null or L grows, it
 *             chooses 1x1 and 2x2 pivots by the values, as KKT systems [Q A'; A 0] need
 *             (setPivoted). Factorizations with such pivots, and with pivots of both signs of which
 *             one is 1e14 times another, are checked by a solve.
 * Singular    a singular semidefinite matrix, such as the Laplacian of a closed mesh, has one null
 *             pivot in each connected component. The classes with Eigen's names skip them: x is 0
 *             in their rows, stats().factor.null counts them, and a b without a solution makes
 *             info() NumericalIssue. LocalLDLT and LocalLLT refuse singular matrices
 *             (setNullPivots). setZeroMean() gives the solution with mean zero.
 *             Inverse iteration at a shift that is an eigenvalue, as 0 for a free body, needs
 *             options().null_tolerance = -1, setNullPivots(false) and setPivoted(false): as with
 *             Eigen's class, a pivot that is only rounding errors is then used.
 * Other differences from Eigen's classes:
 *             - factorize with another pattern than that of analyzePattern analyzes it, and compute
 *               with the pattern of the last analysis does not analyze it again; analyses() counts.
 *               Plans and regions of an older analysis are then refused.
 *             - matrixL() contains the entries of L that are not exactly 0.
 * Threads     const calls may run at once. info() and status() are those of the last call that
 *             ended.
 */
#ifndef SPARSE_LOCAL_EIGEN_HPP
#define SPARSE_LOCAL_EIGEN_HPP

#ifndef SL_WITH_ALL /* the classes use all packs */
#define SL_WITH_ALL
#endif
#include "sparse_local.h"

#include <Eigen/SparseCore>
#include <Eigen/OrderingMethods>
#include <Eigen/SparseCholesky>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <complex>
#include <functional>
#include <initializer_list>
#include <limits>
#include <memory>
#include <mutex>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace Eigen {
template <typename StorageIndex> class MetisOrdering;
}

namespace sl {

/** A set of rows for local calls: a vector of Eigen or a std::vector of integers, or all(). */
class RowSet {
  public:
    RowSet() : all_(false) {
    }
    template <class Derived> RowSet(const Eigen::DenseBase<Derived> &rows) : all_(false) {
        static_assert(std::numeric_limits<typename Derived::Scalar>::is_integer,
                      "a set of rows contains integers");
        for (Eigen::Index c = 0; c < rows.cols(); c++) {
            for (Eigen::Index r = 0; r < rows.rows(); r++)
                add(rows.derived().coeff(r, c));
        }
    }
    template <class Integer> RowSet(const std::vector<Integer> &rows) : all_(false) {
        for (Integer row : rows)
            add(row);
    }
    RowSet(std::initializer_list<int> rows) : all_(false) {
        for (int row : rows)
            add(row);
    }
    static RowSet all() {
        RowSet every;
        every.all_ = true;
        return every;
    }

    /* NULL for all rows; an empty set is a pointer that is not NULL. */
    const sl_int *data() const {
        static const sl_int nothing = 0;
        return all_ ? nullptr : rows_.empty() ? &nothing : rows_.data();
    }
    /* A count that does not fit becomes -2, which every call refuses. */
    sl_int count() const {
        return all_ ? SL_ALL : rows_.size() > INT32_MAX ? -2 : sl_int(rows_.size());
    }
    Eigen::Index size(Eigen::Index n) const {
        return all_ ? n : Eigen::Index(rows_.size());
    }
    /* The rows of the real system of a complex one: the real and the imaginary part of each, or the
     * real part. Of all rows, all; the real parts alone only of n rows. */
    RowSet of_complex() const {
        RowSet both;
        both.all_ = all_;
        for (sl_int row : rows_) {
            both.add(2 * static_cast<long long>(row));
            both.add(2 * static_cast<long long>(row) + 1);
        }
        return both;
    }
    RowSet real_parts(Eigen::Index n) const {
        RowSet real;
        for (Eigen::Index k = 0; k < size(n); k++) {
            real.add(2 * static_cast<long long>(all_ ? k : rows_[std::size_t(k)]));
        }
        return real;
    }

  private:
    /* A row that does not fit becomes -1, which is out of range as the row is. */
    template <class Integer> void add(Integer row) {
        const long long wide = static_cast<long long>(row);
        rows_.push_back(wide >= 0 && wide <= INT32_MAX ? sl_int(wide) : -1);
    }
    bool all_;
    std::vector<sl_int> rows_;
};

namespace internal {

/* The arrays of a sparse matrix of Eigen as an sl_csc: in place, or converted to arrays of its own.
 * A row-major matrix is seen as its transpose, so that its triangles change places. */
class MatrixArrays {
  public:
    template <class MatrixType>
    MatrixArrays(const MatrixType &A, int, double offset, double scale) : status_(SL_OK) {
        typedef typename MatrixType::Scalar Scalar;
        typedef typename MatrixType::StorageIndex Index;
        view_ = sl_csc();
        if (A.rows() > INT32_MAX - 8 || A.cols() > INT32_MAX - 8 || A.nonZeros() > INT32_MAX) {
            status_ = SL_ERR_TOO_LARGE;
            return;
        }
        view_.n_rows = sl_int(A.innerSize());
        view_.n_cols = sl_int(A.outerSize());
        if (A.outerIndexPtr() && A.isCompressed() && A.outerIndexPtr()[0] == 0) {
            use(A, std::integral_constant < int,
                std::is_same<Index, sl_int>::value         ? 32
                : std::is_same<Index, std::int64_t>::value ? 64
                                                           : 0 > (),
                std::integral_constant<bool, std::is_same<Scalar, double>::value>());
        } else {
            compress(A);
        }
        if (!view_.i) view_.i = &nothing_index();
        if (!view_.x) view_.x = &nothing_value();
        shift_diagonal(offset, scale);
    }
    const sl_csc &view() const {
        return view_;
    }
    sl_status status() const {
        return status_;
    }

  private:
    /* Changes each diagonal entry d to offset + scale d, in a copy. The first entry of a repeated
     * one takes the offset. */
    void shift_diagonal(double offset, double scale) {
        if (status_ != SL_OK || (offset == 0 && scale == 1)) return;
        status_ = sl_csc_check(&view_, nullptr);
        if (status_ != SL_OK) return;
        std::vector<double> shifted(view_.x, view_.x + view_.p[view_.n_cols]);
        for (sl_int j = 0; j < view_.n_cols; j++) {
            bool is_first = true;
            for (sl_int p = view_.p[j]; p < view_.p[j + 1]; p++) {
                if (view_.i[p] != j) continue;
                shifted[std::size_t(p)] = (is_first ? offset : 0) + scale * view_.x[p];
                is_first = false;
            }
            /* A diagonal entry that is not stored cannot be shifted. */
            if (is_first && offset != 0) status_ = SL_ERR_MALFORMED;
        }
        x_.swap(shifted);
        if (!x_.empty()) view_.x = x_.data();
    }

    static const sl_int &nothing_index() {
        static const sl_int nothing = 0;
        return nothing;
    }
    static const double &nothing_value() {
        static const double nothing = 0;
        return nothing;
    }

    typedef std::integral_constant<int, 32> Narrow;
    typedef std::integral_constant<int, 64> Wide;

    template <class M> void use(const M &A, Narrow, std::true_type) {
        view_.p = A.outerIndexPtr();
        view_.i = A.innerIndexPtr();
        view_.x = A.valuePtr();
    }
    template <class M> void use(const M &A, Narrow, std::false_type) {
        view_.p = A.outerIndexPtr();
        view_.i = A.innerIndexPtr();
        x_.assign(A.valuePtr(), A.valuePtr() + A.nonZeros());
        view_.x = x_.data();
    }
    /* Indices are converted by the library, and values used in place. */
    template <class M> void use(const M &A, Wide, std::true_type) {
        sl_matrix *made = nullptr;
        const sl_csc64 wide = {view_.n_rows, view_.n_cols, A.outerIndexPtr(), A.innerIndexPtr(),
                               nullptr};
        status_ = sl_matrix_from_csc64(&made, &wide, nullptr, nullptr);
        converted_ = std::shared_ptr<sl_matrix>(made, sl_matrix_free);
        view_ = sl_matrix_view(made);
        view_.x = A.valuePtr();
    }
    template <class M, class Width, class Any> void use(const M &A, Width, Any) {
        compress(A);
    }

    template <class M> void compress(const M &A) {
        typedef typename M::InnerIterator Iterator;
        p_.reserve(std::size_t(A.outerSize()) + 1);
        i_.reserve(std::size_t(A.nonZeros()));
        x_.reserve(std::size_t(A.nonZeros()));
        p_.push_back(0);
        for (Eigen::Index j = 0; j < A.outerSize(); j++) {
            for (Iterator entry(A, j); entry; ++entry) {
                bool fits = entry.index() >= 0 && entry.index() <= INT32_MAX;
                i_.push_back(fits ? sl_int(entry.index()) : -1);
                x_.push_back(double(entry.value()));
            }
            p_.push_back(sl_int(i_.size()));
        }
        view_.p = p_.data();
        view_.i = i_.data();
        view_.x = x_.data();
    }

    sl_csc view_;
    sl_status status_;
    std::shared_ptr<sl_matrix> converted_;
    std::vector<sl_int> p_, i_;
    std::vector<double> x_;
};

/* The real matrix of a complex Hermitian one, from the triangle that is read. */
class HermitianArrays {
  public:
    template <class MatrixType>
    HermitianArrays(const MatrixType &A, int triangle, double offset, double scale)
        : status_(SL_OK), view_(sl_csc()) {
        if (A.rows() != A.cols()) {
            status_ = SL_ERR_ARGUMENT;
        } else if (A.rows() >= (1 << 30) - 4 || A.nonZeros() > INT32_MAX / 4) {
            status_ = SL_ERR_TOO_LARGE;
        } else {
            copy(A, triangle, offset, scale);
        }
    }
    const sl_csc &view() const {
        return view_;
    }
    sl_status status() const {
        return status_;
    }

  private:
    /* A row-major matrix is seen as its transpose, whose entries are conjugate. Imaginary parts on
     * the diagonal are ignored. */
    template <class M> void copy(const M &A, int triangle, double offset, double scale) {
        std::vector<sl_int> p(1, 0), i;
        std::vector<double> x;
        bool is_other = false, has_off_diagonal = false;
        for (Eigen::Index j = 0; j < A.outerSize(); j++) {
            bool is_first = true;
            for (typename M::InnerIterator entry(A, j); entry; ++entry) {
                const bool is_diagonal = entry.index() == j;
                const int side = entry.row() > entry.col() ? Eigen::Lower : Eigen::Upper;
                if (!is_diagonal && (triangle & side) == 0) {
                    is_other = true;
                    continue;
                }
                const double re = double(entry.value().real()), im = double(entry.value().imag());
                i.push_back(entry.index() >= 0 && entry.index() < A.rows() ? sl_int(entry.index())
                                                                           : -1);
                x.push_back(is_diagonal ? (is_first ? offset : 0) + scale * re : re);
                x.push_back(is_diagonal ? 0 : M::IsRowMajor ? -im : im);
                is_first = is_first && !is_diagonal;
                has_off_diagonal = has_off_diagonal || !is_diagonal;
            }
            if (is_first && offset != 0) status_ = SL_ERR_MALFORMED;
            p.push_back(sl_int(i.size()));
        }
        /* only the other triangle is stored: what is read would be a diagonal matrix */
        if (is_other && !has_off_diagonal) status_ = SL_ERR_MALFORMED;
        if (i.empty()) {
            i.push_back(0);
            x.push_back(0);
        }
        if (status_ == SL_OK) convert(sl_int(A.rows()), p, i, x);
    }
    void convert(sl_int n, const std::vector<sl_int> &p, const std::vector<sl_int> &i,
                 const std::vector<double> &x) {
        const sl_hermitian H = {n, p.data(), i.data(), x.data(), nullptr};
        sl_matrix *made = nullptr;
        status_ = sl_matrix_from_hermitian(&made, &H, nullptr, nullptr);
        converted_ = std::shared_ptr<sl_matrix>(made, sl_matrix_free);
        if (status_ == SL_OK) view_ = sl_matrix_view(made);
    }

    sl_status status_;
    sl_csc view_;
    std::shared_ptr<sl_matrix> converted_;
};

inline bool is_read(sl_triangle triangle, sl_int i, sl_int j) {
    return triangle == SL_TRIANGLE_UPPER ? i <= j : i >= j;
}

/* Powers of two s for which the largest entry of each row of S A S is near 1. [Ruiz01]: D. Ruiz, A
 * scaling algorithm to equilibrate both rows and columns norms in matrices, RAL-TR-2001-034; it
 * takes the square root of what is left in each round. */
inline std::vector<double> row_scales(const sl_csc &A, sl_triangle triangle) {
    const std::size_t n = std::size_t(A.n_cols);
    std::vector<double> s(n, 1.0), largest(n);
    bool is_even = false;
    for (int round = 0; round < 4 && !is_even; round++) {
        std::fill(largest.begin(), largest.end(), 0.0);
        for (sl_int j = 0; j < A.n_cols; j++) {
            for (sl_int p = A.p[j]; p < A.p[j + 1]; p++) {
                const std::size_t row = std::size_t(A.i[p]), column = std::size_t(j);
                if (!is_read(triangle, A.i[p], j)) continue;
                const double size = std::fabs(A.x[p]) * (s[row] * s[column]);
                if (size > largest[column]) largest[column] = size;
                if (size > largest[row]) largest[row] = size;
            }
        }
        is_even = true;
        for (std::size_t k = 0; k < n; k++) {
            int exponent = 0; /* rows of zeros and infinities stay as they are */
            if (largest[k] <= std::numeric_limits<double>::max()) std::frexp(largest[k], &exponent);
            exponent = exponent >= 0 ? -(exponent / 2) : (1 - exponent) / 2;
            const double next = std::ldexp(s[k], exponent);
            if (exponent == 0 || next < 1e-150 || next > 1e150) continue; /* products are finite */
            is_even = false;
            s[k] = next;
        }
    }
    return s;
}

/* Lends one workspace to one call at a time, so that repeated calls of one thread allocate nothing.
 * A call that finds it lent works with a new one. */
class WorkSlot {
  public:
    WorkSlot() : kept_(nullptr) {
    }
    ~WorkSlot() {
        sl_work_free(kept_.load());
    }
    sl_work *take() {
        sl_work *work = kept_.exchange(nullptr);
        if (!work && sl_work_create(&work, nullptr) != SL_OK) return nullptr;
        return work;
    }
    void give_back(sl_work *work) {
        sl_work_free(kept_.exchange(work));
    }

  private:
    WorkSlot(const WorkSlot &);
    WorkSlot &operator=(const WorkSlot &);
    std::atomic<sl_work *> kept_;
};

class LentWork {
  public:
    explicit LentWork(WorkSlot &slot) : slot_(slot), work_(slot.take()) {
    }
    ~LentWork() {
        slot_.give_back(work_);
    }
    sl_work *get() const {
        return work_;
    }

  private:
    LentWork(const LentWork &);
    LentWork &operator=(const LentWork &);
    WorkSlot &slot_;
    sl_work *work_;
};

/* A region and the factor that it borrows. */
struct RegionHolder {
    RegionHolder(sl_region *made, const std::shared_ptr<sl_factor> &F) : factor(F), region(made) {
    }
    ~RegionHolder() {
        sl_region_free(region);
    }
    std::shared_ptr<sl_factor> factor;
    sl_region *region;

  private:
    RegionHolder(const RegionHolder &);
    RegionHolder &operator=(const RegionHolder &);
};

/* What a matrix of Scalar needs. unit: rows of the real system for each row. */
template <class Scalar> struct Numbers {
    static_assert(!std::is_same<Scalar, long double>::value,
                  "sparse_local computes in double: for long double use the classes of Eigen");
    static_assert(std::is_same<Scalar, float>::value || std::is_same<Scalar, double>::value ||
                      std::is_same<Scalar, long double>::value,
                  "the matrix must be of float, double or std::complex of these");
    typedef double Wide;
    typedef MatrixArrays Arrays;
    enum { unit = 1 };
};
template <class Real> struct Numbers<std::complex<Real>> {
    static_assert(!std::is_same<Real, long double>::value,
                  "sparse_local computes in double: for long double use the classes of Eigen");
    typedef std::complex<double> Wide;
    typedef HermitianArrays Arrays;
    enum { unit = 2 };
};

/* Orders of Eigen that mean the library's own; those of other classes are the caller's. */
template <class Ordering> struct is_own_order : std::false_type {};
template <class Index> struct is_own_order<Eigen::AMDOrdering<Index>> : std::true_type {};
template <class Index> struct is_own_order<Eigen::COLAMDOrdering<Index>> : std::true_type {};
template <class Index> struct is_own_order<Eigen::MetisOrdering<Index>> : std::true_type {};
template <class Ordering> struct is_natural_order : std::false_type {};
template <class Index> struct is_natural_order<Eigen::NaturalOrdering<Index>> : std::true_type {};

/* The template arguments of a solver, as its base class needs them, and its views of L. */
template <class Solver> struct SolverTraits;

template <class MatrixType_, int UpLo_, class Ordering_, int LowerMode, int UpperMode>
struct MatrixTraits {
    typedef MatrixType_ MatrixType;
    typedef Ordering_ OrderingType;
    typedef typename MatrixType::Scalar Scalar;
    typedef typename MatrixType::StorageIndex StorageIndex;
    typedef Eigen::SparseMatrix<Scalar, Eigen::ColMajor, StorageIndex> CholMatrixType;
    typedef Eigen::TriangularView<const CholMatrixType, LowerMode> MatrixL;
    typedef Eigen::TriangularView<const typename CholMatrixType::AdjointReturnType, UpperMode>
        MatrixU;
    enum { UpLo = UpLo_ };
};

} // namespace internal

template <class Solver> class BasicSolver;

/** The region of a set of rows, from BasicSolver::region. Copies share it. Empty after an error. */
class LocalRegion {
  public:
    explicit operator bool() const {
        return bool(holder_);
    }
    sl_region_info stats() const {
        return sl_region_view(holder_ ? holder_->region : nullptr).info;
    }

  private:
    template <class> friend class BasicSolver;
    sl_region *get() const {
        return holder_ ? holder_->region : nullptr;
    }
    std::shared_ptr<internal::RegionHolder> holder_;
};

/** A prepared local solve, from BasicSolver::plan. Copies share it. Empty after an error. */
class LocalPlan {
  public:
    LocalPlan() : nb_(0), nx_(0) {
    }
    explicit operator bool() const {
        return bool(plan_);
    }
    /** Rows of the b-set and of the x-set. */
    Eigen::Index nb() const {
        return nb_;
    }
    Eigen::Index nx() const {
        return nx_;
    }
    sl_plan_info stats() const {
        sl_stats stats = sl_stats();
        if (plan_) sl_plan_stats(plan_.get(), &stats);
        return stats.plan;
    }

  private:
    template <class> friend class BasicSolver;
    std::shared_ptr<sl_plan> plan_;
    Eigen::Index nb_, nx_;
};

/** What the solvers below share. Solver is one of them. */
template <class Solver> class BasicSolver : public Eigen::SparseSolverBase<Solver> {
    typedef Eigen::SparseSolverBase<Solver> Base;
    typedef internal::SolverTraits<Solver> Traits;

  public:
    typedef typename Traits::MatrixType MatrixType;
    typedef typename Traits::OrderingType OrderingType;
    typedef typename MatrixType::Scalar Scalar;
    typedef typename MatrixType::RealScalar RealScalar;
    typedef typename MatrixType::StorageIndex StorageIndex;
    typedef typename Traits::CholMatrixType CholMatrixType;
    typedef CholMatrixType const *ConstCholMatrixPtr;
    typedef Eigen::Matrix<Scalar, Eigen::Dynamic, 1> VectorType;
    typedef Eigen::Matrix<StorageIndex, Eigen::Dynamic, 1> VectorI;
    typedef Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, StorageIndex> Permutation;
    /** Results of local calls: of double or std::complex<double>. */
    typedef typename internal::Numbers<Scalar>::Wide Wide;
    typedef Eigen::Matrix<Wide, Eigen::Dynamic, Eigen::Dynamic> Dense;
    enum {
        UpLo = Traits::UpLo,
        ColsAtCompileTime = MatrixType::ColsAtCompileTime,
        MaxColsAtCompileTime = MatrixType::MaxColsAtCompileTime
    };
    using Base::derived;

    Eigen::Index rows() const {
        return n_;
    }
    Eigen::Index cols() const {
        return n_;
    }

    /** Options of the next analysis and factorization. Arrays that they point to are borrowed. */
    sl_options &options() {
        options_changed_ = true;
        return options_;
    }
    /** The diagonal of the factored matrices becomes offset + scale * diagonal, from now on. */
    Solver &setShift(double offset, double scale = 1) {
        shift_offset_ = offset;
        shift_scale_ = scale;
        return derived();
    }
    /** true: from the next analysis on, 1x1 and 2x2 pivots are chosen by the values of the matrix;
     *  false: never. Without this call, SimplicialLDLT chooses them after a null pivot, pivot
     *  growth or a failed check. Other values of a pattern keep them, and if these do not suit, are
     *  analyzed again. The check is the componentwise backward error of one solve,
     *  stats().refine.backward_error. It fails above options().error_limit, by default 1e-10, or
     *  1e-8 where the order is that of the pattern; negative: there is no check. If it still fails
     *  with the new pivots, info() is NumericalIssue.
     *  With 2x2 pivots vectorD() has the eigenvalues of D, and entries of the inverse and regions
     *  are refused (sl_symbolic_create_pivoted). */
    Solver &setPivoted(bool on = true) {
        const Pivoting wanted = on ? pivoted_always : pivoted_never;
        if (wanted != pivoting_) forget();
        pivoting_ = wanted;
        return derived();
    }
    /** Whether null pivots of singular semidefinite matrices are skipped, from the next
     *  factorization on, so that x is 0 in their rows: true but in LocalLDLT and LocalLLT. */
    Solver &setNullPivots(bool are_skipped) {
        skips_nulls_ = are_skipped;
        options_changed_ = true;
        return derived();
    }
    /** Singular semidefinite matrices, such as Laplacians, are accepted from the next factorization
     *  on: null pivots are skipped, b is made consistent, and the solution is the one with mean
     *  zero in each connected component, or with sum m x = 0 for the weights m = options().mass. */
    Solver &setZeroMean(bool on = true) {
        is_zero_mean_ = on;
        options_changed_ = true;
        return derived();
    }

    /** Analyzes the pattern of A; with setPivoted() also its values. */
    Solver &analyzePattern(const MatrixType &A) {
        has_order_ = false;
        analyze_only(A);
        return derived();
    }
    /** The same with an order of the caller: row order.indices()[k] of A is pivot k, as in what the
     *  orderings of Eigen compute. */
    Solver &analyzePattern(const MatrixType &A, const Permutation &order) {
        keep_order(order);
        analyze_only(A);
        return derived();
    }
    /** Factors A, which has the analyzed pattern; another one is analyzed. */
    Solver &factorize(const MatrixType &A) {
        const Arrays arrays(A, int(UpLo), shift_offset_, shift_scale_);
        sl_status status = arrays.status();
        stats_.error = sl_error();
        stats_.error.row = stats_.error.column = -1;
        /* the order of analyzePattern is that of matrices of this size */
        if (has_order_ && order_.size() != std::size_t(A.cols()) * unit) has_order_ = false;
        if (status == SL_OK) status = factor_any(A, arrays.view());
        if (status != SL_OK && status != SL_ERR_PIVOT && status != SL_ERR_NOT_FINITE) {
            factor_.reset();
        }
        has_lower_ = false;
        report(status, A.rows());
        return derived();
    }
    /** Both. */
    Solver &compute(const MatrixType &A) {
        return factorize(A);
    }

    Eigen::ComputationInfo info() const {
        eigen_assert(this->m_isInitialized && "info: call compute, or analyzePattern, first");
        switch (status_.load()) {
        case SL_OK:
            return Eigen::Success;
        case SL_ERR_PIVOT:
        case SL_ERR_NOT_FINITE:
        case SL_ERR_INCONSISTENT:
        case SL_ERR_INACCURATE:
            return Eigen::NumericalIssue;
        default:
            return Eigen::InvalidInput;
        }
    }
    /** The status behind info(). */
    sl_status status() const {
        return sl_status(status_.load());
    }
    /** What is wrong and what helps; empty after a success. */
    std::string lastErrorMessage() const {
        const std::lock_guard<std::mutex> lock(message_mutex_);
        return status() == SL_OK ? std::string() : message_;
    }
    /** What the last analysis or factorization reported: the row of an error, counts, times. Counts
     *  are those of the real system, whose rows are twice those of a complex one. */
    const sl_stats &stats() const {
        return stats_;
    }
    /** How often a pattern was analyzed. */
    int analyses() const {
        return analyses_;
    }
    /** Writes what the objects occupy. */
    template <class Stream> void dumpMemory(Stream &s) const {
        const std::size_t of_order = std::size_t(m_P.size()) * 3 * sizeof(StorageIndex);
        const std::size_t of_lower = std::size_t(lower_.nonZeros()) * sizeof(Scalar);
        const std::size_t of_analysis = symbolic_ ? stats_.symbolic.bytes : 0;
        const std::size_t of_factor = factor_ ? stats_.factor.bytes : 0;
        s << "  analysis: " << (of_analysis >> 20) << "Mb\n";
        s << "  factor:   " << (of_factor >> 20) << "Mb\n";
        s << "  matrixL:  " << (of_lower >> 20) << "Mb\n";
        s << "  perm:     " << (of_order >> 20) << "Mb\n";
        s << "  TOTAL:    " << ((of_analysis + of_factor + of_lower + of_order) >> 20) << "Mb\n";
    }

    // ---- solves ----

    using Base::solve;

    /** x on xset for b on bset: bset.size() x nrhs numbers B, xset.size() x nrhs of the result. */
    template <class Rhs>
    Dense solve(const RowSet &bset, const Eigen::MatrixBase<Rhs> &B, const RowSet &xset) const {
        return solve_sets(bset, B.template cast<Wide>(), xset);
    }
    /** The same on a plan, whose sets are the rows of B and of the result. */
    template <class Rhs> Dense solve(const LocalPlan &plan, const Eigen::MatrixBase<Rhs> &B) const {
        const Dense b = B.template cast<Wide>();
        return local(plan.nb_ == b.rows(), plan.nx_, b, [&](Dense &x, sl_work *work) {
            return sl_plan_solve(plan.plan_.get(), factor_.get(), data(x), stride(x), data(b),
                                 stride(b), columns(b), work);
        });
    }
    /** A half or another part of a solve; parts is a sum of SL_PART_... For SimplicialLDLT,
     *  permutationP() b is solvePart(SL_PART_P, b), matrixL().solve(b) solvePart(SL_PART_L, b),
     *  matrixU().solve(b) solvePart(SL_PART_LT, b). The L of SimplicialLLT: SL_PART_L + SQRT_D.
     *  Quicker than the views, and with 2x2 pivots the only way to apply D. */
    template <class Rhs> Dense solvePart(unsigned parts, const Eigen::MatrixBase<Rhs> &B) const {
        const auto whole = [](const sl_factor *F, unsigned bits, double *X, std::size_t ldx,
                              const double *from, std::size_t ldb, sl_int count, sl_work *W) {
            return sl_factor_solve_part(F, nullptr, bits, X, ldx, from, ldb, count, W);
        };
        return part(whole, parts, B.template cast<Wide>());
    }
    /** The product with the same parts: matrixL() b is multiplyPart(SL_PART_L, b). */
    template <class Rhs> Dense multiplyPart(unsigned parts, const Eigen::MatrixBase<Rhs> &B) const {
        return part(sl_factor_multiply_part, parts, B.template cast<Wide>());
    }
    /** Prepares local solves; the plan is valid for every later factorization of the pattern. */
    LocalPlan plan(const RowSet &bset, const RowSet &xset) const {
        return plan(bset, xset, LocalRegion());
    }
    /** Prepares local solves that stay in a region if both sets are inside it. */
    LocalPlan plan(const RowSet &bset, const RowSet &xset, const LocalRegion &region) const {
        LocalPlan out;
        sl_plan *made = nullptr;
        sl_options with_region;
        const RowSet &b = real_rows(bset, is_complex()), &x = real_rows(xset, is_complex());
        sl_options_init(&with_region, sizeof with_region);
        with_region.region = region.get();
        set_status(sl_plan_create(&made, symbolic_.get(), b.data(), b.count(), x.data(), x.count(),
                                  &with_region, nullptr));
        if (!made) return out;
        /* the deleter keeps what the plan borrows */
        const std::shared_ptr<sl_symbolic> symbolic = symbolic_;
        out.plan_.reset(made, [symbolic, region](sl_plan *plan) { sl_plan_free(plan); });
        out.nb_ = bset.size(n_);
        out.nx_ = xset.size(n_);
        return out;
    }
    /** The region of a set of rows. After another factorization call refactor(region). */
    LocalRegion region(const RowSet &set) const {
        LocalRegion out;
        sl_region *made = nullptr;
        const RowSet &rows = real_rows(set, is_complex());
        set_status(ready_ ? ready_
                          : sl_region_create(&made, factor_.get(), rows.data(), rows.count(),
                                             nullptr, nullptr, nullptr));
        if (!made) return out;
        out.holder_ = std::make_shared<internal::RegionHolder>(made, factor_);
        return out;
    }
    /** Computes a region again from the present unit; its plans stay valid. */
    bool refactor(LocalRegion &region) const {
        internal::LentWork work(work_);
        sl_status status = sl_region_refactor(region.get(), factor_.get(), nullptr, work.get());
        set_status(status);
        if (status == SL_OK) region.holder_->factor = factor_;
        return status == SL_OK;
    }

    // ---- the inverse, the determinant, the condition ----

    /** Diagonal entries of the inverse, in the order of rows; without argument all. */
    Eigen::VectorXd inverseDiagonal(const RowSet &rows = RowSet::all()) const {
        const RowSet &real = diagonal_rows(rows, is_complex());
        Eigen::VectorXd out(rows.size(n_));
        double nothing = 0;
        internal::LentWork work(work_);
        const sl_status status =
            ready_ ? ready_
                   : sl_inverse_diagonal(factor_.get(), out.size() ? out.data() : &nothing,
                                         real.data(), real.count(), work.get(), nullptr);
        set_status(status);
        if (status != SL_OK) out.setConstant(nan<double>());
        return out;
    }
    /** log |det A|. */
    double logAbsDeterminant() const {
        return logdet().first;
    }
    /** log det A; NaN if det A is negative. */
    double logDeterminant() const {
        return logdet().second > 0 ? logdet().first : nan<double>();
    }
    /** 1 or -1. */
    double signDeterminant() const {
        return logdet().second;
    }
    /** 0 if null pivots were skipped; the logarithms are then of the matrix without their rows. */
    Scalar determinant() const {
        if (ready_ == SL_OK && sl_factor_view(factor_.get()).info.null > 0) return Scalar(0);
        return Scalar(RealScalar(logdet().second * std::exp(logdet().first)));
    }
    /** An estimate of 1 / (||A|| ||A^-1||) in the one-norm, of a complex matrix that of the real
     *  system; A is the matrix that was factored. */
    double rcond(const MatrixType &A) const {
        double out = nan<double>();
        const Arrays arrays(A, int(UpLo), shift_offset_, shift_scale_);
        internal::LentWork work(work_);
        sl_status status = ready_ ? ready_ : arrays.status();
        if (status == SL_OK) {
            status = sl_factor_rcond(factor_.get(), &arrays.view(), &out, work.get());
        }
        set_status(status);
        return out;
    }

    // ---- the factors: P A P^-1 = L D L' ----

    /** P as in Eigen's solvers: row i of A is pivot indices()[i]. Empty before an analysis, and for
     *  complex matrices with 2x2 pivots, whose real and imaginary parts are ordered apart. */
    const Permutation &permutationP() const {
        return m_P;
    }
    const Permutation &permutationPinv() const {
        return m_Pinv;
    }
    /** D of SimplicialLDLT; the squared diagonal of L of SimplicialLLT. A skipped null pivot is 0.
     *  A 2x2 pivot gives its two eigenvalues: the signs are the inertia of the matrix. */
    VectorType vectorD() const {
        if (ready_ != SL_OK) return VectorType();
        const sl_factor_arrays view = sl_factor_view(factor_.get());
        std::vector<double> d(view.D, view.D + n_ * unit);
        for (double &pivot : d)
            if (pivot == std::numeric_limits<double>::max()) pivot = 0;
        if (view.E) use_eigenvalues(d, view.E);
        /* real and imaginary parts have pivots of their own with 2x2 pivots, else the same */
        if (view.E && unit == 2) std::sort(d.begin(), d.end());
        VectorType out(n_);
        for (Eigen::Index k = 0; k < n_; k++)
            out[k] = Scalar(RealScalar(d[std::size_t(k) * unit]));
        return out;
    }

    // ---- what Eigen calls ----

    template <class Rhs, class Dest>
    void _solve_impl(const Eigen::MatrixBase<Rhs> &b, Eigen::MatrixBase<Dest> &dest) const {
        sl_status status = ready_;
        if (status == SL_OK && b.rows() != n_) status = wrong_size();
        if (status == SL_OK) status = solve_dense(b.derived(), dest.derived(), IsSplit<Rhs>());
        set_status(status);
        if (status != SL_OK) dest.setConstant(nan<typename Dest::Scalar>());
    }

    /* Sparse right-hand sides, 8 at a time: the forward sweep visits what the rows of b reach. */
    template <class Rhs, class Dest>
    void _solve_impl(const Eigen::SparseMatrixBase<Rhs> &b,
                     Eigen::SparseMatrixBase<Dest> &dest) const {
        typedef Eigen::SparseMatrix<typename Dest::Scalar, Eigen::ColMajor, Eigen::Index> Result;
        Result X(n_, b.cols());
        const sl_status status =
            b.rows() == n_ ? solve_sparse(b.derived(), X, IsSplit<Rhs>()) : wrong_size();
        set_status(ready_ ? ready_ : status);
        assign(dest.derived(), X, std::integral_constant<bool, Dest::ColsAtCompileTime == 1>());
    }

  protected:
    BasicSolver() {
        sl_options_init(&options_, sizeof options_);
        options_.purpose = SL_PURPOSE_ONE_FACTOR;
        if (internal::is_natural_order<OrderingType>::value) {
            options_.ordering = SL_ORDERING_NATURAL;
        }
        if (is_complex::value) {
            options_.block_size = 2;
            options_.storage = SL_STORAGE_COMPLEX;
        }
        analyzed_with_ = options_;
        status_.store(SL_ERR_MISMATCH);
        has_no_numbers();
    }

    /* For classes that derive from Eigen's and set m_P and m_Pinv: the next factorization takes
     * this order. The permuted matrix is not needed. */
    void analyzePattern_preordered(const CholMatrixType &A, bool) {
        const Permutation P = m_P, inverse = m_Pinv;
        keep_order(inverse);
        forget();
        m_P = P;
        m_Pinv = inverse;
        report(SL_OK, A.rows());
        has_no_numbers();
    }

    /* L: of LDLT without its unit diagonal. Computed when it is first asked for. */
    const CholMatrixType &lower() const {
        const std::lock_guard<std::mutex> lock(lower_mutex_);
        if (has_lower_) return lower_;
        sl_matrix *made = nullptr;
        lower_ = CholMatrixType();
        set_status(ready_ != SL_OK   ? ready_
                   : m_P.size() < n_ ? refuse(SL_ERR_UNSUPPORTED, "L of a complex matrix with 2x2 "
                                                                  "pivots")
                                     : sl_factor_lower(&made, factor_.get(), nullptr));
        if (made) fill_lower(sl_matrix_view(made));
        sl_matrix_free(made);
        has_lower_ = true;
        return lower_;
    }
    void set_llt(bool is_llt) {
        if (is_llt == is_llt_) return;
        is_llt_ = is_llt;
        forget();
        has_no_numbers();
    }

    Permutation m_P, m_Pinv;
    VectorI m_parent; /* the elimination tree, -1 at a root */

  private:
    typedef typename internal::Numbers<Scalar>::Arrays Arrays;
    enum { unit = internal::Numbers<Scalar>::unit };
    typedef std::integral_constant<bool, unit == 2> is_complex;
    typedef Eigen::Ref<const Dense> Input;
    typedef Eigen::SparseMatrix<Wide, Eigen::ColMajor, Eigen::Index> Columns;
    enum Pivoting { pivoted_if_needed, pivoted_always, pivoted_never };

    /* Complex right-hand sides of a real matrix. */
    template <class Rhs>
    struct IsSplit
        : std::integral_constant<bool, bool(Eigen::NumTraits<typename Rhs::Scalar>::IsComplex) &&
                                           !is_complex::value> {};

    void forget() {
        factor_.reset();
        symbolic_.reset();
        m_P.resize(0);
        m_Pinv.resize(0);
        has_lower_ = has_pivots_ = false;
    }
    /* The library knows the reason of its last error in this thread; so it is asked at once. */
    void set_status(sl_status status) const {
        status_.store(status);
        if (status == SL_OK) return;
        const std::lock_guard<std::mutex> lock(message_mutex_);
        message_ = status == ready_ ? ready_message_ : message_of(status, nullptr);
    }
    void has_no_numbers() {
        ready_ = SL_ERR_MISMATCH;
        ready_message_ = "there is no factor: call compute, or factorize";
    }
    sl_status wrong_size() const {
        return refuse(SL_ERR_ARGUMENT, "B does not have as many rows as its set");
    }
    /* A refusal of this class, of which the library does not know. */
    sl_status refuse(sl_status status, const char *why) const {
        own_reason_.store(why);
        return status;
    }
    /* The text of an error; known: where it is described, NULL: by the library itself. */
    std::string message_of(sl_status status, const sl_stats *known) const {
        std::vector<char> buffer(1000);
        sl_stats own = sl_stats();
        own.error.line = -1;
        own.error.row = own.error.column = -1;
        own.error.what = own_reason_.exchange(nullptr);
        sl_error_text(buffer.data(), buffer.size(), status, own.error.what ? &own : known);
        std::string text = buffer.data();
        replace(text, "sl_symbolic_create_pivoted", is_llt_ ? "SimplicialLDLT" : "setPivoted()");
        replace(text, "options.", "options().");
        if (status == SL_ERR_PIVOT && is_llt_) text += "; SimplicialLDLT allows negative pivots";
        if (status == SL_ERR_PIVOT && !is_zero_mean_ && !skips_nulls_) {
            text += "; setZeroMean() or setNullPivots(true) solves singular Laplacians";
        }
        if (status == SL_ERR_INCONSISTENT) text += "; setZeroMean() makes b consistent";
        return text;
    }
    static void replace(std::string &text, const std::string &from, const char *to) {
        const std::string with = to;
        std::size_t at = text.find(from);
        for (; at != std::string::npos; at = text.find(from, at + with.size()))
            text.replace(at, from.size(), with);
    }
    /* The 2x2 pivots in d by their eigenvalues, the smaller one first; e is beside the diagonal. */
    static void use_eigenvalues(std::vector<double> &d, const double *e) {
        for (std::size_t k = 0; k + 1 < d.size(); k++) {
            if (e[k] == 0) continue;
            const double middle = 0.5 * (d[k] + d[k + 1]);
            const double far = std::copysign(std::hypot(0.5 * (d[k] - d[k + 1]), e[k]), middle);
            const double large = middle + far;
            /* the product is the determinant, which does not cancel as middle - far does */
            const double small = d[k] * (d[k + 1] / large) - e[k] * (e[k] / large);
            d[k] = std::min(large, small);
            d[k + 1] = std::max(large, small);
            k++;
        }
    }
    /* After an error too, the solver has the size of A, and solves fail instead of asserting. */
    void report(sl_status status, Eigen::Index n) {
        this->m_isInitialized = true;
        n_ = n;
        ready_ = status;
        if (unit == 2 && stats_.error.row >= 0) stats_.error.row /= 2;
        ready_message_ = status == SL_OK ? std::string() : message_of(status, &stats_);
        set_status(status);
    }

    // ---- the analysis ----

    void analyze_only(const MatrixType &A) {
        const Arrays arrays(A, int(UpLo), 0, 1);
        forget();
        report(arrays.status() == SL_OK ? analyze(A, arrays.view(), pivoting_ == pivoted_always)
                                        : arrays.status(),
               A.rows());
        if (ready_ == SL_OK) has_no_numbers();
    }
    void keep_order(const Permutation &order) {
        order_.clear();
        for (Eigen::Index k = 0; k < order.size(); k++) {
            for (int part = 0; part < unit; part++) {
                order_.push_back(sl_int(order.indices()[k]) * unit + part);
            }
        }
        has_order_ = true;
    }
    /* The library's own order, or that of a class of the caller. */
    static bool order_by_class(const MatrixType &, Permutation &, std::true_type) {
        return false;
    }
    static bool order_by_class(const MatrixType &A, Permutation &order, std::false_type) {
        enum { triangle = (int(UpLo) & int(Eigen::Lower)) ? Eigen::Lower : Eigen::Upper };
        if (A.rows() != A.cols()) return false;
        CholMatrixType C;
        C = A.template selfadjointView<triangle>();
        OrderingType()(C, order);
        if (order.size() == 0) order.setIdentity(A.rows());
        return true;
    }
    /* The order of the caller in options; false: there is one, but not of a matrix of this size. */
    bool use_order(const MatrixType &A, const sl_csc &view, sl_options &options) {
        typedef std::integral_constant<bool, internal::is_own_order<OrderingType>::value ||
                                                 internal::is_natural_order<OrderingType>::value>
            is_library;
        Permutation order;
        if (!has_order_ && !order_by_class(A, order, is_library())) return true;
        if (!has_order_) {
            keep_order(order);
            has_order_ = false;
        }
        options.ordering = SL_ORDERING_GIVEN;
        options.perm = order_.data();
        return order_.size() == std::size_t(view.n_cols);
    }
    sl_status analyze(const MatrixType &A, const sl_csc &view, bool with_pivots) {
        sl_symbolic *made = nullptr;
        sl_options options = options_;
        /* The view of a row-major matrix is that of its transpose. */
        const int triangle = int(UpLo) & (int(Eigen::Lower) | int(Eigen::Upper));
        const int lower = MatrixType::IsRowMajor ? int(Eigen::Upper) : int(Eigen::Lower);
        const int upper = MatrixType::IsRowMajor ? int(Eigen::Lower) : int(Eigen::Upper);
        if (triangle == lower) {
            options.triangle = SL_TRIANGLE_LOWER;
        } else if (triangle == upper) {
            options.triangle = SL_TRIANGLE_UPPER;
        }
        forget();
        if (!use_order(A, view, options)) {
            return refuse(SL_ERR_ARGUMENT, "an order of another size than the matrix");
        }
        const sl_status status = with_pivots ? choose_pivots(&made, view, options)
                                             : sl_symbolic_create(&made, &view, &options, &stats_);
        if (status != SL_OK) return status;
        symbolic_.reset(made, sl_symbolic_free);
        /* only the other triangle is stored: what is read would be a diagonal matrix */
        const sl_symbolic_info &read = stats_.symbolic;
        if (options.triangle != SL_TRIANGLE_NONE && read.components == read.n &&
            sl_off(view.p[view.n_cols]) > read.nnz_a) {
            forget();
            return refuse(SL_ERR_MALFORMED, "the triangle that is read is empty");
        }
        has_pivots_ = with_pivots;
        analyzed_with_ = options_;
        analyses_++;
        copy_order();
        return SL_OK;
    }
    /* Pivots are compared within columns, where rows of other scales mislead. */
    sl_status choose_pivots(sl_symbolic **made, const sl_csc &view, const sl_options &options) {
        sl_triangle triangle = SL_TRIANGLE_NONE;
        const sl_status status = sl_csc_triangle(&view, &triangle, &options, &stats_);
        if (status != SL_OK) return status;
        const std::vector<double> s = internal::row_scales(view, triangle);
        std::vector<double> x(view.x, view.x + view.p[view.n_cols]);
        for (sl_int j = 0; j < view.n_cols; j++) {
            for (sl_int p = view.p[j]; p < view.p[j + 1]; p++)
                x[std::size_t(p)] *= s[std::size_t(view.i[p])] * s[std::size_t(j)];
        }
        sl_csc scaled = view;
        if (!x.empty()) scaled.x = x.data();
        return sl_symbolic_create_pivoted(made, &scaled, &options, &stats_);
    }
    void copy_order() {
        const sl_symbolic_arrays arrays = sl_symbolic_view(symbolic_.get());
        const Eigen::Index n = arrays.n / unit;
        if (unit == 2 && has_pivots_) return;
        m_P.resize(n);
        m_Pinv.resize(n);
        m_parent.resize(n);
        for (Eigen::Index k = 0; k < n; k++) {
            const sl_int row = arrays.perm[k * unit] / unit;
            const sl_int parent = arrays.parent[k * unit + unit - 1];
            m_Pinv.indices()[k] = StorageIndex(row);
            m_P.indices()[row] = StorageIndex(k);
            m_parent[k] = StorageIndex(parent < 0 ? -1 : parent / unit);
        }
    }
    /* Whether the options of the analysis are those of the last one. */
    bool is_analyzed_as_wanted() const {
        const sl_options &a = analyzed_with_, &b = options_;
        return a.ordering == b.ordering && a.relaxation == b.relaxation && a.perm == b.perm &&
               a.block_size == b.block_size && a.purpose == b.purpose;
    }

    // ---- the factorization ----

    static bool is_refused(sl_status status) {
        return status == SL_ERR_PIVOT || status == SL_ERR_INACCURATE;
    }
    /* Factors A over the analysis there is, if it is that of A, or over a new one. */
    sl_status factor_any(const MatrixType &A, const sl_csc &view) {
        bool with_pivots = pivoting_ == pivoted_always;
        sl_status status = SL_ERR_OTHER_PATTERN;
        /* whether the last matrix was singular says nothing of this one */
        if (has_skipped_) options_changed_ = true;
        has_skipped_ = false;
        if (symbolic_ && is_analyzed_as_wanted()) status = factor_checked(view);
        const bool is_again = has_pivots_ && is_refused(status);
        if (status == SL_ERR_OTHER_PATTERN || is_again) {
            with_pivots = with_pivots || is_again;
            status = analyze(A, view, with_pivots);
            if (status == SL_OK) status = factor_checked(view);
        }
        if (status == SL_ERR_PIVOT && is_open() && skips_nulls_) status = factor_skipping(view);
        if (is_refused(status) && may_pivot()) status = factor_pivoted(A, view, status);
        return status;
    }
    /* Whether null pivots may be skipped, and whether pivots may be chosen by the values. */
    bool is_open() const {
        return !has_pivots_ && !is_zero_mean_ && options_.pivots == SL_PIVOTS_NONZERO &&
               options_.regularization == 0;
    }
    bool may_pivot() const {
        return is_open() && pivoting_ == pivoted_if_needed && !is_llt_;
    }
    /* The same with skipped null pivots; if that fails too, all is as after the first failure. */
    sl_status factor_skipping(const sl_csc &view) {
        const sl_stats stats = stats_;
        has_skipped_ = options_changed_ = true;
        sl_status status = factor_numbers(view);
        /* a semidefinite matrix may be a negative one */
        if (status == SL_OK && (!is_llt_ || stats_.factor.negative == 0)) return SL_OK;
        has_skipped_ = false;
        options_changed_ = true;
        factor_.reset();
        stats_ = stats;
        return SL_ERR_PIVOT;
    }
    /* The same with 2x2 pivots; if that fails too, all is as after the first failure. */
    sl_status factor_pivoted(const MatrixType &A, const sl_csc &view, sl_status first) {
        const std::shared_ptr<sl_symbolic> symbolic = symbolic_;
        const sl_stats stats = stats_;
        const int analyses = analyses_;
        sl_status status = analyze(A, view, true);
        if (status == SL_OK) status = factor_checked(view);
        if (status == SL_OK) return SL_OK;
        forget();
        symbolic_ = symbolic;
        stats_ = stats;
        analyses_ = analyses;
        copy_order();
        return first;
    }
    sl_status factor_checked(const sl_csc &view) {
        const sl_status status = factor_numbers(view);
        return status == SL_OK && (has_pivots_ || are_far_apart()) ? check_pivots(view) : status;
    }
    /* In the order of the pattern, too, a small pivot may ruin rows. Of 10,776 random KKT systems
     * with diagonals of 1e-8 to 1e19, 2,029 had errors above 1e-8; all but two of them had pivots
     * that differed by more than 1e14. Pivots of one sign are good. */
    bool are_far_apart() const {
        const sl_factor_info &f = stats_.factor;
        return may_pivot() && f.positive > 0 && f.negative > 0 && f.pivot_max > 1e14 * f.pivot_min;
    }
    /* Pivots that were chosen for other values may lose all digits of rows that are small beside
     * others. Growth, which is relative to the largest entry, does not show that, and the solution
     * of a system in which all rows of S A S weigh the same does. */
    sl_status check_pivots(const sl_csc &view) {
        const bool is_float = options_.storage == SL_STORAGE_FLOAT;
        const double limit = options_.error_limit != 0 ? options_.error_limit
                             : is_float                ? 0.05 /* 1e-10 epsilon(float) / epsilon */
                             : has_pivots_             ? 1e-10
                                                       : 1e-8;
        const std::size_t n = std::size_t(view.n_cols);
        if (limit < 0 || stats_.factor.regularized > 0) return SL_OK;
        const sl_triangle triangle = sl_symbolic_view(symbolic_.get()).info.triangle;
        const std::vector<double> s = internal::row_scales(view, triangle);
        std::vector<double> x(2 * n), b(2 * n + 1), y(2 * n + 1);
        for (std::size_t k = 0; k < n; k++) { /* no pattern in which errors cancel */
            const double multiple = double(k + 1) * 0.6180339887498949;
            const double part = multiple - std::floor(multiple);
            x[k] = s[k] * (1 + part);
            x[n + k] = s[k] * (part < 0.5 ? -1 - 2 * part : 2 * part);
        }
        for (sl_int j = 0; j < view.n_cols; j++) {
            for (sl_int p = view.p[j]; p < view.p[j + 1]; p++) {
                const std::size_t row = std::size_t(view.i[p]), column = std::size_t(j);
                if (!internal::is_read(triangle, view.i[p], j)) continue;
                for (std::size_t c = 0; c < 2 * n; c += n) {
                    b[c + row] += view.x[p] * x[c + column];
                    if (row != column) b[c + column] += view.x[p] * x[c + row];
                }
            }
        }
        internal::LentWork work(work_);
        sl_status status = sl_factor_solve(factor_.get(), y.data(), n, b.data(), n, 2, work.get());
        if (status == SL_OK) {
            status = sl_factor_refine(factor_.get(), &view, y.data(), n, b.data(), n, 2, 0,
                                      work.get(), &stats_);
        }
        if (status != SL_OK || stats_.refine.backward_error <= limit) return status;
        stats_.error.value = stats_.refine.backward_error;
        stats_.error.what = "the backward error of a solve exceeds options.error_limit";
        return SL_ERR_INACCURATE;
    }
    /* A factor that a region borrows keeps its numbers. */
    sl_status factor_numbers(const sl_csc &view) {
        sl_status status = SL_ERR_UNSUPPORTED;
        if (factor_.use_count() == 1 && !options_changed_) {
            status = sl_factor_refactor(factor_.get(), &view, &stats_);
            if (status != SL_ERR_UNSUPPORTED) return status;
        }
        sl_factor *made = nullptr;
        sl_options options = options_;
        std::vector<double> ones;
        if (is_zero_mean_ || has_skipped_) skip_nulls(options, ones, std::size_t(view.n_cols));
        if (is_llt_ && options.pivots == SL_PIVOTS_NONZERO && options.regularization == 0) {
            options.pivots = SL_PIVOTS_POSITIVE;
        }
        status = sl_factor_create(&made, symbolic_.get(), &view, &options, &stats_);
        /* it takes neither 2x2 nor null pivots, nor a NaN, of which the double one names the row */
        if (status == SL_ERR_UNSUPPORTED && options.storage == SL_STORAGE_COMPLEX) {
            options.storage = SL_STORAGE_DOUBLE;
            status = sl_factor_create(&made, symbolic_.get(), &view, &options, &stats_);
        }
        factor_.reset();
        if (status == SL_OK) {
            /* the deleter keeps the analysis that the factor borrows */
            const std::shared_ptr<sl_symbolic> symbolic = symbolic_;
            factor_.reset(made, [symbolic](sl_factor *owned) { sl_factor_free(owned); });
            options_changed_ = false;
        }
        return status;
    }
    /* A complex null vector z is two real ones, z and i z. */
    void skip_nulls(sl_options &options, std::vector<double> &ones, std::size_t n) const {
        ones.assign(n * (unit == 2 ? 3 : 1), 1.0);
        options.pivots = SL_PIVOTS_SKIP_NULL;
        if (is_zero_mean_ && !options.mass) options.mass = ones.data();
        if (unit == 1 || options.null_vector) return;
        for (std::size_t k = 0; k < 2 * n; k++)
            ones[n + k] = k % 2 == (k < n ? 0u : 1u) ? 1 : 0;
        options.null_vector = ones.data() + n;
        options.null_vector_count = 2;
    }
    /* Of a complex factor, columns 2k have the real parts in rows 2i and the imaginary ones in rows
     * 2i + 1. */
    void fill_lower(const sl_csc &real) const {
        std::vector<StorageIndex> p(1, 0), i;
        std::vector<Scalar> x;
        const VectorType roots = vectorD().cwiseSqrt();
        const sl_int per_entry = unit;
        for (Eigen::Index k = 0; k < n_; k++) {
            const Scalar scale = is_llt_ ? roots[k] : Scalar(1);
            for (sl_int q = real.p[k * per_entry]; q < real.p[k * per_entry + 1]; q++) {
                const StorageIndex row = StorageIndex(real.i[q] / per_entry);
                if (row == k && !is_llt_) continue;
                const bool is_second = real.i[q] % per_entry != 0;
                if (StorageIndex(i.size()) == p.back() || i.back() != row) {
                    i.push_back(row);
                    x.push_back(Scalar(0));
                }
                x.back() += scale * part_of(real.x[q], is_second, Scalar());
            }
            p.push_back(StorageIndex(i.size()));
        }
        if (i.empty()) {
            lower_ = CholMatrixType(n_, n_);
            return;
        }
        lower_ = Eigen::Map<const CholMatrixType>(n_, n_, Eigen::Index(i.size()), p.data(),
                                                  i.data(), x.data());
    }
    template <class Real> static Real part_of(double value, bool, Real) {
        return Real(value);
    }
    template <class Real>
    static std::complex<Real> part_of(double value, bool is_imaginary, std::complex<Real>) {
        return is_imaginary ? std::complex<Real>(0, Real(value)) : std::complex<Real>(Real(value));
    }

    // ---- solves ----

    template <class T> static T nan() {
        typedef typename Eigen::NumTraits<T>::Real Real;
        return T(std::numeric_limits<Real>::quiet_NaN());
    }
    static const RowSet &real_rows(const RowSet &rows, std::false_type) {
        return rows;
    }
    static RowSet real_rows(const RowSet &rows, std::true_type) {
        return rows.of_complex();
    }
    const RowSet &diagonal_rows(const RowSet &rows, std::false_type) const {
        return rows;
    }
    RowSet diagonal_rows(const RowSet &rows, std::true_type) const {
        return rows.real_parts(n_);
    }
    /* The library refuses a NULL, which an empty matrix has as its data. */
    static double *data(Dense &x) {
        static double nothing = 0;
        return x.size() ? reinterpret_cast<double *>(x.data()) : &nothing;
    }
    static const double *data(const Dense &x) {
        static const double nothing = 0;
        return x.size() ? reinterpret_cast<const double *>(x.data()) : &nothing;
    }
    static std::size_t stride(const Dense &x) {
        return std::size_t(x.rows()) * unit;
    }
    static sl_int columns(const Dense &x) {
        return x.cols() > INT32_MAX ? -1 : sl_int(x.cols());
    }

    /* A local call whose result has nx rows, and as many columns as b. */
    template <class Call>
    Dense local(bool fits, Eigen::Index nx, const Dense &b, const Call &call,
                sl_status *result = nullptr) const {
        Dense x(nx, b.cols());
        internal::LentWork work(work_);
        sl_status status = ready_;
        if (status == SL_OK) status = fits ? call(x, work.get()) : wrong_size();
        set_status(status);
        if (status != SL_OK) x.setConstant(nan<Wide>());
        if (result) *result = status;
        return x;
    }
    template <class Call> Dense part(Call call, unsigned parts, const Dense &b) const {
        return local(b.rows() == n_, n_, b, [&](Dense &x, sl_work *work) {
            return call(factor_.get(), parts, data(x), stride(x), data(b), stride(b), columns(b),
                        work);
        });
    }
    Dense solve_sets(const RowSet &bset, const Dense &b, const RowSet &xset,
                     sl_status *result = nullptr) const {
        const RowSet &bs = real_rows(bset, is_complex()), &xs = real_rows(xset, is_complex());
        return local(
            bset.size(n_) == b.rows(), xset.size(n_), b,
            [&](Dense &x, sl_work *work) {
                return sl_local_solve(factor_.get(), bs.data(), bs.count(), xs.data(), xs.count(),
                                      data(x), stride(x), data(b), stride(b), columns(b), work,
                                      nullptr);
            },
            result);
    }

    std::pair<double, double> logdet() const {
        std::pair<double, double> out(nan<double>(), nan<double>());
        set_status(ready_      ? ready_
                   : unit == 2 ? sl_complex_logdet(factor_.get(), &out.first, &out.second)
                               : sl_factor_logdet(factor_.get(), &out.first, &out.second));
        return out;
    }

    /* b in double, without a copy if it is. */
    template <class Rhs>
    static
        typename std::enable_if<std::is_same<typename Rhs::Scalar, Wide>::value, const Rhs &>::type
        cast(const Rhs &b) {
        return b;
    }
    template <class Rhs>
    static typename std::enable_if<!std::is_same<typename Rhs::Scalar, Wide>::value, Dense>::type
    cast(const Rhs &b) {
        return b.template cast<Wide>();
    }

    template <class Rhs, class Dest>
    sl_status solve_dense(const Rhs &b, Dest &dest, std::false_type) const {
        typedef std::integral_constant<bool, std::is_same<typename Dest::Scalar, Wide>::value &&
                                                 (int(Dest::Flags) & Eigen::DirectAccessBit) != 0 &&
                                                 (int(Dest::Flags) & Eigen::RowMajorBit) == 0>
            is_plain;
        const auto &wide = cast(b); /* a copy lives as long as this reference */
        return solve_into(dest, Input(wide), is_plain());
    }
    /* Real and imaginary parts as two right-hand sides. */
    template <class Rhs, class Dest>
    sl_status solve_dense(const Rhs &b, Dest &dest, std::true_type) const {
        const Eigen::Index half = b.cols();
        Dense both(n_, 2 * half), x(n_, 2 * half);
        both.leftCols(half) = b.real().template cast<double>();
        both.rightCols(half) = b.imag().template cast<double>();
        const sl_status status = solve_into(x, Input(both), std::true_type());
        if (status != SL_OK) return status;
        typedef typename Dest::RealScalar Real;
        dest.real() = x.leftCols(half).template cast<Real>();
        dest.imag() = x.rightCols(half).template cast<Real>();
        return SL_OK;
    }

    /* From column to column; a single column may come with any stride. */
    template <class Block> Eigen::Index stride_of(const Block &x) const {
        return x.cols() > 1 ? x.outerStride() : std::max<Eigen::Index>(n_, 1);
    }
    sl_status solve_block(Wide *x, Eigen::Index ldx, const Input &B) const {
        internal::LentWork work(work_);
        if (B.cols() > INT32_MAX) return refuse(SL_ERR_TOO_LARGE, "more than 2^31 columns");
        return sl_factor_solve(factor_.get(), reinterpret_cast<double *>(x),
                               std::size_t(ldx) * unit, reinterpret_cast<const double *>(B.data()),
                               std::size_t(stride_of(B)) * unit, sl_int(B.cols()), work.get());
    }
    /* Writes into dest itself, if its columns are contiguous and it is B or apart from B. */
    template <class Dest> sl_status solve_into(Dest &dest, const Input &B, std::true_type) const {
        const Eigen::Index ldx = stride_of(dest), ldb = stride_of(B);
        if (dest.size() > 0 && dest.innerStride() == 1 && ldx >= n_ && ldb >= n_) {
            const Wide *x = dest.data(), *b = B.data();
            const std::less_equal<const Wide *> is_before = std::less_equal<const Wide *>();
            const Eigen::Index last = B.cols() - 1;
            if ((x == b && ldx == ldb) || is_before(x + ldx * last + n_, b) ||
                is_before(b + ldb * last + n_, x)) {
                return solve_block(dest.data(), ldx, B);
            }
        }
        return solve_into(dest, B, std::false_type());
    }
    template <class Dest> sl_status solve_into(Dest &dest, const Input &B, std::false_type) const {
        Dense x(n_, B.cols());
        if (x.size() == 0) return SL_OK;
        const sl_status status = solve_block(x.data(), n_, B);
        if (status == SL_OK) dest = x.template cast<typename Dest::Scalar>();
        return status;
    }

    template <class Rhs, class Result>
    sl_status solve_sparse(const Rhs &b, Result &X, std::false_type) const {
        const Columns B = b.template cast<Wide>();
        sl_status status = SL_OK;
        for (Eigen::Index c = 0; c < B.cols(); c += 8) {
            const Eigen::Index width = std::min<Eigen::Index>(8, B.cols() - c);
            sl_status of_block = SL_OK;
            const Dense x = solve_columns(B, c, width, &of_block);
            if (status == SL_OK) status = of_block;
            for (Eigen::Index r = 0; r < width; r++)
                append(X, x.col(r), c + r);
        }
        X.finalize();
        return status;
    }
    template <class Rhs, class Result>
    sl_status solve_sparse(const Rhs &b, Result &X, std::true_type) const {
        typedef typename Result::Scalar Complex;
        Columns re(n_, b.cols()), im(n_, b.cols());
        const Eigen::SparseMatrix<typename Rhs::Scalar> B = b;
        sl_status status = solve_sparse(B.real(), re, std::false_type());
        if (status == SL_OK) status = solve_sparse(B.imag(), im, std::false_type());
        X = re.template cast<Complex>() + Complex(0, 1) * im.template cast<Complex>();
        return status;
    }
    /* Columns c .. c + width - 1 of A^-1 B. */
    Dense solve_columns(const Columns &B, Eigen::Index c, Eigen::Index width,
                        sl_status *status) const {
        std::vector<sl_int> rows;
        for (Eigen::Index r = 0; r < width; r++) {
            for (typename Columns::InnerIterator entry(B, c + r); entry; ++entry) {
                rows.push_back(sl_int(entry.row()));
            }
        }
        std::sort(rows.begin(), rows.end());
        rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
        Dense b = Dense::Zero(Eigen::Index(rows.size()), width);
        for (Eigen::Index r = 0; r < width; r++) {
            for (typename Columns::InnerIterator entry(B, c + r); entry; ++entry) {
                const std::ptrdiff_t k =
                    std::lower_bound(rows.begin(), rows.end(), sl_int(entry.row())) - rows.begin();
                b(k, r) += entry.value();
            }
        }
        return solve_sets(RowSet(rows), b, RowSet::all(), status);
    }
    template <class Result, class Column>
    static void append(Result &X, const Column &x, Eigen::Index c) {
        X.startVec(c);
        for (Eigen::Index i = 0; i < x.size(); i++) {
            if (x[i] != Wide(0)) X.insertBack(i, c) = typename Result::Scalar(x[i]);
        }
    }
    template <class Dest, class X> static void assign(Dest &dest, const X &x, std::false_type) {
        dest = x;
    }
    template <class Dest, class X> static void assign(Dest &dest, const X &x, std::true_type) {
        dest = x.col(0);
    }

    sl_options options_, analyzed_with_;
    Pivoting pivoting_ = pivoted_if_needed;
    bool has_pivots_ = false; /* the analysis chose them */
    bool is_llt_ = Traits::is_llt != 0;
    bool is_zero_mean_ = false;
    bool skips_nulls_ = true;  /* of singular matrices */
    bool has_skipped_ = false; /* as the matrix that was factored last is singular */
    bool options_changed_ = false;
    bool has_order_ = false; /* order_ is that of analyzePattern */
    std::vector<sl_int> order_;
    sl_stats stats_ = sl_stats();
    Eigen::Index n_ = 0;
    sl_status ready_ = SL_ERR_MISMATCH; /* SL_OK, or why there are no numbers */
    int analyses_ = 0;
    double shift_offset_ = 0, shift_scale_ = 1;
    mutable std::atomic<int> status_;
    std::string ready_message_; /* of ready_ */
    mutable std::string message_;
    mutable std::mutex message_mutex_;
    mutable std::atomic<const char *> own_reason_{nullptr};
    mutable internal::WorkSlot work_;
    mutable std::mutex lower_mutex_;
    mutable CholMatrixType lower_;
    mutable bool has_lower_ = false;
    std::shared_ptr<sl_symbolic> symbolic_;
    std::shared_ptr<sl_factor> factor_;
};

template <class MatrixType, int UpLo = Eigen::Lower,
          class Ordering = Eigen::AMDOrdering<typename MatrixType::StorageIndex>>
class SimplicialLDLT;
template <class MatrixType, int UpLo = Eigen::Lower,
          class Ordering = Eigen::AMDOrdering<typename MatrixType::StorageIndex>>
class SimplicialLLT;
template <class MatrixType, int UpLo = Eigen::Lower,
          class Ordering = Eigen::AMDOrdering<typename MatrixType::StorageIndex>>
class SimplicialCholesky;

namespace internal {

template <class M, int UpLo, class Ordering>
struct SolverTraits<SimplicialLDLT<M, UpLo, Ordering>>
    : MatrixTraits<M, UpLo, Ordering, Eigen::UnitLower, Eigen::UnitUpper> {
    enum { is_llt = 0 };
};
template <class M, int UpLo, class Ordering>
struct SolverTraits<SimplicialLLT<M, UpLo, Ordering>>
    : MatrixTraits<M, UpLo, Ordering, Eigen::Lower, Eigen::Upper> {
    enum { is_llt = 1 };
};
template <class M, int UpLo, class Ordering>
struct SolverTraits<SimplicialCholesky<M, UpLo, Ordering>>
    : SolverTraits<SimplicialLDLT<M, UpLo, Ordering>> {};

} // namespace internal

/** P A P' = L D L' of definite, quasi-definite and other symmetric or Hermitian matrices. */
template <class MatrixType_, int UpLo_, class Ordering_>
class SimplicialLDLT : public BasicSolver<SimplicialLDLT<MatrixType_, UpLo_, Ordering_>> {
    typedef internal::SolverTraits<SimplicialLDLT> Traits;

  public:
    typedef BasicSolver<SimplicialLDLT> Base;
    typedef MatrixType_ MatrixType;
    typedef typename Traits::MatrixL MatrixL;
    typedef typename Traits::MatrixU MatrixU;
    SimplicialLDLT() {
    }
    explicit SimplicialLDLT(const MatrixType &A) {
        this->compute(A);
    }
    /** Views of L, unit lower triangular, and L', valid until the next factorization. Empty after
     *  an error. */
    const MatrixL matrixL() const {
        return MatrixL(this->lower());
    }
    const MatrixU matrixU() const {
        return MatrixU(this->lower().adjoint());
    }
};

/** The same, of positive definite matrices: a negative pivot is a NumericalIssue. P A P' = L L'. */
template <class MatrixType_, int UpLo_, class Ordering_>
class SimplicialLLT : public BasicSolver<SimplicialLLT<MatrixType_, UpLo_, Ordering_>> {
    typedef internal::SolverTraits<SimplicialLLT> Traits;

  public:
    typedef BasicSolver<SimplicialLLT> Base;
    typedef MatrixType_ MatrixType;
    typedef typename Traits::MatrixL MatrixL;
    typedef typename Traits::MatrixU MatrixU;
    SimplicialLLT() {
    }
    explicit SimplicialLLT(const MatrixType &A) {
        this->compute(A);
    }
    /** Views of L and L', valid until the next factorization. Empty after an error. */
    const MatrixL matrixL() const {
        return MatrixL(this->lower());
    }
    const MatrixU matrixU() const {
        return MatrixU(this->lower().adjoint());
    }
};

/** Either of them, as setMode says; LDLT at first. */
template <class MatrixType_, int UpLo_, class Ordering_>
class SimplicialCholesky : public BasicSolver<SimplicialCholesky<MatrixType_, UpLo_, Ordering_>> {
  public:
    typedef BasicSolver<SimplicialCholesky> Base;
    typedef MatrixType_ MatrixType;
    SimplicialCholesky() {
    }
    explicit SimplicialCholesky(const MatrixType &A) {
        this->compute(A);
    }
    /** Another mode forgets the factor. */
    SimplicialCholesky &setMode(Eigen::SimplicialCholeskyMode mode) {
        this->set_llt(mode == Eigen::SimplicialCholeskyLLT);
        return *this;
    }
    /** L, of LDLT without its unit diagonal. */
    typename Base::CholMatrixType rawMatrix() const {
        return this->lower();
    }
};

/** SimplicialLLT with the template arguments of Eigen::CholmodSupernodalLLT. */
template <class MatrixType, int UpLo = Eigen::Lower>
class CholmodSupernodalLLT : public SimplicialLLT<MatrixType, UpLo> {
  public:
    CholmodSupernodalLLT() {
    }
    explicit CholmodSupernodalLLT(const MatrixType &A) : SimplicialLLT<MatrixType, UpLo>(A) {
    }
};

/** SimplicialLDLT and SimplicialLLT with an order for many local solves. They refuse singular
 *  matrices unless setNullPivots(true) or setZeroMean() is called. */
template <class MatrixType, int UpLo = Eigen::Lower,
          class Ordering = Eigen::AMDOrdering<typename MatrixType::StorageIndex>>
class LocalLDLT : public SimplicialLDLT<MatrixType, UpLo, Ordering> {
  public:
    LocalLDLT() {
        this->options().purpose = SL_PURPOSE_MANY_SOLVES;
        this->setNullPivots(false);
    }
    explicit LocalLDLT(const MatrixType &A) : LocalLDLT() {
        this->compute(A);
    }
};
template <class MatrixType, int UpLo = Eigen::Lower,
          class Ordering = Eigen::AMDOrdering<typename MatrixType::StorageIndex>>
class LocalLLT : public SimplicialLLT<MatrixType, UpLo, Ordering> {
  public:
    LocalLLT() {
        this->options().purpose = SL_PURPOSE_MANY_SOLVES;
        this->setNullPivots(false);
    }
    explicit LocalLLT(const MatrixType &A) : LocalLLT() {
        this->compute(A);
    }
};

} // namespace sl

#endif

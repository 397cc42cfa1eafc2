/* sparse_local_eigen.hpp: sparse_local.h as a sparse solver of Eigen, local solves on its vectors
 *
 *     #include "sparse_local_eigen.hpp"
 *
 *     sl::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(A);     as Eigen::SimplicialLDLT
 *     if (solver.info() != Eigen::Success) ...
 *     x = solver.solve(b);
 *     y = solver.solve(bset, B, xset);                  b on a few rows, x wanted on a few others
 *
 * sl::SimplicialLDLT takes the place of Eigen::SimplicialLDLT, sl::SimplicialLLT that of
 * Eigen::SimplicialLLT, and sl::CholmodSupernodalLLT that of Eigen::CholmodSupernodalLLT: the same
 * template arguments, analyzePattern, factorize, compute, info and solve. One source file of the
 * program defines SL_WITH_ALL and SPARSE_LOCAL_IMPLEMENTATION and includes sparse_local.h, or the
 * program is linked with the compiled library.
 *
 * Matrices    any Eigen::SparseMatrix of float or double, column- or row-major, with Lower, Upper
 *             or both (Lower | Upper), also unsorted or uncompressed. A compressed matrix of double
 *             with int indices is used in place. Others are converted; all arithmetic is in double.
 * Ordering    the third template argument may be Eigen::NaturalOrdering; any other one means the
 *             library's own nested dissection, or options().ordering.
 * Errors      no exceptions: info() is NumericalIssue for a null pivot, a NaN or an infinity, and
 *             for a negative pivot in SimplicialLLT; InvalidInput for all other errors. status() is
 *             the library's own; stats().error names the row and what helps. A solve that fails
 *             sets info() and fills its result with NaN.
 * Indefinite  SimplicialLDLT keeps the order of the pattern unless setPivoted() chooses pivots by
 *             the values, as KKT systems with zeros on the diagonal need.
 * Differences from Eigen's solvers:
 *             - A numerically singular matrix is refused. Eigen accepts it unless a pivot is
 *               exactly 0, and so does options().null_tolerance = -1. For a singular Laplacian set
 *               options().null_pivots = SL_NULL_PIVOT_SKIP, and options().mass if wanted.
 *             - factorize with another pattern than that of analyzePattern analyzes it, and compute
 *               with the pattern of the last analysis does not analyze it again; analyses() counts.
 *               Plans and regions of an older analysis are then refused.
 *             - matrixL returns a matrix, and permutationP, vectorD return copies.
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

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <initializer_list>
#include <limits>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

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
            for (Eigen::Index r = 0; r < rows.rows(); r++) add(rows.derived().coeff(r, c));
        }
    }
    template <class Integer> RowSet(const std::vector<Integer> &rows) : all_(false) {
        for (Integer row : rows) add(row);
    }
    RowSet(std::initializer_list<int> rows) : all_(false) {
        for (int row : rows) add(row);
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
    /* A count that does not fit becomes -1, which every call refuses. */
    sl_int count() const {
        return rows_.size() > INT32_MAX ? -1 : sl_int(rows_.size());
    }
    Eigen::Index size(Eigen::Index n) const {
        return all_ ? n : Eigen::Index(rows_.size());
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
    template <class MatrixType> explicit MatrixArrays(const MatrixType &A) : status_(SL_OK) {
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
            use(A, std::integral_constant<int, std::is_same<Index, sl_int>::value         ? 32
                                               : std::is_same<Index, std::int64_t>::value ? 64
                                                                                          : 0>(),
                std::integral_constant<bool, std::is_same<Scalar, double>::value>());
        } else {
            compress(A);
        }
        if (!view_.i) view_.i = &nothing_index();
        if (!view_.x) view_.x = &nothing_value();
    }
    const sl_csc &view() const {
        return view_;
    }
    sl_status status() const {
        return status_;
    }

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
            if (is_first && offset != 0) status_ = SL_ERR_PATTERN;
        }
        x_.swap(shifted);
        if (!x_.empty()) view_.x = x_.data();
    }

private:
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

template <class Scalar> struct is_real : std::false_type {};
template <> struct is_real<float> : std::true_type {};
template <> struct is_real<double> : std::true_type {};

} // namespace internal

template <class MatrixType, int UpLo, class Ordering, bool is_llt> class BasicSolver;

/** The region of a set of rows, from BasicSolver::region. Copies share it. Empty after an error. */
class LocalRegion {
public:
    explicit operator bool() const {
        return bool(holder_);
    }
    sl_region_info stats() const {
        sl_stats stats = sl_stats();
        if (holder_) sl_region_stats(holder_->region, &stats);
        return stats.region;
    }

private:
    template <class, int, class, bool> friend class BasicSolver;
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
    template <class, int, class, bool> friend class BasicSolver;
    std::shared_ptr<sl_plan> plan_;
    Eigen::Index nb_, nx_;
};

/** The solver of both names below. is_llt: a negative pivot is an error. */
template <class MatrixType_, int UpLo_, class Ordering_, bool is_llt>
class BasicSolver
    : public Eigen::SparseSolverBase<BasicSolver<MatrixType_, UpLo_, Ordering_, is_llt>> {
    typedef Eigen::SparseSolverBase<BasicSolver> Base;
    typedef Eigen::Ref<const Eigen::MatrixXd> Input;

public:
    typedef MatrixType_ MatrixType;
    typedef Ordering_ OrderingType;
    typedef typename MatrixType::Scalar Scalar;
    typedef typename MatrixType::RealScalar RealScalar;
    typedef typename MatrixType::StorageIndex StorageIndex;
    typedef Eigen::MatrixXd Dense;
    typedef Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, StorageIndex> Permutation;
    enum {
        UpLo = UpLo_,
        ColsAtCompileTime = MatrixType::ColsAtCompileTime,
        MaxColsAtCompileTime = MatrixType::MaxColsAtCompileTime
    };
    static_assert(internal::is_real<Scalar>::value, "the matrix must be of float or double");

    BasicSolver() {
        init();
    }
    explicit BasicSolver(const MatrixType &A) {
        init();
        compute(A);
    }

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
    BasicSolver &setShift(double offset, double scale = 1) {
        shift_offset_ = offset;
        shift_scale_ = scale;
        return *this;
    }

    /** From the next analysis on, 1x1 and 2x2 pivots are chosen by the values of the matrix, as
     *  indefinite ones need. Other values of a pattern keep them, and if these do not suit, are
     *  analyzed again. vectorD() has the diagonal of D only, and entries of the inverse are refused
     *  (sl_symbolic_create_pivoted). */
    BasicSolver &setPivoted(bool on = true) {
        if (on != is_pivoted_) forget();
        is_pivoted_ = on;
        return *this;
    }

    /** Analyzes the pattern of A; with setPivoted() also its values. */
    BasicSolver &analyzePattern(const MatrixType &A) {
        internal::MatrixArrays arrays(A);
        forget();
        report(arrays.status() == SL_OK ? analyze(arrays.view()) : arrays.status(), A);
        if (ready_ == SL_OK) ready_ = SL_ERR_STATE;
        return *this;
    }
    /** Factors A, which has the analyzed pattern; another one is analyzed. */
    BasicSolver &factorize(const MatrixType &A) {
        internal::MatrixArrays arrays(A);
        arrays.shift_diagonal(shift_offset_, shift_scale_);
        sl_status status = arrays.status();
        if (status == SL_OK) status = factor_any(arrays.view());
        if (status != SL_OK && status != SL_ERR_PIVOT && status != SL_ERR_NOT_FINITE) {
            factor_.reset();
        }
        report(status, A);
        return *this;
    }
    /** Both. */
    BasicSolver &compute(const MatrixType &A) {
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
            return Eigen::NumericalIssue;
        default:
            return Eigen::InvalidInput;
        }
    }
    /** The status behind info(). */
    sl_status status() const {
        return sl_status(status_.load());
    }
    /** What the last analysis or factorization reported: the row of an error, counts, times. */
    const sl_stats &stats() const {
        return stats_;
    }
    /** How often a pattern was analyzed. */
    int analyses() const {
        return analyses_;
    }

    // ---- solves ----

    using Base::solve;

    /** x on xset for b on bset: bset.size() x nrhs numbers B, xset.size() x nrhs of the result. */
    template <class Rhs>
    Dense solve(const RowSet &bset, const Eigen::MatrixBase<Rhs> &B, const RowSet &xset) const {
        return solve_sets(bset, B.template cast<double>(), xset);
    }
    /** The same on a plan, whose sets are the rows of B and of the result. */
    template <class Rhs>
    Dense solve(const LocalPlan &plan, const Eigen::MatrixBase<Rhs> &B) const {
        const Dense b = B.template cast<double>();
        return local(plan.nb_ == b.rows(), plan.nx_, b, [&](Dense &x, sl_work *work) {
            return sl_plan_solve(plan.plan_.get(), factor_.get(), data(x), stride(x), data(b),
                                 stride(b), columns(b), work);
        });
    }
    /** A half or another part of a solve; parts is a sum of SL_PART_... For SimplicialLDLT,
     *  permutationP() b is solvePart(SL_PART_P, b), matrixL().solve(b) solvePart(SL_PART_L, b),
     *  matrixU().solve(b) solvePart(SL_PART_LT, b). The L of SimplicialLLT: SL_PART_L + SQRT_D. */
    template <class Rhs> Dense solvePart(unsigned parts, const Eigen::MatrixBase<Rhs> &B) const {
        return part(sl_factor_solve_part, parts, B.template cast<double>());
    }
    /** The product with the same parts: matrixL() b is multiplyPart(SL_PART_L, b). */
    template <class Rhs> Dense multiplyPart(unsigned parts, const Eigen::MatrixBase<Rhs> &B) const {
        return part(sl_factor_multiply_part, parts, B.template cast<double>());
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
        sl_options_init(&with_region, sizeof with_region);
        with_region.region = region.get();
        set_status(sl_plan_create(&made, symbolic_.get(), bset.data(), bset.count(), xset.data(),
                                  xset.count(), &with_region, nullptr));
        if (!made) return out;
        /* the deleter keeps what the plan borrows */
        const std::shared_ptr<sl_symbolic> symbolic = symbolic_;
        out.plan_.reset(made, [symbolic, region](sl_plan *plan) { sl_plan_free(plan); });
        out.nb_ = bset.size(n_);
        out.nx_ = xset.size(n_);
        return out;
    }
    /** The region of a set of rows. After another factorization call update(region). */
    LocalRegion region(const RowSet &set) const {
        LocalRegion out;
        sl_region *made = nullptr;
        set_status(ready_ ? ready_
                          : sl_region_create(&made, factor_.get(), set.data(), set.count(),
                                             nullptr, nullptr, nullptr));
        if (!made) return out;
        out.holder_ = std::make_shared<internal::RegionHolder>(made, factor_);
        return out;
    }
    /** Computes a region again from the present factor; its plans stay valid. */
    bool update(LocalRegion &region) const {
        internal::LentWork work(work_);
        sl_status status =
            sl_region_refactor(region.get(), factor_.get(), nullptr, work.get());
        set_status(status);
        if (status == SL_OK) region.holder_->factor = factor_;
        return status == SL_OK;
    }

    // ---- the inverse, the determinant, the condition ----

    /** Diagonal entries of the inverse, in the order of rows; without argument all. */
    Eigen::VectorXd inverseDiagonal(const RowSet &rows = RowSet::all()) const {
        return local(true, rows.size(n_), Dense(0, 1), [&](Dense &x, sl_work *work) {
            return sl_inverse_diagonal(factor_.get(), data(x), rows.data(), rows.count(), work,
                                       nullptr);
        });
    }
    /** log |det A|. */
    double logAbsDeterminant() const {
        return logdet().first;
    }
    /** log det A; NaN if det A is negative. */
    double logDeterminant() const {
        return logdet().second > 0 ? logdet().first : std::numeric_limits<double>::quiet_NaN();
    }
    /** 1 or -1. */
    double signDeterminant() const {
        return logdet().second;
    }
    Scalar determinant() const {
        return Scalar(logdet().second * std::exp(logdet().first));
    }
    /** An estimate of 1 / (||A|| ||A^-1||) in the one-norm; A is the matrix that was factored. */
    double rcond(const MatrixType &A) const {
        double out = std::numeric_limits<double>::quiet_NaN();
        internal::MatrixArrays arrays(A);
        internal::LentWork work(work_);
        arrays.shift_diagonal(shift_offset_, shift_scale_);
        sl_status status = ready_ ? ready_ : arrays.status();
        if (status == SL_OK) {
            status = sl_factor_rcond(factor_.get(), &arrays.view(), &out, work.get());
        }
        set_status(status);
        return out;
    }

    // ---- the factors: P A P^-1 = L D L' ----

    /** P as in Eigen's solvers: row i of A is pivot indices()[i]. */
    Permutation permutationP() const {
        if (!symbolic_) return Permutation();
        const sl_symbolic_arrays arrays = sl_symbolic_view(symbolic_.get());
        Permutation out(n_);
        for (Eigen::Index i = 0; i < n_; i++) out.indices()[i] = StorageIndex(arrays.iperm[i]);
        return out;
    }
    Permutation permutationPinv() const {
        return permutationP().inverse();
    }
    /** D of SimplicialLDLT; the squared diagonal of L of SimplicialLLT. */
    Eigen::VectorXd vectorD() const {
        if (ready_ != SL_OK) return Eigen::VectorXd();
        return Eigen::Map<const Eigen::VectorXd>(sl_factor_view(factor_.get()).D, n_);
    }
    /** L, unit lower triangular for SimplicialLDLT. */
    Eigen::SparseMatrix<double, Eigen::ColMajor, int> matrixL() const {
        typedef Eigen::SparseMatrix<double, Eigen::ColMajor, int> Lower;
        sl_matrix *made = nullptr;
        set_status(ready_ ? ready_ : sl_factor_lower(&made, factor_.get(), nullptr));
        if (!made) return Lower();
        const sl_csc view = sl_matrix_view(made);
        Lower L = Eigen::Map<const Lower>(view.n_rows, view.n_cols, view.p[view.n_cols], view.p,
                                          view.i, view.x);
        sl_matrix_free(made);
        if (is_llt) L = (L * vectorD().cwiseSqrt().asDiagonal()).eval();
        return L;
    }

    // ---- what Eigen calls ----

    template <class Rhs, class Dest>
    void _solve_impl(const Eigen::MatrixBase<Rhs> &b, Eigen::MatrixBase<Dest> &dest) const {
        eigen_assert(b.rows() == n_);
        typedef std::integral_constant<bool, std::is_same<typename Dest::Scalar, double>::value &&
                                                 (int(Dest::Flags) & Eigen::DirectAccessBit) != 0 &&
                                                 (int(Dest::Flags) & Eigen::RowMajorBit) == 0>
            is_plain;
        const auto &in_double = cast(b.derived()); /* a copy lives as long as this reference */
        const Input B(in_double);
        const sl_status status = ready_ ? ready_ : solve_into(dest.derived(), B, is_plain());
        set_status(status);
        if (status != SL_OK) dest.setConstant(nan<typename Dest::Scalar>());
    }

    /* Sparse right-hand sides, 8 at a time: the forward sweep visits what the rows of b reach. */
    template <class Rhs, class Dest>
    void _solve_impl(const Eigen::SparseMatrixBase<Rhs> &b,
                     Eigen::SparseMatrixBase<Dest> &dest) const {
        typedef Eigen::SparseMatrix<typename Dest::Scalar, Eigen::ColMajor, Eigen::Index> Result;
        const Columns B = b.derived().template cast<double>();
        Result X(n_, B.cols());
        sl_status status = SL_OK;
        for (Eigen::Index c = 0; c < B.cols(); c += 8) {
            const Eigen::Index width = std::min<Eigen::Index>(8, B.cols() - c);
            sl_status of_block = SL_OK;
            const Dense x = solve_columns(B, c, width, &of_block);
            if (status == SL_OK) status = of_block;
            for (Eigen::Index r = 0; r < width; r++) append(X, x.col(r), c + r);
        }
        X.finalize();
        set_status(ready_ ? ready_ : status);
        assign(dest.derived(), X, std::integral_constant<bool, Dest::ColsAtCompileTime == 1>());
    }

private:
    void init() {
        sl_options_init(&options_, sizeof options_);
        analyzed_with_ = options_;
        if (std::is_same<Ordering_, Eigen::NaturalOrdering<StorageIndex>>::value) {
            options_.ordering = SL_ORDERING_NATURAL;
        }
        stats_ = sl_stats();
        n_ = 0;
        ready_ = SL_ERR_STATE;
        analyses_ = 0;
        options_changed_ = false;
        shift_offset_ = 0;
        shift_scale_ = 1;
        status_.store(SL_ERR_STATE);
    }
    void forget() {
        factor_.reset();
        symbolic_.reset();
    }
    void set_status(sl_status status) const {
        status_.store(status);
    }
    /* After an error too, the solver has the size of A, and solves fail instead of asserting. */
    void report(sl_status status, const MatrixType &A) {
        this->m_isInitialized = true;
        n_ = A.rows();
        ready_ = status;
        set_status(status);
    }

    sl_status analyze(const sl_csc &A) {
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
        const sl_status status = is_pivoted_
                                     ? sl_symbolic_create_pivoted(&made, &A, &options, &stats_)
                                     : sl_symbolic_create(&made, &A, &options, &stats_);
        if (status != SL_OK) return status;
        symbolic_.reset(made, sl_symbolic_free);
        /* only the other triangle is stored: what is read would be a diagonal matrix */
        const sl_symbolic_info &read = stats_.symbolic;
        if (options.triangle != SL_TRIANGLE_NONE && read.components == read.n &&
            sl_off(A.p[A.n_cols]) > read.nnz_a) {
            forget();
            return SL_ERR_PATTERN;
        }
        analyzed_with_ = options_;
        analyses_++;
        return SL_OK;
    }
    /* Factors A over the analysis there is, if it is that of A, or over a new one. */
    sl_status factor_any(const sl_csc &A) {
        sl_status status = SL_ERR_OTHER_PATTERN;
        if (symbolic_ && is_analyzed_as_wanted()) status = factor_numbers(A);
        const bool is_refused = status == SL_ERR_PIVOT || status == SL_ERR_INACCURATE;
        if (status == SL_ERR_OTHER_PATTERN || (is_pivoted_ && is_refused)) {
            status = analyze(A);
            if (status == SL_OK) status = factor_numbers(A);
        }
        return status == SL_OK && is_llt ? refuse_negative() : status;
    }
    /* A factor that a region borrows keeps its numbers. */
    sl_status factor_numbers(const sl_csc &A) {
        if (factor_.use_count() == 1 && !options_changed_) {
            return sl_factor_refactor(factor_.get(), &A, &stats_);
        }
        sl_factor *made = nullptr;
        const sl_status status = sl_factor_create(&made, symbolic_.get(), &A, &options_, &stats_);
        factor_.reset();
        if (status == SL_OK) {
            /* the deleter keeps the analysis that the factor borrows */
            const std::shared_ptr<sl_symbolic> symbolic = symbolic_;
            factor_.reset(made, [symbolic](sl_factor *factor) { sl_factor_free(factor); });
            options_changed_ = false;
        }
        return status;
    }
    /* Whether the options of the analysis are those of the last one. */
    bool is_analyzed_as_wanted() const {
        const sl_options &a = analyzed_with_, &b = options_;
        return a.ordering == b.ordering && a.relaxation == b.relaxation && a.perm == b.perm &&
               a.metis_options == b.metis_options && a.block_size == b.block_size;
    }
    sl_status refuse_negative() {
        if (stats_.factor.negative == 0) return SL_OK;
        const double *D = sl_factor_view(factor_.get()).D;
        sl_int k = 0;
        while (!(D[k] < 0)) k++;
        stats_.error.row = sl_symbolic_view(symbolic_.get()).perm[k];
        stats_.error.value = D[k];
        factor_.reset();
        return SL_ERR_PIVOT;
    }

    template <class T> static T nan() {
        return std::numeric_limits<T>::quiet_NaN();
    }
    /* The library refuses a NULL, which an empty matrix has as its data. */
    static double *data(Dense &x) {
        static double nothing = 0;
        return x.size() ? x.data() : &nothing;
    }
    static const double *data(const Dense &x) {
        static const double nothing = 0;
        return x.size() ? x.data() : &nothing;
    }
    static std::size_t stride(const Dense &x) {
        return std::size_t(x.rows());
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
        if (status == SL_OK) status = fits ? call(x, work.get()) : SL_ERR_ARGUMENT;
        set_status(status);
        if (status != SL_OK) x.setConstant(nan<double>());
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
        return local(
            bset.size(n_) == b.rows(), xset.size(n_), b,
            [&](Dense &x, sl_work *work) {
                return sl_local_solve(factor_.get(), bset.data(), bset.count(), xset.data(),
                                      xset.count(), data(x), stride(x), data(b), stride(b),
                                      columns(b), work, nullptr);
            },
            result);
    }

    std::pair<double, double> logdet() const {
        std::pair<double, double> out(nan<double>(), nan<double>());
        set_status(ready_ ? ready_ : sl_factor_logdet(factor_.get(), &out.first, &out.second));
        return out;
    }

    /* b in double, without a copy if it is. */
    template <class Rhs>
    static typename std::enable_if<std::is_same<typename Rhs::Scalar, double>::value,
                                   const Rhs &>::type
    cast(const Rhs &b) {
        return b;
    }
    template <class Rhs>
    static typename std::enable_if<!std::is_same<typename Rhs::Scalar, double>::value, Dense>::type
    cast(const Rhs &b) {
        return b.template cast<double>();
    }

    typedef Eigen::SparseMatrix<double, Eigen::ColMajor, Eigen::Index> Columns;

    /* From column to column; a single column may come with any stride. */
    template <class Block> Eigen::Index stride_of(const Block &x) const {
        return x.cols() > 1 ? x.outerStride() : std::max<Eigen::Index>(n_, 1);
    }
    sl_status solve_block(double *x, Eigen::Index ldx, const Input &B) const {
        internal::LentWork work(work_);
        if (B.cols() > INT32_MAX) return SL_ERR_TOO_LARGE;
        return sl_factor_solve(factor_.get(), x, std::size_t(ldx), B.data(),
                               std::size_t(stride_of(B)), sl_int(B.cols()), work.get());
    }
    /* Writes into dest itself, if its columns are contiguous and it is B or apart from B. */
    template <class Dest>
    sl_status solve_into(Dest &dest, const Input &B, std::true_type) const {
        const Eigen::Index ldx = stride_of(dest), ldb = stride_of(B);
        if (dest.size() > 0 && dest.innerStride() == 1 && ldx >= n_ && ldb >= n_) {
            const double *x = dest.data(), *b = B.data();
            const std::less_equal<const double *> is_before = std::less_equal<const double *>();
            const Eigen::Index last = B.cols() - 1;
            if ((x == b && ldx == ldb) || is_before(x + ldx * last + n_, b) ||
                is_before(b + ldb * last + n_, x)) {
                return solve_block(dest.data(), ldx, B);
            }
        }
        return solve_into(dest, B, std::false_type());
    }
    template <class Dest>
    sl_status solve_into(Dest &dest, const Input &B, std::false_type) const {
        Dense x(n_, B.cols());
        if (x.size() == 0) return SL_OK;
        const sl_status status = solve_block(x.data(), n_, B);
        if (status == SL_OK) dest = x.template cast<typename Dest::Scalar>();
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
            if (x[i] != 0) X.insertBack(i, c) = typename Result::Scalar(x[i]);
        }
    }
    template <class Dest, class X> static void assign(Dest &dest, const X &x, std::false_type) {
        dest = x;
    }
    template <class Dest, class X> static void assign(Dest &dest, const X &x, std::true_type) {
        dest = x.col(0);
    }

    sl_options options_, analyzed_with_;
    bool is_pivoted_ = false;
    sl_stats stats_;
    Eigen::Index n_;
    sl_status ready_; /* SL_OK, or why there are no numbers */
    int analyses_;
    bool options_changed_;
    double shift_offset_, shift_scale_;
    mutable std::atomic<int> status_;
    mutable internal::WorkSlot work_;
    std::shared_ptr<sl_symbolic> symbolic_;
    std::shared_ptr<sl_factor> factor_;
};

/** P A P' = L D L' of definite, quasi-definite and other symmetric matrices without null pivots. */
template <class MatrixType, int UpLo = Eigen::Lower,
          class Ordering = Eigen::AMDOrdering<typename MatrixType::StorageIndex>>
using SimplicialLDLT = BasicSolver<MatrixType, UpLo, Ordering, false>;

/** The same, of positive definite matrices: a negative pivot is a NumericalIssue. */
template <class MatrixType, int UpLo = Eigen::Lower,
          class Ordering = Eigen::AMDOrdering<typename MatrixType::StorageIndex>>
using SimplicialLLT = BasicSolver<MatrixType, UpLo, Ordering, true>;

/** SimplicialLLT with the template arguments of Eigen::CholmodSupernodalLLT. */
template <class MatrixType, int UpLo = Eigen::Lower>
using CholmodSupernodalLLT = SimplicialLLT<MatrixType, UpLo>;

} // namespace sl

#endif

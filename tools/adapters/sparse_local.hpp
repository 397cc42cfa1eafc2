/* sparse_local.hpp: C++11 classes over sparse_local.h, each of which owns one object of the library
 *
 *     #include "sparse_local.hpp"                     next to sparse_local.h or on the include path
 *
 *     sl::Symbolic S(A);                              A is an sl_csc; once per pattern
 *     sl::Factor F(S, A);                             once per matrix
 *     std::vector<double> x;
 *     F.solve(x, b);                                  a full solve
 *     sl::Plan P(S, {17}, {4, 2});                    b in row 17, x wanted in rows 4 and 2
 *     P.solve(x, F, {1.0});                           any number of times
 *
 * One source file of the program also defines SL_WITH_ALL and SPARSE_LOCAL_IMPLEMENTATION and
 * includes sparse_local.h, or the program is linked with the compiled library. sparse_local.h has
 * the contracts of all calls; this file adds ownership, defaults and sizes.
 *
 * Errors      A failed call throws sl::Error. If SL_NO_EXCEPTIONS is defined, or the compiler has
 *             exceptions switched off, there are no constructors that can fail: create() takes
 *             their place, and the Status that every call returns has to be read. Files compiled
 *             in either way may be linked together.
 * Objects     can be moved and not copied. One that was made without arguments, or was moved from,
 *             is empty: calls refuse it with SL_ERR_ARGUMENT. After a failed create() the object is
 *             as it was. An object keeps what it was made from (sparse_local.h), so that they may
 *             be destroyed in any order.
 * Vectors     x has as many columns as right-hand sides, column-major; it is resized. A vector b
 *             whose size does not fit is refused with SL_ERR_ARGUMENT.
 * Threads     as in sparse_local.h: const calls may run at once, each with a Work of its own or
 *             with none.
 */
#ifndef SPARSE_LOCAL_HPP
#define SPARSE_LOCAL_HPP

#ifndef SL_WITH_ALL /* the classes use all packs */
#define SL_WITH_ALL
#endif
#include "sparse_local.h"

#include <cstddef>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <vector>

#if !defined(SL_NO_EXCEPTIONS) && !defined(__cpp_exceptions) && !defined(__EXCEPTIONS) && \
    !defined(_CPPUNWIND)
#define SL_NO_EXCEPTIONS
#endif

#ifdef SL_NO_EXCEPTIONS
#define SL_RESULT SL_WARN_UNUSED inline Status
#else
#define SL_RESULT inline Status
#endif

namespace sl {

/** Result of a call: its sl_status, and where the error is. */
class Status {
public:
    /** Of a call without stats, whose error is the last one of this thread. */
    Status(sl_status code = SL_OK) : code_(code) {
        clear();
        if (code != SL_OK) read(nullptr);
    }
    Status(sl_status code, const sl_stats &stats) : code_(code), where_(stats.error) {
        if (code != SL_OK) read(&stats);
    }
    /** Of a check by a class; what: static text. */
    Status(sl_status code, const char *what) : code_(code) {
        clear();
        where_.what = what;
        text_ = std::string(sl_status_string(code)) + ": " + what;
    }

    bool ok() const {
        return code_ == SL_OK;
    }
    sl_status code() const {
        return code_;
    }
    /** The caller's row, or -1. */
    sl_int row() const {
        return where_.row;
    }
    sl_int column() const {
        return where_.column;
    }
    /** The pivot or entry that was refused; 0 if none. */
    double value() const {
        return where_.value;
    }
    /** The reason, or what helps, as text; empty: a call without stats, whose message has it. */
    std::string advice() const {
        return where_.what != nullptr ? where_.what : "";
    }
    /** The sentence of sl_error_text: status, reason, row and column, as far as they apply. */
    std::string message() const {
        return text_.empty() ? sl_status_string(code_) : text_;
    }

private:
    void clear() {
        where_.row = where_.column = -1;
        where_.line = -1;
        where_.value = 0;
        where_.what = nullptr;
    }
    void read(const sl_stats *stats) {
        text_.resize(sl_error_text(nullptr, 0, code_, stats) + 1);
        sl_error_text(&text_[0], text_.size(), code_, stats);
        text_.pop_back();
    }

    sl_status code_;
    sl_error where_;
    std::string text_;
};

/** What a failed call throws. */
class Error : public std::runtime_error {
public:
    explicit Error(const Status &status) : std::runtime_error(status.message()), status_(status) {
    }
    const Status &status() const {
        return status_;
    }

private:
    Status status_;
};

/* Files with and without exceptions differ in what follows, and so do its names for the linker. */
#ifdef SL_NO_EXCEPTIONS
inline namespace returning {
#else
inline namespace throwing {
#endif

class Work;

namespace detail {
/* What the classes share and programs do not use. */
class Calls {
protected:
    static Status finish(const Status &status) {
#ifndef SL_NO_EXCEPTIONS
        if (!status.ok()) throw Error(status);
#endif
        return status;
    }
    /* Of a vector b whose size does not fit. */
    static Status wrong_size() {
        return Status(SL_ERR_ARGUMENT, "the size of b is not rows times nrhs, or nrhs is below 0");
    }
    static inline sl_work *work_of(const Work *work);
    /* The library refuses a NULL, which an empty vector may have as its data. */
    static double *data_of(std::vector<double> &v) {
        static double nothing = 0;
        return v.empty() ? &nothing : v.data();
    }
    static const double *data_of(const std::vector<double> &v) {
        static const double nothing = 0;
        return v.empty() ? &nothing : v.data();
    }
    /* Overloads, not an argument of Handle: calls are hidden if the bodies are in the same file,
     * and so would be the classes. */
    static void release(sl_work *object) {
        sl_work_free(object);
    }
    static void release(sl_matrix *object) {
        sl_matrix_free(object);
    }
    static void release(sl_symbolic *object) {
        sl_symbolic_free(object);
    }
    static void release(sl_factor *object) {
        sl_factor_free(object);
    }
    static void release(sl_selected *object) {
        sl_selected_free(object);
    }
    static void release(sl_region *object) {
        sl_region_free(object);
    }
    static void release(sl_plan *object) {
        sl_plan_free(object);
    }
};
} // namespace detail

/** Options with their defaults; the fields are those of sl_options. */
struct Options : sl_options {
    Options() {
        sl_options_init(this, sizeof(sl_options));
    }
};

/** View of a set of rows; does not own them. Rows::all() is every row, in ascending order. */
class Rows {
public:
    Rows() : Rows(nullptr, 0) {
    }
    Rows(const std::vector<sl_int> &rows) : Rows(rows.data(), rows.size()) {
    }
    /* valid until the end of the statement, as an argument of a call is */
    Rows(std::initializer_list<sl_int> rows) : Rows(rows.begin(), rows.size()) {
    }
    /* A count that does not fit becomes -2, which every call refuses. */
    Rows(const sl_int *rows, std::size_t count)
        : rows_(count ? rows : none()), count_(count > INT32_MAX ? -2 : sl_int(count)) {
    }
    static Rows all() {
        Rows every;
        every.rows_ = nullptr;
        every.count_ = SL_ALL;
        return every;
    }

    const sl_int *data() const {
        return rows_;
    }
    sl_int count() const {
        return count_;
    }
    /** The number of rows of the set in a matrix of n rows. */
    sl_int count(sl_int n) const {
        return rows_ ? count_ : n;
    }

private:
    /* An empty set is a pointer that is not NULL. */
    static const sl_int *none() {
        static const sl_int nothing = 0;
        return &nothing;
    }
    const sl_int *rows_;
    sl_int count_;
};

/** Owner of one object of the library. */
template <class T> class Handle : protected detail::Calls {
public:
    Handle() noexcept : object_(nullptr) {
    }
    Handle(Handle &&other) noexcept : object_(other.object_) {
        other.object_ = nullptr;
    }
    Handle &operator=(Handle &&other) noexcept {
        T *taken = other.object_;
        other.object_ = nullptr;
        reset(taken);
        return *this;
    }
    Handle(const Handle &) = delete;
    Handle &operator=(const Handle &) = delete;
    ~Handle() {
        release(object_);
    }

    /** The object for calls of sparse_local.h; NULL if empty. */
    T *get() const noexcept {
        return object_;
    }
    explicit operator bool() const noexcept {
        return object_ != nullptr;
    }
    /** Releases the object and owns another, which may be NULL. */
    void reset(T *object = nullptr) noexcept {
        if (object != object_) release(object_);
        object_ = object;
    }

protected:
    /* Keeps what a create call made, if it succeeded. */
    Status keep(T *made, const Status &status) {
        if (status.ok()) reset(made);
        return finish(status);
    }

private:
    T *object_;
};

/** Workspace of one thread. */
class Work : public Handle<sl_work> {
public:
    SL_RESULT create(const sl_options *options = nullptr) {
        sl_work *made = nullptr;
        sl_status status = sl_work_create(&made, options);
        return keep(made, status);
    }
    std::size_t bytes() const {
        return get() ? sl_work_bytes(get()) : 0;
    }
    /** As sl_work_reserve: what bytes() of another workspace was after the largest call. */
    SL_RESULT reserve(std::size_t bytes) {
        return finish(sl_work_reserve(get(), bytes));
    }
};

inline sl_work *detail::Calls::work_of(const Work *work) {
    return work ? work->get() : nullptr;
}

/** A sparse matrix that the library owns. */
class Matrix : public Handle<sl_matrix> {
public:
    SL_RESULT from_triplets(sl_int n_rows, sl_int n_cols, const std::vector<sl_int> &i,
                            const std::vector<sl_int> &j, const std::vector<double> &x,
                            const sl_options *options = nullptr) {
        sl_matrix *made = nullptr;
        sl_stats stats;
        if (i.size() != j.size() || i.size() != x.size()) {
            return finish(Status(SL_ERR_ARGUMENT, "i, j and x have different sizes"));
        }
        sl_status status = sl_matrix_from_triplets(&made, n_rows, n_cols, sl_off(i.size()),
                                                   Rows(i).data(), Rows(j).data(),
                                                   data_of(x), options, &stats);
        return keep(made, Status(status, stats));
    }
    /** A copy of 64-bit indices, as those of CHOLMOD's long interface. */
    SL_RESULT from_csc64(const sl_csc64 &A, const sl_options *options = nullptr) {
        sl_matrix *made = nullptr;
        sl_stats stats;
        sl_status status = sl_matrix_from_csc64(&made, &A, options, &stats);
        return keep(made, Status(status, stats));
    }
    SL_RESULT read(const std::string &path, const sl_options *options = nullptr) {
        sl_matrix *made = nullptr;
        sl_stats stats;
        sl_status status = sl_matrix_read(&made, path.c_str(), options, &stats);
        return keep(made, Status(status, stats));
    }
    /** The arrays, valid as long as the object; 0 x 0 if empty. */
    sl_csc view() const {
        return sl_matrix_view(get());
    }
};

/** The analysis of a pattern. */
class Symbolic : public Handle<sl_symbolic> {
public:
    Symbolic() = default;
#ifndef SL_NO_EXCEPTIONS
    explicit Symbolic(const sl_csc &A, const sl_options *options = nullptr) {
        create(A, options);
    }
#endif
    SL_RESULT create(const sl_csc &A, const sl_options *options = nullptr) {
        sl_symbolic *made = nullptr;
        sl_stats stats;
        sl_status status = sl_symbolic_create(&made, &A, options, &stats);
        return keep(made, Status(status, stats));
    }
    /** The same with 1x1 and 2x2 pivots by the values of A, for indefinite matrices. */
    SL_RESULT create_pivoted(const sl_csc &A, const sl_options *options = nullptr) {
        sl_symbolic *made = nullptr;
        sl_stats stats;
        sl_status status = sl_symbolic_create_pivoted(&made, &A, options, &stats);
        return keep(made, Status(status, stats));
    }
    /** Rows of the matrix; 0 if empty. */
    sl_int n() const {
        return get() ? view().n : 0;
    }
    sl_symbolic_arrays view() const {
        return sl_symbolic_view(get());
    }
    sl_symbolic_info info() const {
        return sl_symbolic_view(get()).info;
    }
};

/** L and D of one matrix. */
class Factor : public Handle<sl_factor> {
public:
    Factor() = default;
#ifndef SL_NO_EXCEPTIONS
    Factor(const Symbolic &S, const sl_csc &A, const sl_options *options = nullptr) {
        create(S, A, options);
    }
#endif
    SL_RESULT create(const Symbolic &S, const sl_csc &A, const sl_options *options = nullptr) {
        sl_factor *made = nullptr;
        sl_stats stats;
        sl_status status = sl_factor_create(&made, S.get(), &A, options, &stats);
        return keep(made, Status(status, stats));
    }
    /** New values. After SL_ERR_PIVOT or SL_ERR_NOT_FINITE solves are refused. */
    SL_RESULT refactor(const sl_csc &A) {
        sl_stats stats;
        sl_status status = sl_factor_refactor(get(), &A, &stats);
        return finish(Status(status, stats));
    }
    /** Changes by columns of A: the columns of L that they reach are computed again. */
    SL_RESULT change_entries(const sl_csc &A, const Rows &columns) {
        sl_stats stats;
        sl_status status =
            sl_factor_change_entries(get(), &A, nullptr, columns.data(), nullptr,
                                     columns.count(), nullptr, &stats);
        return finish(Status(status, stats));
    }

    SL_RESULT solve(double *X, std::size_t ldx, const double *B, std::size_t ldb, sl_int nrhs,
                    Work *work = nullptr) const {
        return finish(sl_factor_solve(get(), X, ldx, B, ldb, nrhs, work_of(work)));
    }
    /** x = A^-1 b for b of n * nrhs numbers; x may be b. */
    SL_RESULT solve(std::vector<double> &x, const std::vector<double> &b, sl_int nrhs = 1,
                    Work *work = nullptr) const {
        std::size_t rows = std::size_t(n());
        if (nrhs < 0 || b.size() != rows * std::size_t(nrhs)) return finish(wrong_size());
        x.resize(b.size());
        return solve(data_of(x), rows, data_of(b), rows, nrhs, work);
    }
    /** A local solve without a plan: b on bset, x wanted on xset; x may be b. */
    SL_RESULT local_solve(std::vector<double> &x, const Rows &bset, const std::vector<double> &b,
                          const Rows &xset, sl_int nrhs = 1, Work *work = nullptr) const {
        std::size_t nb = std::size_t(bset.count(n())), nx = std::size_t(xset.count(n()));
        std::vector<double> result;
        sl_stats stats;
        if (nrhs < 0 || bset.count() < SL_ALL || xset.count() < SL_ALL ||
            b.size() != nb * std::size_t(nrhs))
            return finish(wrong_size());
        result.resize(nx * std::size_t(nrhs));
        sl_status status = sl_local_solve(get(), bset.data(), bset.count(), xset.data(),
                                          xset.count(), data_of(result), nx, data_of(b), nb, nrhs,
                                          work_of(work), &stats);
        if (status == SL_OK) x.swap(result);
        return finish(Status(status, stats));
    }

    /** A half or another part of a solve: parts is a sum of SL_PART_..., b has n * nrhs numbers. */
    SL_RESULT solve_part(std::vector<double> &x, unsigned parts, const std::vector<double> &b,
                         sl_int nrhs = 1, Work *work = nullptr) const {
        const auto whole = [](const sl_factor *F, unsigned bits, double *X, std::size_t ldx,
                              const double *B, std::size_t ldb, sl_int count, sl_work *W) {
            return sl_factor_solve_part(F, nullptr, bits, X, ldx, B, ldb, count, W);
        };
        return part(whole, x, parts, b, nrhs, work);
    }
    /** The product with the same parts. */
    SL_RESULT multiply_part(std::vector<double> &x, unsigned parts, const std::vector<double> &b,
                            sl_int nrhs = 1, Work *work = nullptr) const {
        return part(sl_factor_multiply_part, x, parts, b, nrhs, work);
    }

    /** Diagonal entries of the inverse, in the order of rows. */
    SL_RESULT inverse_diagonal(std::vector<double> &out, const Rows &rows,
                               Work *work = nullptr) const {
        sl_stats stats;
        if (rows.count() < SL_ALL) {
            return finish(Status(SL_ERR_ARGUMENT, "there are 2^31 rows or more"));
        }
        std::vector<double> result(std::size_t(rows.count(n())));
        sl_status status = sl_inverse_diagonal(get(), data_of(result), rows.data(), rows.count(),
                                               work_of(work), &stats);
        if (status == SL_OK) out.swap(result);
        return finish(Status(status, stats));
    }
    SL_RESULT logdet(double &log_abs_det, double &sign) const {
        return finish(sl_factor_logdet(get(), &log_abs_det, &sign));
    }
    /** An estimate of 1 / (||A|| ||A^-1||). */
    SL_RESULT rcond(double &out, const sl_csc &A, Work *work = nullptr) const {
        return finish(sl_factor_rcond(get(), &A, &out, work_of(work)));
    }

    /** Finds eta, the largest relative error of any solve in the energy norm, for
     *  Plan::solve_bounded; A is the factored matrix. EXPERIMENTAL, as in C. */
    SL_RESULT certify(double &eta, const sl_csc &A, sl_certainty certainty = SL_ESTIMATED,
                      Work *work = nullptr) {
        sl_stats stats = sl_stats();
        sl_status status = sl_factor_certify(get(), &A, certainty, work_of(work), &stats);
        eta = stats.certificate.eta;
        return finish(Status(status, stats));
    }

    /** Rows of the matrix; 0 if empty. */
    sl_int n() const {
        return get() ? sl_symbolic_view(view().symbolic).n : 0;
    }
    sl_factor_arrays view() const {
        return sl_factor_view(get());
    }
    sl_factor_info info() const {
        return sl_factor_view(get()).info;
    }

private:
    template <class Call>
    SL_RESULT part(Call call, std::vector<double> &x, unsigned parts, const std::vector<double> &b,
                   sl_int nrhs, Work *work) const {
        std::size_t rows = std::size_t(n());
        if (nrhs < 0 || b.size() != rows * std::size_t(nrhs)) return finish(wrong_size());
        x.resize(b.size());
        return finish(call(get(), parts, data_of(x), rows, data_of(b), rows, nrhs, work_of(work)));
    }
};

/** The selected inverse. */
class Selected : public Handle<sl_selected> {
public:
    SL_RESULT create(const Factor &F, const Rows &set, const sl_options *options = nullptr) {
        sl_selected *made = nullptr;
        sl_stats stats;
        sl_status status =
            sl_selected_create(&made, F.get(), set.data(), set.count(), options, &stats);
        return keep(made, Status(status, stats));
    }
    SL_RESULT refactor(const Factor &F, Work *work = nullptr) {
        return finish(sl_selected_refactor(get(), F.get(), work_of(work)));
    }
};

/** A part of the matrix in which the cost of local solves does not depend on the whole. */
class Region : public Handle<sl_region> {
public:
    Region() = default;
#ifndef SL_NO_EXCEPTIONS
    Region(const Factor &F, const Rows &set, const Selected *Z = nullptr,
           const sl_options *options = nullptr) {
        create(F, set, Z, options);
    }
#endif
    /** Z: NULL, or a selected inverse, which is used if it has all entries that are needed. */
    SL_RESULT create(const Factor &F, const Rows &set, const Selected *Z = nullptr,
                     const sl_options *options = nullptr) {
        sl_region *made = nullptr;
        sl_stats stats;
        sl_status status = sl_region_create(&made, F.get(), set.data(), set.count(),
                                            Z ? Z->get() : nullptr, options, &stats);
        return keep(made, Status(status, stats));
    }
    SL_RESULT refactor(const Factor &F, const Selected *Z = nullptr, Work *work = nullptr) {
        return finish(
            sl_region_refactor(get(), F.get(), Z ? Z->get() : nullptr, work_of(work)));
    }
    sl_region_info info() const {
        return sl_region_view(get()).info;
    }
};

/** A prepared local solve. */
class Plan : public Handle<sl_plan> {
public:
    Plan() : nb_(0), nx_(0) {
    }
#ifndef SL_NO_EXCEPTIONS
    Plan(const Symbolic &S, const Rows &bset, const Rows &xset, const Region *region = nullptr,
         const sl_options *options = nullptr)
        : Plan() {
        create(S, bset, xset, region, options);
    }
#endif
    /** region: NULL, or one that the plan keeps. */
    SL_RESULT create(const Symbolic &S, const Rows &bset, const Rows &xset,
                     const Region *region = nullptr, const sl_options *options = nullptr) {
        sl_plan *made = nullptr;
        sl_stats stats;
        Options with_region;
        if (options) static_cast<sl_options &>(with_region) = *options;
        if (region) with_region.region = region->get();
        sl_status status = sl_plan_create(&made, S.get(), bset.data(), bset.count(), xset.data(),
                                          xset.count(), &with_region, &stats);
        if (status == SL_OK) {
            nb_ = bset.count(S.n());
            nx_ = xset.count(S.n());
        }
        return keep(made, Status(status, stats));
    }
    SL_RESULT solve(const Factor &F, double *X, std::size_t ldx, const double *B, std::size_t ldb,
                    sl_int nrhs, Work *work = nullptr) const {
        return finish(sl_plan_solve(get(), F.get(), X, ldx, B, ldb, nrhs, work_of(work)));
    }
    /** x on the x-set for b of nb * nrhs numbers on the b-set; x may be b. */
    SL_RESULT solve(std::vector<double> &x, const Factor &F, const std::vector<double> &b,
                    sl_int nrhs = 1, Work *work = nullptr) const {
        std::size_t nb = std::size_t(nb_), nx = std::size_t(nx_);
        if (nrhs < 0 || b.size() != nb * std::size_t(nrhs)) return finish(wrong_size());
        std::vector<double> result(nx * std::size_t(nrhs));
        sl_status status = sl_plan_solve(get(), F.get(), data_of(result), nx,
                                         data_of(b), nb, nrhs, work_of(work));
        if (status == SL_OK) x.swap(result);
        return finish(status);
    }
    /** The same, and a bound for the error of each number; F is certified. scales keeps what the
     *  bounds need of the plan and the numbers of F: an empty vector at first. EXPERIMENTAL. */
    SL_RESULT solve_bounded(std::vector<double> &x, std::vector<double> &bounds, const Factor &F,
                            const std::vector<double> &b, std::vector<double> &scales,
                            sl_int nrhs = 1, Work *work = nullptr) const {
        std::size_t nb = std::size_t(nb_), nx = std::size_t(nx_);
        if (nrhs < 0 || b.size() != nb * std::size_t(nrhs)) return finish(wrong_size());
        std::vector<double> result(nx * std::size_t(nrhs)), errors(result.size());
        sl_stats stats;
        scales.resize(4 * nx + 2);
        sl_status status = sl_plan_solve_bounded(get(), F.get(), data_of(result), nx,
                                                 data_of(errors), data_of(b), nb, nrhs,
                                                 data_of(scales), work_of(work), &stats);
        if (status == SL_OK) {
            x.swap(result);
            bounds.swap(errors);
        }
        return finish(Status(status, stats));
    }
    /** The forward half (SL_PART_P + L), whose x has info().b_columns rows, or the backward half
     *  (SL_PART_LT + PT), whose b has info().x_columns rows; either with D or SQRT_D. */
    SL_RESULT solve_part(std::vector<double> &x, const Factor &F, unsigned parts,
                         const std::vector<double> &b, sl_int nrhs = 1,
                         Work *work = nullptr) const {
        const bool is_forward = (parts & SL_PART_P) != 0;
        std::size_t nb = std::size_t(is_forward ? nb_ : info().x_columns);
        std::size_t nx = std::size_t(is_forward ? info().b_columns : nx_);
        if (nrhs < 0 || b.size() != nb * std::size_t(nrhs)) return finish(wrong_size());
        std::vector<double> result(nx * std::size_t(nrhs));
        sl_status status = sl_factor_solve_part(F.get(), get(), parts, data_of(result), nx,
                                              data_of(b), nb, nrhs, work_of(work));
        if (status == SL_OK) x.swap(result);
        return finish(status);
    }
    /** The columns of L, ascending, that are the rows of half solves: SL_PART_L or SL_PART_LT. */
    SL_RESULT columns(std::vector<sl_int> &out, sl_part part) const {
        sl_int count = 0;
        sl_status status = sl_plan_columns(get(), part, nullptr, 0, &count);
        if (status != SL_OK) return finish(status);
        out.resize(std::size_t(count));
        return finish(sl_plan_columns(get(), part, out.data(), count, &count));
    }
    /** Rows of the b-set and of the x-set. */
    sl_int nb() const {
        return nb_;
    }
    sl_int nx() const {
        return nx_;
    }
    sl_plan_info info() const {
        sl_stats stats = sl_stats();
        if (get()) sl_plan_stats(get(), &stats);
        return stats.plan;
    }

private:
    sl_int nb_, nx_;
};

} // inline namespace
} // namespace sl

#undef SL_RESULT

#endif

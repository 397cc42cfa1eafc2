/* test_raii.cpp: tools/adapters/sparse_local.hpp: objects, answers, and errors as exceptions or as
 * statuses; compiled twice, also with -fno-exceptions */
#include "tools/adapters/sparse_local.hpp"

#ifdef SL_RESULT
#error "a macro of the header's own is left to programs"
#endif

#include "check.hpp"

#include <cmath>
#include <cstdint>
#include <utility>

namespace {

using check::Grid;

/* Whether a call fails with a code at a row; both modes have one form in the tests below. */
template <class Call> bool fails(sl_status code, sl_int row, const Call &call) {
#ifdef SL_NO_EXCEPTIONS
    sl::Status status = call();
    return status.code() == code && status.row() == row;
#else
    try {
        call();
    } catch (const sl::Error &error) {
        return error.status().code() == code && error.status().row() == row &&
               error.what() == error.status().message();
    }
    return false;
#endif
}

/* What a call that fails says. */
template <class Call> std::string message_of(const Call &call) {
#ifdef SL_NO_EXCEPTIONS
    return call().message();
#else
    try {
        call();
    } catch (const sl::Error &error) {
        return error.what();
    }
    return "";
#endif
}

/* A grid with its analysis and factor. */
struct Factored {
    explicit Factored(int side = 12, double shift = 0.1) : grid(side, shift) {
        made = S.create(grid.view()).ok() && F.create(S, grid.view()).ok();
    }
    /* The largest |b - A x|. */
    double residual(const std::vector<double> &x, const std::vector<double> &b) const {
        std::vector<double> r(b.size());
        double largest = 0;
        const sl_csc A = grid.view();
        if (sl_csc_residual(&A, r.data(), r.size(), nullptr, x.data(), x.size(), b.data(), b.size(),
                            1) != SL_OK) {
            return 1e300;
        }
        for (double value : r)
            largest = std::fmax(largest, std::fabs(value));
        return largest;
    }
    Grid grid;
    sl::Symbolic S;
    sl::Factor F;
    bool made;
};

std::vector<double> some_numbers(sl_int count) {
    std::vector<double> b;
    for (sl_int k = 0; k < count; k++)
        b.push_back(std::sin(1.0 + k));
    return b;
}

void full_solve() {
    Factored f;
    const std::vector<double> b = some_numbers(f.grid.n);
    std::vector<double> x;
    sl::Work work;
    CHECK(f.made && f.S.n() == 144 && f.F.n() == 144);
    CHECK(f.F.solve(x, b).ok());
    CHECK(f.residual(x, b) < 1e-13);
    /* in place, in a workspace */
    std::vector<double> y = b;
    CHECK(work.create().ok() && f.F.solve(y, y, 1, &work).ok());
    CHECK(y == x && work.bytes() > 0);
    sl::Work reserved;
    CHECK(reserved.create().ok() && reserved.reserve(work.bytes()).ok());
    CHECK(f.F.solve(y, b, 1, &reserved).ok() && reserved.bytes() == work.bytes());
}

void local_solves() {
    Factored f;
    std::vector<double> b(144, 0.0), full, part;
    b[17] = 2;
    b[100] = -1;
    CHECK(f.made && f.F.solve(full, b).ok());
    CHECK(f.F.local_solve(part, {17, 100}, {2.0, -1.0}, {5, 143, 5}).ok());
    CHECK(part.size() == 3 && part[0] == full[5] && part[1] == full[143] && part[2] == full[5]);
    CHECK(f.F.local_solve(part, {17, 100}, {2.0, -1.0}, sl::Rows::all()).ok() && part == full);
    CHECK(f.F.local_solve(part, {}, {}, {5}).ok() && part == std::vector<double>(1, 0.0));
    CHECK(f.F.local_solve(part, {17}, {1.0}, {}).ok() && part.empty());
}

void plans() {
    Factored f;
    sl::Plan P;
    std::vector<double> b(144, 0.0), full, x;
    b[3] = 1;
    CHECK(f.made && P.create(f.S, {3}, {140, 7}).ok());
    CHECK(P.nb() == 1 && P.nx() == 2 && P.info().b_columns > 0);
    CHECK(f.F.solve(full, b).ok() && P.solve(x, f.F, {1.0}).ok());
    CHECK(x[0] == full[140] && x[1] == full[7]);
    /* two right-hand sides; a plan survives a refactorization */
    for (double &value : f.grid.x)
        value *= 2;
    CHECK(f.F.refactor(f.grid.view()).ok() && P.solve(x, f.F, {1.0, 2.0}, 2).ok());
    CHECK(std::fabs(x[0] - 0.5 * full[140]) < 1e-14 && std::fabs(x[2] - full[140]) < 1e-14);
}

void parts_of_solves() {
    Factored f;
    sl::Plan P;
    const std::vector<double> b = some_numbers(144);
    std::vector<double> x, half, rest;
    std::vector<sl_int> columns;
    CHECK(f.made && f.F.solve(x, b).ok());
    CHECK(f.F.solve_part(half, SL_PART_P | SL_PART_L, b).ok());
    CHECK(f.F.solve_part(rest, SL_PART_D | SL_PART_LT | SL_PART_PT, half).ok() && rest == x);
    CHECK(f.F.multiply_part(rest, SL_PART_L | SL_PART_PT, half).ok());
    CHECK(std::fabs(rest[7] - b[7]) < 1e-13);
    /* the forward half of a local solve, and the backward half */
    CHECK(P.create(f.S, {3}, {140, 7}).ok() && P.columns(columns, SL_PART_L).ok());
    CHECK(sl_int(columns.size()) == P.info().b_columns);
    std::vector<double> unit(144, 0.0);
    unit[3] = 1;
    CHECK(f.F.solve_part(half, SL_PART_P | SL_PART_L, unit).ok());
    CHECK(P.solve_part(x, f.F, SL_PART_P | SL_PART_L, {1.0}).ok());
    for (std::size_t k = 0; k < columns.size(); k++) {
        CHECK(x[k] == half[std::size_t(columns[k])]);
    }
    CHECK(P.columns(columns, SL_PART_LT).ok());
    rest.clear();
    for (sl_int column : columns)
        rest.push_back(b[std::size_t(column)]);
    CHECK(f.F.solve_part(half, SL_PART_LT | SL_PART_PT, b).ok());
    CHECK(P.solve_part(x, f.F, SL_PART_LT | SL_PART_PT, rest).ok());
    CHECK(x.size() == 2 && x[0] == half[140] && x[1] == half[7]);
    CHECK(fails(SL_ERR_ARGUMENT, -1, [&] { return f.F.solve_part(x, 64, b); }));
    CHECK(fails(SL_ERR_ARGUMENT, -1, [&] { return P.solve_part(x, f.F, SL_PART_P, {1.0}); }));
}

void regions() {
    Factored f(20);
    sl::Region R;
    sl::Plan P, outside;
    std::vector<double> x, full;
    CHECK(f.made && R.create(f.F, {100, 101, 120, 121}).ok() && R.info().rows >= 4);
    CHECK(P.create(f.S, {100}, {121}, &R).ok() && P.info().in_region == 1);
    CHECK(f.F.local_solve(full, {100}, {1.0}, {121}).ok() && P.solve(x, f.F, {1.0}).ok());
    CHECK(std::fabs(x[0] - full[0]) < 1e-14);
    CHECK(f.F.refactor(f.grid.view()).ok());
    CHECK(fails(SL_ERR_STALE, -1, [&] { return P.solve(x, f.F, {1.0}); }));
    CHECK(R.refactor(f.F).ok() && P.solve(x, f.F, {1.0}).ok());
    sl::Selected Z;
    sl::Options least;
    least.region_bytes = 1; /* a region without boundary */
    CHECK(R.info().boundary > 0 && Z.create(f.F, sl::Rows::all()).ok());
    CHECK(R.create(f.F, {100, 101}, &Z, &least).ok() && R.info().boundary == 0);
    least.region_bytes = 0;
    least.reserved[0] = 1;
    CHECK(fails(SL_ERR_ARGUMENT, -1, [&] { return R.create(f.F, {100}, nullptr, &least); }));
}

void bounds() {
    Factored f(20);
    sl::Plan P, other;
    std::vector<double> x, plain, errors, again, scales;
    double eta = 0;
    CHECK(f.made && P.create(f.S, {100}, {121, 3, 100}).ok());
    CHECK(fails(SL_ERR_STALE, -1, [&] { return P.solve_bounded(x, errors, f.F, {1.0}, scales); }));
    CHECK(f.F.certify(eta, f.grid.view()).ok() && eta > 0 && eta < 1e-12);
    CHECK(P.solve_bounded(x, errors, f.F, {1.0}, scales).ok() && errors.size() == 3);
    CHECK(P.solve(plain, f.F, {1.0}).ok() && plain == x);
    CHECK(errors[2] > 0 && errors[2] < 1e-12 * x[2]);
    CHECK(P.solve_bounded(x, again, f.F, {1.0}, scales).ok() && again == errors);
    CHECK(f.F.certify(eta, f.grid.view(), SL_GUARANTEED).ok() && eta > 0 && eta < 1e-8);
    CHECK(other.create(f.S, {3}, {121, 3, 100}).ok());
    CHECK(other.solve_bounded(x, again, f.F, {1.0, 2.0}, scales, 2).ok() && again.size() == 6);
    CHECK(fails(SL_ERR_ARGUMENT, -1, [&] { return P.solve_bounded(x, again, f.F, {}, scales); }));
}

void inverse() {
    Factored f(5);
    std::vector<double> diagonal, column, all;
    double log_det = 0, sign = 0, rcond = 0;
    CHECK(f.made && f.F.inverse_diagonal(diagonal, {7}).ok());
    CHECK(f.F.local_solve(column, {7}, {1.0}, {7}).ok());
    CHECK(std::fabs(column[0] - diagonal[0]) < 1e-14);
    CHECK(f.F.inverse_diagonal(all, sl::Rows::all()).ok() && all.size() == 25);
    CHECK(f.F.logdet(log_det, sign).ok() && sign == 1 && std::isfinite(log_det));
    CHECK(f.F.rcond(rcond, f.grid.view()).ok() && rcond > 0.001 && rcond < 0.1);
}

void selected() {
    Factored f(6);
    sl::Selected Z;
    std::vector<double> one;
    double value = 0;
    const sl_int row = 30;
    CHECK(f.made && Z.create(f.F, sl::Rows::all()).ok());
    CHECK(sl_selected_entries(Z.get(), &value, &row, NULL, 1, nullptr) == SL_OK);
    CHECK(f.F.inverse_diagonal(one, {30}).ok() && std::fabs(one[0] - value) < 1e-14);
    CHECK(Z.refactor(f.F).ok());
}

void matrices() {
    sl::Matrix M;
    CHECK(M.view().n_rows == 0);
    CHECK(M.from_triplets(2, 2, {0, 1, 1}, {0, 0, 1}, {4, 1, 3}).ok() && M.view().p[2] == 3);
    CHECK(M.from_triplets(3, 3, {}, {}, {}).ok() && M.view().p[3] == 0);
    CHECK(fails(SL_ERR_ARGUMENT, -1, [&] { return M.from_triplets(2, 2, {0}, {0, 1}, {1}); }));
    CHECK(M.view().n_rows == 3); /* as it was */
    const std::int64_t p[] = {0, 2, 3}, i[] = {0, 1, 1}, outside[] = {0, 2, 1};
    const double x[] = {4, 1, 3};
    CHECK(M.from_csc64({2, 2, p, i, x}).ok() && M.view().n_rows == 2 && M.view().p[2] == 3);
    CHECK(M.view().i[1] == 1 && M.view().x[2] == 3);
    CHECK(fails(SL_ERR_MALFORMED, 2, [&] { return M.from_csc64({2, 2, p, outside, x}); }));
    CHECK(M.from_csc64({2, 2, p, i, nullptr}).ok() && M.view().x == nullptr);
    CHECK(fails(SL_ERR_IO, -1, [&] { return M.read("no such file"); }));
}

void moves() {
    Factored f;
    std::vector<double> x, y;
    const std::vector<double> b = some_numbers(144);
    CHECK(f.made && f.F.solve(x, b).ok());
    sl::Symbolic S = std::move(f.S);
    sl::Factor F = std::move(f.F);
    CHECK(!f.F && F && S.n() == 144);
    CHECK(F.solve(y, b).ok() && y == x);
    CHECK(fails(SL_ERR_ARGUMENT, -1, [&] { return f.F.solve(y, b); }));
    sl::Factor &same = F;
    F = std::move(same);
    F.reset();
    CHECK(!F && F.n() == 0);
}

void wrong_arguments() {
    Factored f;
    sl::Plan P;
    sl::Symbolic S;
    sl::Factor empty;
    std::vector<double> x;
    CHECK(f.made);
    CHECK(fails(SL_ERR_ARGUMENT, -1, [&] { return f.F.solve(x, {1.0, 2.0}); }));
    CHECK(fails(SL_ERR_ARGUMENT, -1, [&] { return f.F.solve(x, some_numbers(144), -1); }));
    CHECK(fails(SL_ERR_ARGUMENT, -1, [&] { return f.F.local_solve(x, {1}, {1.0, 2.0}, {2}); }));
    CHECK(fails(SL_ERR_ARGUMENT, 144, [&] { return f.F.local_solve(x, {144}, {1.0}, {2}); }));
    CHECK(fails(SL_ERR_ARGUMENT, -1, [&] { return P.create(S, {0}, {0}); }));
    CHECK(fails(SL_ERR_ARGUMENT, -1, [&] { return empty.create(S, f.grid.view()); }));
    CHECK(fails(SL_ERR_ARGUMENT, -1, [&] { return P.solve(x, f.F, {}); }));
    CHECK(fails(SL_ERR_ARGUMENT, -1, [&] { return empty.inverse_diagonal(x, {}); }));
}

void wrong_matrices() {
    Grid grid(4, 0.1);
    sl::Symbolic S;
    sl::Factor F;
    sl_csc A = grid.view();
    A.n_rows = 17;
    CHECK(fails(SL_ERR_ARGUMENT, -1, [&] { return S.create(A); }));
    A = grid.view();
    grid.i[2] = 99;
    CHECK(fails(SL_ERR_MALFORMED, 99, [&] { return S.create(A); }));
    grid = Grid(4, 0.0); /* singular: the last pivot is null, whichever row that is */
    A = grid.view();
    CHECK(S.create(A).ok());
#ifdef SL_NO_EXCEPTIONS
    const sl::Status status = F.create(S, A);
#else
    sl::Status status;
    try {
        F.create(S, A);
    } catch (const sl::Error &error) {
        status = error.status();
    }
#endif
    CHECK(status.code() == SL_ERR_PIVOT && status.row() >= 0 && status.row() < 16 && !F);
    CHECK(status.message().find("row") != std::string::npos);
    sl::Options skip;
    skip.pivots = SL_PIVOTS_SKIP_NULL;
    CHECK(F.create(S, A, &skip).ok() && F.info().null == 1);
    grid.x[0] = NAN;
    CHECK(fails(SL_ERR_NOT_FINITE, 0, [&] { return F.refactor(A); }));
    std::vector<double> x, b(16, 1.0);
    CHECK(fails(SL_ERR_STALE, -1, [&] { return F.solve(x, b); })); /* it has no numbers */
}

void no_rows() {
    const sl_int p = 0, i = 0;
    const double value = 0;
    const sl_csc A = {0, 0, &p, &i, &value};
    sl::Symbolic S;
    sl::Factor F;
    std::vector<double> x(3);
    CHECK(S.create(A).ok() && F.create(S, A).ok());
    CHECK(F.solve(x, {}).ok() && x.empty());
    CHECK(F.inverse_diagonal(x, sl::Rows::all()).ok() && x.empty());
}

/* [0 1; 1 0] in one word; in the order of the pattern the refusal names the call. */
void chosen_pivots() {
    const sl_int p[3] = {0, 2, 3}, i[3] = {0, 1, 1};
    const double x[3] = {0.0, 1.0, 0.0};
    const sl_csc A = {2, 2, p, i, x};
    sl::Symbolic S;
    sl::Factor F;
    std::vector<double> y;
    CHECK(S.create(A).ok());
    CHECK(fails(SL_ERR_PIVOT, 0, [&] { return F.create(S, A); }));
#ifdef SL_NO_EXCEPTIONS
    const sl::Status refused = F.create(S, A);
    CHECK(refused.advice().find("create_pivoted") != std::string::npos);
    CHECK(refused.message().find(refused.advice()) != std::string::npos);
    CHECK(sl::Status().advice().empty());
#endif
    CHECK(S.create_pivoted(A).ok() && S.info().pairs == 1 && F.create(S, A).ok());
    CHECK(F.solve(y, {3.0, 4.0}).ok() && y[0] == 4.0 && y[1] == 3.0);
    const sl_csc none = {2, 2, p, i, nullptr};
    CHECK(fails(SL_ERR_ARGUMENT, -1, [&] { return S.create_pivoted(none); }));
}

/* Also calls without statistics have a reason, and checks of the classes theirs. */
void messages() {
    Factored f;
    sl::Factor none;
    std::vector<double> x;
    CHECK(message_of([&] { return none.solve(x, {}); }) == "invalid argument: F is NULL");
    CHECK(message_of([&] { return f.F.solve(x, {1.0}); }).find("invalid argument: the size of b") ==
          0);
    CHECK(message_of([&] {
              return f.F.inverse_diagonal(x, {3, 144});
          }) == "invalid argument: a row is out of range (row 144)");
    CHECK(sl::Status().message() == "ok");
}

} // namespace

int main() {
    return check::run({{"full_solve", full_solve},
                       {"local_solves", local_solves},
                       {"plans", plans},
                       {"parts_of_solves", parts_of_solves},
                       {"regions", regions},
                       {"bounds", bounds},
                       {"inverse", inverse},
                       {"selected", selected},
                       {"matrices", matrices},
                       {"moves", moves},
                       {"wrong_arguments", wrong_arguments},
                       {"wrong_matrices", wrong_matrices},
                       {"no_rows", no_rows},
                       {"messages", messages},
                       {"chosen_pivots", chosen_pivots}});
}

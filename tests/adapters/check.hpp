/* check.hpp: the tests of the C++ adapters: a test is a function, a failed CHECK ends it */
#ifndef SL_TESTS_ADAPTERS_CHECK_HPP
#define SL_TESTS_ADAPTERS_CHECK_HPP

#include "sparse_local.h"

#include <cstdio>
#include <vector>

namespace check {

struct Failure {
    const char *text, *file;
    int line;
};

/* Notes the first failure of the present test; CHECK returns from it. */
inline Failure &failure() {
    static Failure first = {nullptr, nullptr, 0};
    return first;
}

struct Test {
    const char *name;
    void (*run)();
};

/* Runs the tests and prints the counts in the form that tests/lib/run.sh reads. */
inline int run(const std::vector<Test> &tests) {
    int failed = 0;
    for (const Test &test : tests) {
        failure() = Failure{nullptr, nullptr, 0};
        test.run();
        if (!failure().text) continue;
        failed++;
        std::printf("%s: %s:%d: %s\n", test.name, failure().file, failure().line, failure().text);
    }
    std::printf("%d passed, %d failed\n", int(tests.size()) - failed, failed);
    return failed != 0;
}

/* The lower triangle of the Laplacian of a grid of side x side vertices, plus shift. */
struct Grid {
    Grid(int side, double shift) : n(side * side) {
        p.push_back(0);
        for (int v = 0; v < n; v++) {
            bool has_right = (v + 1) % side != 0, has_below = v + side < n;
            int degree = has_right + has_below + (v % side != 0) + (v >= side);
            add(v, degree + shift);
            if (has_right) add(v + 1, -1);
            if (has_below) add(v + side, -1);
            p.push_back(sl_int(i.size()));
        }
    }
    sl_csc view() const {
        sl_csc A = {n, n, p.data(), i.data(), x.data()};
        return A;
    }
    sl_int n;
    std::vector<sl_int> p, i;
    std::vector<double> x;

private:
    void add(int row, double value) {
        i.push_back(row);
        x.push_back(value);
    }
};

} // namespace check

#define CHECK(condition)                                                                           \
    do {                                                                                           \
        if (!(condition)) {                                                                        \
            if (!check::failure().text) {                                                          \
                check::failure() = check::Failure{#condition, __FILE__, __LINE__};                 \
            }                                                                                      \
            return;                                                                                \
        }                                                                                          \
    } while (0)

#endif

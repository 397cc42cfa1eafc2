#!/bin/sh
# check_world.sh: make world on made-up projects, whose rows are known (make test-adapters)
#
#     tests/adapters/check_world.sh
#
# CC, LIBRARY, the object of the header, and its LIBS come from the Makefile. The last line is
# `N passed, N failed`.

. tests/lib/checks.sh
checks_folder world
: "${CC:=cc}"
export CC

commit() {
    project=$1
    shift
    git -C "$dir/sources/$project" -c user.name=a -c user.email=a@b -c commit.gpgsign=false \
        commit -q -m a "$@"
}

# A project: prints the solution of 2 x = b for some b. The expression is what ours prints.
project() {
    mkdir -p "$dir/sources/$1" "$dir/recipes"
    cat >"$dir/sources/$1/solver.h" <<'END'
static double solve(double b) {
    return b / 2;
}
END
    cat >"$dir/sources/$1/test.c" <<'END'
#include "solver.h"
#include <stdio.h>
int main(void) {
    int good = solve(4) == 2;
    printf("%d passed, %d failed in 0.01s\n", 1 + good, !good);
    return !good;
}
END
    git -C "$dir/sources/$1" init -q
    git -C "$dir/sources/$1" add .
    commit "$1"
    {
        printf -- '--- a/solver.h\n+++ b/solver.h\n@@ -2 +2 @@\n'
        printf -- '-    return b / 2;\n+    return %s;\n' "$2"
    } >"$dir/recipes/$1.patch"
    cat >"$dir/recipes/$1.c" <<'END'
#include "report.h"
#include "solver.h"
#ifdef WORLD_OURS
#include "sparse_local.h"
#endif
int main(int argc, char **argv) {
    for (int k = 0; argc == 1 && k < 9; k++) report(k % 2 ? "odd" : "even", solve(k));
    if (argc > 1) {
        report_time(solve(4));
        report("size", solve(8));
    }
    return 0;
}
END
    cat >"$dir/recipes/$1.sh" <<END
commit=$(git -C "$dir/sources/$1" rev-parse HEAD | cut -c 1-7)
timed="nothing"
build() {
    c -I"\$src" "\$src/test.c" -o "\$dir/test" && c -I"\$src" "\$recipes/$1.c" -o "\$dir/program"
}
own() { "\$dir/test"; }
features() { "\$dir/program"; }
size() { "\$dir/program" size; }
END
}

# Runs projects; $dir/log has what it prints.
world() {
    RECIPES=$dir/recipes OUT=$dir/out bench/world/world.sh "$dir/sources" "$dir/page.md" "$@" \
        >"$dir/world.log" 2>&1
}

# The row of a project is this after its commit.
row() {
    commit=$(git -C "$dir/sources/$1" rev-parse HEAD | cut -c 1-7)
    cat "$dir/page.md"
    grep -qxF "| $1 | $commit | $2 |" "$dir/page.md"
}

last() {
    cat "$dir/world.log"
    tail -n 1 "$dir/world.log" | grep -qx "$1"
}

project same 'b * 0.5'
project near 'b * (0.5 + 1e-10)'
project odd '(int)b % 2 ? b * (0.5 + 1e-7) : b / 2'
project far 'b * (0.5 + 1e-5)'
project nan 'b < 8 ? b / 2 : 0.0 / 0.0 * b'
project broken 'b /'
project slow 'b == 4 ? 3 : b / 2'
project other 'b / 2 + 0'
sed -i 's/b \/ 2/b \/ 4 * 2/' "$dir/sources/other/solver.h"
project untested 'b * 0.5'
sed -i 's/printf.*/good++;/' "$dir/sources/untested/test.c"
project testless 'b * 0.5'
echo 'has_tests=no' >>"$dir/recipes/testless.sh"
project cmade 'b * 0.5'
cat >"$dir/sources/cmade/CMakeLists.txt" <<'END'
cmake_minimum_required(VERSION 3.5)
project(cmade C)
add_executable(tests test.c)
END
cat >>"$dir/recipes/cmade.sh" <<'END'
build() {
    cmake_build tests && cp "$dir/build/tests" "$dir/test" &&
        c -I"$src" "$recipes/cmade.c" -o "$dir/program"
}
END
project later 'b * 0.5'
commit later --allow-empty
mkdir "$dir/sources/stranger" # a checkout without a recipe
cp "$dir/recipes/same.sh" "$dir/recipes/absent.sh"

kept='| kept | abcdef0 | 1 | as | it | was |'
good='1 | 2/2, 2/2 | 2/2 | 1, nothing'
echo "$kept" >"$dir/page.md"
world same
check "equal features" "row same '$good' && last '1 passed, 0 failed'"
check "rows of other projects are kept" "grep -x '$kept' $dir/page.md"
world
check "all that have a checkout" \
    "last '4 passed, 8 failed' && grep 'absent: skipped' $dir/world.log"
check "one row each" "row same '$good' && [ \$(grep -c '| same |' $dir/page.md) = 1 ]"
check "rounding, one of their tests less" "row near '1 | 2/2, 1/2 | 2/2 | 1, nothing'"
check "one feature differs" "row odd '1 | 2/2, 2/2 | 1/2 | 1, nothing'"
check "no time of wrong results" "row far '1 | 2/2, 1/2 | 0/2 | -, nothing'"
check "what is not a number" "row nan '1 | 2/2, 2/2 | 1/2 | -, nothing'"
check "what does not compile" "row broken '1 | no build with ours | - | -'"
check "the time is ours by theirs" "row slow '1 | 2/2, 1/2 | 1/2 | 1.5, nothing'"
check "a patch that does not apply" "row other '- | the patch does not apply | - | -'"
check "no own tests" "row untested '1 | 0/0, 0/0 | 2/2 | 1, nothing'"
check "a project that has none" "row testless '1 | none | 2/2 | 1, nothing'"
check "another commit" "row later '$good' && grep 'was written for' $dir/world.log"
check "sources are not changed" "git -C $dir/sources/same diff --exit-code"
CC="env $CC" world cmade
check "CMake, and a compiler of two words" "row cmade '$good'"
world stranger
check "a checkout without a recipe" "last '0 passed, 1 failed' && row same '$good'"
checks_end

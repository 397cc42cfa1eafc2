# pmp-library: its three files that factor take our class
#
# Of its own tests those of what solves. Coordinates are in double, so that results can be compared.
# Its Eigen uses OpenMP: one thread.
# The real size: heat geodesics of 200,000 faces, a torus.

commit=1891631
timed="heat geodesics"

tests="fairing geodesics hole_filling laplace numerics parameterization smoothing"

build() {
    cmake_build pmp -DPMP_BUILD_EXAMPLES=OFF -DPMP_BUILD_VIEWERS=OFF -DPMP_STRICT_COMPILATION=OFF \
        -DBUILD_SHARED_LIBS=OFF -DPMP_SCALAR_TYPE=64 || return 1
    archive=$(find "$dir/build" -name libpmp.a) eigen=$(echo "$src"/external/eigen-*)
    set -- -fopenmp -DPMP_SCALAR_TYPE_64 -I"$src/src" -I"$eigen"
    cxx "$@" "$recipes/pmp-library.cpp" "$archive" -o "$dir/program" || return 1
    for test in $tests; do
        cxx_object "$@" -I"$src/tests" "$src/tests/${test}_test.cpp" -o "$dir/$test.o" || return 1
    done
    cxx "$@" "$src/tests/helpers.cpp" "$dir"/*.o "$archive" -lgtest_main -lgtest -lpthread \
        -o "$dir/tests"
}

export OMP_NUM_THREADS=1
own() { cd "$src" && "$dir/tests"; }
features() { "$dir/program" 20; }
size() { "$dir/program" 224 size; }

# libigl: two members of min_quad_with_fixed_data, on which its other solves are built
#
# Of its own tests those of what solves. Needs a checkout of libigl-tests-data beside it, Catch2 2.
# Indefinite systems and the active set are factored by LU with either solver.
# The real size: heat geodesics of 200,000 faces, a torus.

commit=0cbcaf8
timed="heat geodesics"

build() {
    data=$(checkout libigl-tests-data) || return 1
    set -- -DNDEBUG -I"$src/include" -I/usr/include/eigen3
    cxx "$@" "$recipes/libigl.cpp" -o "$dir/program" || return 1
    {
        echo '#define CATCH_CONFIG_MAIN'
        echo '#include <test_common.h>'
        for test in min_quad_with_fixed heat_geodesics lscm; do
            echo "#include \"$src/tests/include/igl/$test.cpp\""
        done
    } >"$dir/tests.cpp"
    cxx "$@" -O0 -I"$src/tests" -DLIBIGL_DATA_DIR="\"$data\"" "$dir/tests.cpp" -o "$dir/tests"
}

own() { "$dir/tests"; }
features() { "$dir/program" 20; }
size() { "$dir/program" 224 size; }

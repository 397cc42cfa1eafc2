# OSQP: takes our solver by one option of CMake, so that no line changes
#
# Needs checkouts of qdldl and of Catch2 2 beside it. `make bench-osqp` runs its seven classes.
# The real size: total variation of 10,000 pixels, 500 iterations.

commit=1572ae0
timed="total variation"

build() {
    qdldl=$(checkout qdldl) && catch2=$(checkout Catch2) || return 1
    set -- -DFETCHCONTENT_SOURCE_DIR_QDLDL="$qdldl" -DFETCHCONTENT_SOURCE_DIR_CATCH2="$catch2"
    [ "$side" = theirs ] ||
        set -- "$@" -DCMAKE_PROJECT_osqp_INCLUDE="$here/tools/adapters/sparse_local_osqp.cmake"
    cmake_build 'osqpstatic osqp_tester lin_alg_tester' -DOSQP_BUILD_UNITTESTS=ON \
        -DPython_EXECUTABLE="$PYTHON" "$@" &&
        c -I"$src/include/public" -I"$dir/build/include/public" "$recipes/osqp.c" \
            "$dir/build/out/libosqpstatic.a" -lm -ldl -lrt -o "$dir/program"
}

own() {
    "$dir/build/out/osqp_tester"
    "$dir/build/out/lin_alg_tester"
}

features() { "$dir/program"; }
size() { "$dir/program" 100; }

# SCS: its makefile takes our QDLDL by a folder and a source file, so that no line changes
#
# Built with the system's BLAS and LAPACK.
# The real size: total variation of 10,000 pixels, 200 iterations.

commit=41efd34
timed="total variation"

build() {
    if [ "$side" = ours ]; then
        mkdir -p "$dir/external/qdldl"
        echo '#include "sparse_local_qdldl.h"' >"$dir/external/qdldl/qdldl.h"
        echo '#define SPARSE_LOCAL_QDLDL_IMPLEMENTATION' >"$dir/qdldl.c"
        echo '#include "sparse_local_qdldl.h"' >>"$dir/qdldl.c"
        set -- LDL_SOURCE="$dir/qdldl.c"
    fi
    flags="-I$dir $(echo $(flags))"
    (cd "$src" && CFLAGS=$flags make -j "$JOBS" CC="$CC" OPT=-O2 "$@" \
        BLASLDFLAGS="$(library) -llapack -lblas" out/libscsdir.a out/run_tests_direct) &&
        c -I"$src/include" "$recipes/scs.c" "$src/out/libscsdir.a" -llapack -lblas -o "$dir/program"
}

# The tests stop at the first that fails.
own() {
    (cd "$src" && out/run_tests_direct) | awk '
        { print }
        /^ALL TESTS PASSED/ { all = 1 }
        /^Tests run:/ { print $3 - !all " passed, " !all " failed in 0s" }'
}

features() { "$dir/program"; }
size() { "$dir/program" 100; }

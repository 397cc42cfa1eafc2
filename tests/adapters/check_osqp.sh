#!/bin/sh
# check_osqp.sh: the own tests of QDLDL and OSQP, on our names and our solver (make test-osqp)
#
#     tests/adapters/check_osqp.sh test | bench
#
# QDLDL, OSQP, CATCH2  folders of their sources, which are not changed
# CC, JOBS             the compiler, and compilations at a time
# ACCURACY             of the runs of `bench`, as a list; nothing: 1e-3 1e-6
# ALONE                what keeps other programs away from them
# Builds in build/osqp. `test` prints what each test program says, and ends in `N passed, N failed`,
# of programs. `bench` builds OSQP with QDLDL too, and prints ratios of processor time.

here=$PWD
out=$here/build/osqp
mkdir -p "$out/include"
passed=0 failed=0

# Runs a program and counts it.
run() {
    label=$1
    shift
    if "$@" >"$out/log" 2>&1; then
        passed=$((passed + 1))
        echo "$label: $(tr '\n' ' ' <"$out/log" | sed 's/.*=====* *//; s/  */ /g')"
    else
        failed=$((failed + 1))
        echo "$label: FAILED"
        tail -n 30 "$out/log" | sed 's/^/    /'
    fi
}

# Builds one OSQP: folder, its targets, then options.
osqp() {
    folder=$1 targets=$2
    shift 2
    cmake -S "$OSQP" -B "$out/$folder" -DFETCHCONTENT_SOURCE_DIR_QDLDL="$(realpath "$QDLDL")" "$@" \
        >"$out/$folder.log" 2>&1 &&
        cmake --build "$out/$folder" -j "$JOBS" --target $targets >>"$out/$folder.log" 2>&1 ||
        { tail -n 40 "$out/$folder.log" && exit 1; }
}

ours=-DCMAKE_PROJECT_osqp_INCLUDE=$here/tools/adapters/sparse_local_osqp.cmake

test_qdldl() {
    for name in qdldl qdldl_types; do
        echo '#include "sparse_local_qdldl.h"' >"$out/include/$name.h"
    done
    printf '#define SPARSE_LOCAL_%s\n' IMPLEMENTATION QDLDL_IMPLEMENTATION >"$out/bodies.c"
    printf '#include "sparse_local%s.h"\n' '' _qdldl >>"$out/bodies.c"
    for types in "" -DQDLDL_LONG -DQDLDL_FLOAT "-DQDLDL_LONG -DQDLDL_FLOAT"; do
        # by rows, as small systems are factored, and by supernodes
        for long in "" -DSL_QDLDL_LONG_COLUMNS=-1; do
            $CC -w -O1 $types $long -I"$out/include" -I. -Itools/adapters -I"$QDLDL/tests" \
                "$QDLDL/tests/qdldl_tester.c" "$out/bodies.c" -lm -o "$out/qdldl_tester" || exit 1
            run "QDLDL's tests $types $long" "$out/qdldl_tester"
        done
    done
}

test_osqp() {
    for types in '' '-DOSQP_USE_LONG=OFF' '-DOSQP_USE_FLOAT=ON'; do
        osqp "ours$types" 'osqp_tester lin_alg_tester osqp_tester_custom_memory' "$ours" $types \
            -DOSQP_BUILD_UNITTESTS=ON -DFETCHCONTENT_SOURCE_DIR_CATCH2="$(realpath "$CATCH2")" \
            -DPython_EXECUTABLE=/usr/bin/python3
        for program in osqp_tester lin_alg_tester osqp_tester_custom_memory; do
            # the tests of generated code write into the folder of the build
            run "OSQP's $program $types" "$out/ours$types/out/$program"
        done
    done
}

bench() {
    osqp ours osqpstatic "$ours"
    osqp theirs osqpstatic
    for folder in theirs ours; do
        $CC -std=c99 -O2 -I"$OSQP/include/public" -I"$out/$folder/include/public" \
            bench/osqp/osqp_classes.c "$out/$folder/out/libosqpstatic.a" -lm -ldl -lrt \
            -o "$out/$folder/classes" || exit 1
    done
    for accuracy in ${ACCURACY:-1e-3 1e-6}; do
        for turn in 1 2; do
            for folder in theirs ours; do
                $ALONE "$out/$folder/classes" $accuracy \
                    >"$out/$folder.$accuracy.$turn.csv" || exit 1
            done
        done
        echo "eps_abs = eps_rel = $accuracy; ms of QDLDL, and ours divided by it"
        awk -f bench/osqp/ratios.awk "$out"/theirs.$accuracy.?.csv "$out"/ours.$accuracy.?.csv
    done
}

for folder in "$QDLDL/tests" "$OSQP/algebra"; do
    if [ ! -d "$folder" ]; then
        echo "check_osqp.sh: no folder $folder; set QDLDL, OSQP and CATCH2"
        exit 1
    fi
done
if [ "$1" = bench ]; then
    bench
    exit
fi
test_qdldl
test_osqp
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]

#!/bin/sh
# check_cluster.sh: cluster-mpi with 1 to 4 ranks: equal answers, jobs interrupted and continued
# (make test-cluster)
#
#     PROGRAM='build/cluster-mpi build/sparse-local' tests/tools/check_cluster.sh
#
# The last line of output is `N passed, N failed`.

set -- $PROGRAM
cluster=$1 program=$2
MPIEXEC=${MPIEXEC:-mpiexec}
if ! command -v "$MPIEXEC" >/dev/null 2>&1 || [ ! -x "$cluster" ]; then
    echo 'no MPI: skipped'
    echo '0 passed, 0 failed, 1 skipped'
    exit 0
fi
# Open MPI asks for both; MPICH does not know the variables.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1
. "$(dirname "$0")/../lib/checks.sh"
checks_folder cluster

details() {
    tail -n 5 "$dir/log"
}

# job RANKS ARGUMENT ...: runs a job. Its output is in $dir/log.
job() {
    ranks=$1
    shift
    "$MPIEXEC" -n "$ranks" "$cluster" "$@" >"$dir/log" 2>&1 </dev/null
}

# descendants PID: the processes that it started, and those that these started.
descendants() {
    for child in $(ps -o pid= --ppid "$1"); do
        echo "$child"
        descendants "$child"
    done
}

blocks() {
    ls "$1"/pairs.*.csv 2>/dev/null | grep -c 'pairs\.[0-9]*\.csv$'
}

factor=$dir/f.slf
"$program" save hills:70x70 --out "$factor" >"$dir/log" 2>&1
record $? 'a factor is saved'

# The diagonal: each vertex once, and the same bits for any number of ranks.
for ranks in 1 2 4; do
    job $ranks "$factor" adf "$dir/adf$ranks" 300
    record $? "adf with $ranks ranks"
    cmp -s "$dir/adf1/adf.csv" "$dir/adf$ranks/adf.csv"
    record $? "adf: $ranks ranks give the bits of one"
done
"$program" adf "$factor" --csv "$dir/all.csv" >"$dir/log" 2>&1
sort -t, -n "$dir/adf2/adf.csv" | awk -F, '
    NR == FNR { if (FNR > 1) value[$1] = $2; next }
    { d = $2 - value[$1]; if ($1 != FNR - 1 || d * d > 1e-20 * $2 * $2) wrong = 1; lines++ }
    END { exit wrong || lines != 4900 }' "$dir/all.csv" -
record $? 'adf: the values of sparse-local adf, each vertex once'

# A file with the selected inverse: its values, which agree with those of the factor.
"$program" save hills:70x70 --selected --out "$dir/z.slf" >"$dir/log" 2>&1 &&
    job 2 "$dir/z.slf" adf "$dir/adfz" 300 &&
    paste -d, "$dir/adf1/adf.csv" "$dir/adfz/adf.csv" | awk -F, '{ d = $2 / $4 - 1
        if ($1 != $3 || d > 1e-10 || -d > 1e-10) wrong = 1 } END { exit wrong || NR != 4900 }'
record $? 'adf: the selected inverse of a file has the values of its factor'

# A mesh in place of a factor: rank 0 factors it.
job 2 hills:20x20 adf "$dir/mesh" 50
record $? 'a mesh is factored and saved'
[ "$(wc -l <"$dir/mesh/adf.csv")" -eq 400 ] && [ -e "$dir/mesh/factor.slf" ]
record $? 'a mesh: an answer for each vertex'

# A killed rank: the next run computes the missing blocks, and only these.
job 1 "$factor" pairs "$dir/whole" 100 40000
record $? 'pairs with one rank'
"$MPIEXEC" -n 3 "$cluster" "$factor" pairs "$dir/killed" 100 40000 >"$dir/log" 2>&1 </dev/null &
mpi=$!
waited=0
while [ "$(blocks "$dir/killed")" -lt 5 ] && [ $waited -lt 600 ]; do
    sleep 0.1
    waited=$((waited + 1))
done
for pid in $(descendants $mpi); do
    if [ "$(ps -o comm= -p "$pid")" = "$(basename "$cluster")" ]; then
        kill -9 "$pid"
        break
    fi
done
wait $mpi
[ $? -ne 0 ]
record $? 'a job whose rank was killed fails'
before=$(blocks "$dir/killed")
[ "$before" -ge 5 ] && [ "$before" -lt 400 ]
record $? "a job whose rank was killed left some blocks: $before"
job 2 "$factor" pairs "$dir/killed" 100 40000
record $? 'the job runs again'
grep -q "in 400 blocks, $((400 - before)) of them now" "$dir/log"
record $? "the second run computes the $((400 - before)) missing blocks"
cmp -s "$dir/whole/pairs.csv" "$dir/killed/pairs.csv"
record $? 'every answer once, with the bits of a run that was not interrupted'

# Refusals.
job 2 "$factor" pairs "$dir/killed" 200 40000
[ $? -ne 0 ] && grep -q 'results of another job' "$dir/log"
record $? 'a folder of another job is refused'
printf 'x' | dd of="$factor" bs=1 seek=3000 conv=notrunc 2>/dev/null
job 2 "$factor" adf "$dir/damaged" 300
[ $? -ne 0 ] && grep -q 'f.slf: ' "$dir/log"
record $? 'a damaged factor is refused'
job 2 "$factor" heat "$dir/x"
[ $? -ne 0 ] && grep -q '^usage: ' "$dir/log"
record $? 'an unknown kind of query is refused'

checks_end

#!/bin/sh
# figures.sh: draws the figures of the paper with sparse-local and the bench (make figures)
#
#     tools/build/figures.sh PROGRAM BENCH FOLDER [MESH]
#
# Uses generated surfaces, or MESH. FOLDER receives pictures (PNG, SVG), the numbers behind them
# (CSV) and the output of the programs (TXT). BENCH is that of make bench-eigenpairs: figures 4 to 6
# and eigenpairs.svg show what it measures. BENCH=quick in the environment shortens them. PATCH and
# CENTER change the patch.

program=$1 bench=$2 folder=$3 mesh=$4
mkdir -p "$folder" || exit 1
failed=0

# draw NAME COMMAND ARGUMENT ...: runs a command of the program; its output goes to NAME.txt.
draw() {
    name=$1
    shift
    echo "  $name: sparse-local $*"
    "$program" "$@" >"$folder/$name.txt" || { echo "  $name FAILED" >&2; failed=1; }
}

surface=${mesh:-star:6}
center=${CENTER:-100}
patch="--patch ${PATCH:-2000} --center $center"
# shellcheck disable=SC2086 # $patch is several words
{
    draw figure1 reach "$surface" $patch --png "$folder/figure1_reach.png" \
        --separators "$folder/figure1_separators.png" --tree "$folder/figure1_tree.svg" \
        --csv "$folder/figure1.csv"
    draw figure2 reach grid:6x5 --center 7 --patch 3 --levels 3 --size 480x400 \
        --png "$folder/figure2_mesh.png" --separators "$folder/figure2_separators.png" \
        --tree "$folder/figure2_tree.svg" --graph "$folder/figure2_graph.svg" \
        --pattern "$folder/figure2_patterns.png" --csv "$folder/figure2.csv"
    draw figure3 unwrap "$surface" $patch --method harmonic --png "$folder/figure3_param.png" \
        --layout "$folder/figure3_layout.png" --close "$folder/figure3_patch.png" \
        --out "$folder/figure3.obj" --csv "$folder/figure3.csv"
    for method in arap scp slim; do
        draw $method unwrap "$surface" $patch --method $method --png "$folder/$method.png" \
            --layout "$folder/${method}_layout.png"
    done
}
if [ -z "$mesh" ]; then # its vertices are those of one surface
    cat >"$folder/deform_script.txt" <<'END'
# three arms are held; one is bent, another one pulled, and let go
grab 7921,7418,4283 within 0.1
grab 3916 within 0.08
grab 879 within 0.08
turn 1 0 0 1 -75
move 1 0.8 -0.45 0.1
move 2 -0.5 0.45 0.1
frame
release 2
frame
END
    draw deform deform star:5 --script "$folder/deform_script.txt" --check \
        --view 8,12 --size 480x400 --frames "$folder/deform" --steps "$folder/deform.csv"
fi
draw edit edit "${mesh:-hills:200x200}" --edits 500 --every 125 --svg "$folder/edit.svg" \
    --csv "$folder/edit.csv"
draw geodesic geodesic "$surface" --from "$center" --png "$folder/geodesic.png"
draw voronoi geodesic "$surface" --from random:60 --voronoi --png "$folder/voronoi.png"
draw adf adf "$surface" --area-time 0.3 --png "$folder/adf.png" --csv "$folder/adf.csv"
draw adf_53k adf torus:400x133 --csv "$folder/adf_53k.csv"
draw hks hks "$surface" --like "$center" --png "$folder/hks.png" --csv "$folder/hks.csv"
draw heat heat "$surface" --from "$center" --scaled-time 10 --png "$folder/heat.png" \
    --csv "$folder/heat.csv"
draw histogram pairs "${mesh:-hills:447x447}" --count 10000 --svg "$folder/histogram.svg" \
    --csv "$folder/histogram.csv"

OPENBLAS_NUM_THREADS=1 BENCH_OUT=$folder MESH=$mesh \
    "$bench" patches scaling amortize multi_rhs eigenpairs >"$folder/bench.txt" ||
    { echo "  bench FAILED, see $folder/bench.txt" >&2; failed=1; }
# rename PLOT FIGURE: gives a plot of the bench, if it was drawn, the name of the figure.
rename() {
    [ ! -f "$folder/$1" ] || { mv "$folder/$1" "$folder/$2" && echo "  ${2%.svg}: bench, $1"; }
}
rename patches_by_mesh.svg figure4.svg
rename patches_by_patch.svg figure5.svg
rename scaling.svg figure6_left.svg
rename amortize.svg figure6_right.svg
build=$(dirname "$0")
awk -f "$build/csv.awk" -f "$build/paper_table.awk" "$folder"/patches.csv "$folder"/multi_rhs.csv \
    "$folder"/eigenpairs_errors.csv "$folder"/adf_53k.txt "$folder"/histogram.txt \
    >"$folder/paper.md" && cat "$folder/paper.md"
echo "figures are in $folder"
exit $failed

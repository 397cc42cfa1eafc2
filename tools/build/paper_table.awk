# paper_table.awk: a Markdown table of the results of [HDA17] and of this library (make figures)
#
#     awk -f tools/build/csv.awk -f tools/build/paper_table.awk patches.csv multi_rhs.csv \
#         eigenpairs_errors.csv adf_53k.txt histogram.txt
#
# The CSV files are written by the bench, the TXT files are the output of sparse-local adf and
# sparse-local pairs. Of the meshes in patches.csv the largest is shown. The paper measured on a
# machine of 2017; only the ratios within a row are comparable.

FILENAME ~ /\.csv$/ && FNR == 1 {
    split_csv($0)
    for (c = 1; c <= n_fields; c++) column[field[c]] = c
    next
}

FILENAME ~ /patches\.csv$/ {
    split_csv($0)
    n = field[column["n"]]
    size = field[column["case"]]
    if (sub(/^patch /, "", size) == 0 || n + 0 < largest + 0) next
    if (n + 0 > largest + 0) { largest = n; split("", ms) }
    ms[field[column["method"]], size] = 1e3 * field[column["median_s"]]
}

FILENAME ~ /multi_rhs\.csv$/ {
    split_csv($0)
    ratio = field[column["ratio"]]
    if (field[column["nrhs"]] == 8 && field[column["method"]] == "together" && ratio > 0) {
        speedup = 1 / ratio
        if (speedup_min == "" || speedup < speedup_min) speedup_min = speedup
        if (speedup > speedup_max) speedup_max = speedup
    }
}

FILENAME ~ /eigenpairs_errors\.csv$/ {
    split_csv($0)
    if (field[column["pairs"]] == 300)
        eigen = sprintf("%.1f s, wrong by %.0f %%", field[column["seconds"]], \
            100 * field[column["adf_median"]])
}

FILENAME ~ /adf_53k\.txt$/ && /^auto-diffusion of/ { adf_n = $3 }
FILENAME ~ /adf_53k\.txt$/ && /^seconds:/ { adf = $NF }
FILENAME ~ /adf_53k\.txt$/ && /^a full solve for each/ { adf_full = $7 }
FILENAME ~ /histogram\.txt$/ && / pairs on / { pairs = $1; pairs_n = $4 }
FILENAME ~ /histogram\.txt$/ && sub(/^microseconds per pair: /, "") { pair_times = $0 }
FILENAME ~ /histogram\.txt$/ && sub(/^two trees: /, "") { pair_speedup = $0 }

END {
    print "| experiment | [HDA17], 2017 | this library |"
    print "|---|---|---|"
    n_sizes = split("2000 10000 30000 50000", sizes, " ")
    split("6 42 180 386", paper_refactor, " ")
    split("18 227 1209 2580", paper_cg, " ")
    for (k = 1; k <= n_sizes; k++)
        if (("plan solve", sizes[k]) in ms) patch_row(sizes[k], paper_refactor[k], paper_cg[k])
    if (speedup_max != "")
        printf "| 8 right-hand sides in one solve | 2.5 times faster | %.1f to %.1f times |\n", \
            speedup_min, speedup_max
    if (adf != "")
        printf "| auto-diffusion of all %d vertices: local / full solves / 300 eigenvectors " \
            "| 11 s / 225 s / 39 s (53000 vertices) | %s s / %s s / %s |\n", adf_n, adf, adf_full, \
            eigen == "" ? "-" : eigen
    if (pair_times != "")
        printf "| %d random pairs on %d vertices | a histogram | microseconds: %s; " \
            "two trees: %s |\n", pairs, pairs_n, pair_times, pair_speedup
}

function patch_row(size, paper_refactor, paper_cg,    here, refactor, cg) {
    here = ms["plan solve", size]
    refactor = ms["refactorize the patch", size]
    cg = ms["conjugate gradients", size]
    printf "| patch of %d vertices of a mesh of %d: refactorize and solve / conjugate gradients " \
        "/ local solve | %d ms / %d ms / Figure 5 ", size, largest, paper_refactor, paper_cg
    printf "| %s / %s / %s ms: %.0f and %.0f times the local solve |\n", digits(refactor), \
        digits(cg), digits(here), refactor / here, cg / here
}

# paper_table.awk: the numbers of [HDA17] beside those measured here, as a Markdown table (make figures)
#
#     awk -f tools/paper_table.awk patches.csv multi_rhs.csv adf_53k.txt histogram.txt
#
# The CSV files are the bench's, the TXT files what sparse-local adf and pairs printed. Of the meshes in patches.csv the
# largest counts. The paper's machine of 2017 is not ours: what compares are the ratios within a row.

FILENAME ~ /\.csv$/ && FNR == 1 { fields($0); for (c = 1; c <= n_fields; c++) at[field[c]] = c; next }

FILENAME ~ /patches\.csv$/ {
    fields($0)
    n = field[at["n"]]
    size = field[at["case"]]
    if (sub(/^patch /, "", size) == 0 || n + 0 < largest + 0) next
    if (n + 0 > largest + 0) { largest = n; split("", ms) }
    ms[field[at["method"]], size] = 1e3 * field[at["median_s"]]
}

FILENAME ~ /multi_rhs\.csv$/ {
    fields($0)
    if (field[at["nrhs"]] == 8 && field[at["method"]] == "together" && field[at["ratio"]] > 0) {
        gain = 1 / field[at["ratio"]]
        if (gain_from == "" || gain < gain_from) gain_from = gain
        if (gain > gain_to) gain_to = gain
    }
}

FILENAME ~ /adf_53k\.txt$/ && /^auto-diffusion of/ { adf_n = $3 }
FILENAME ~ /adf_53k\.txt$/ && /^seconds:/ { adf = $NF }
FILENAME ~ /adf_53k\.txt$/ && /^a full solve for each/ { adf_full = $7 }
FILENAME ~ /histogram\.txt$/ && / pairs on / { pairs = $1; pairs_n = $4 }
FILENAME ~ /histogram\.txt$/ && /^microseconds a pair/ { pair_text = $0; sub(/^microseconds a pair: /, "", pair_text) }
FILENAME ~ /histogram\.txt$/ && /^two trees:/ { two_text = $0; sub(/^two trees: /, "", two_text) }

END {
    print "| [HDA17] | the paper, 2017 | here |"
    print "|---|---|---|"
    split("2000 10000 30000 50000", sizes, " ")
    split("6 42 180 386", refactor, " ")
    split("18 227 1209 2580", cg, " ")
    for (k = 1; k <= 4; k++) {
        if (!(("plan solve", sizes[k]) in ms)) continue
        here = ms["plan solve", sizes[k]]
        printf "| patch of %d vertices of a mesh of %d: refactorize and solve / conjugate gradients / ours | ", \
            sizes[k], largest
        printf "%d ms / %d ms / Figure 5 | %s / %s / %s ms: %.0f and %.0f times ours |\n", refactor[k], cg[k], \
            digits(ms["refactorize the patch", sizes[k]]), digits(ms["conjugate gradients", sizes[k]]), \
            digits(here), ms["refactorize the patch", sizes[k]] / here, ms["conjugate gradients", sizes[k]] / here
    }
    if (gain_to != "")
        printf "| 8 right-hand sides together | 2.5 times faster | %.1f to %.1f times |\n", gain_from, gain_to
    if (adf != "")
        printf "| auto-diffusion of all of %d vertices: ours / full solves / 300 eigenvectors | 11 s / 225 s / 39 s " \
            "(53000 vertices) | %s s / %s s / - |\n", adf_n, adf, adf_full
    if (pair_text != "")
        printf "| %d random pairs on %d vertices | a histogram | microseconds: %s; two trees %s |\n", pairs, pairs_n, \
            pair_text, two_text
}

function digits(x) { return sprintf(x < 9.995 ? "%.2f" : x < 99.95 ? "%.1f" : "%.0f", x) }

# A line of a CSV file, texts between quotes, into field[1..n_fields]
function fields(line, parts, n, k, whole) {
    n = split(line, parts, "\"")
    whole = ""
    for (k = 1; k <= n; k++) {
        if (k % 2 == 0) gsub(",", "\001", parts[k])
        whole = whole parts[k]
    }
    n_fields = split(whole, field, ",")
    for (k = 1; k <= n_fields; k++) gsub("\001", ",", field[k])
}

# readme_table.awk: turns what `make bench-peers` measured into the Markdown table of the README (make readme-table)
#
#     awk -f tools/readme_table.awk build/bench-out/peers.machine.txt build/bench-out/peers.csv [peers_harmonic.csv ...]
#
# A table a file, a column a system, a row a step. A cell says the median of ours, how many times as long the best peer
# takes and which one that is, and the share of ours that the limit of one core (of as many cores as threads) would
# take. The best peer may use as many threads as ours, or fewer.

BEGIN {
    n_steps = split("order to factor|analyse|first factor|refactor|refactor, 2 threads|full solve, 1 rhs|" \
                    "full solve, 3 rhs|full solve, 8 rhs|full solve, 64 rhs|vertex|pair|patch 1000, 2 rhs|patch 10000, 2 rhs", steps, "|")
    letters["CHOLMOD supernodal"] = "S"
    letters["METIS + CHOLMOD supernodal"] = "M"
    letters["CHOLMOD simplicial"] = "s"
    letters["CHOLMOD solve2 Bset"] = "B"
    letters["CHOLMOD full solve"] = "F"
    letters["Eigen simplicial"] = "E"
}

FNR == 1 && FILENAME ~ /machine\.txt$/ { machine = $0; next }
FNR == 1 { n_tables++; fields($0); for (c = 1; c <= n_fields; c++) at[field[c]] = c; next }

{
    fields($0)
    system_name = field[at["system"]]
    step = field[at["case"]]
    rhs = field[at["nrhs"]]
    threads = field[at["threads"]]
    if (step == "full solve" || step ~ /^patch/) step = step ", " rhs " rhs"
    if (threads > 1) step = step ", " threads " threads"
    if (!(system_name in seen)) {
        seen[system_name] = field[at["n"]]
        systems[++n_systems] = system_name
        table_of[n_systems] = n_tables
    }
    key = system_name SUBSEP step
    method = field[at["method"]]
    seconds = field[at["median_s"]]
    if (method == "ours" || method == "ours, given order") {
        ours[key] = seconds
        share[key] = field[at["limit_share"]]
    } else if (method !~ /^ours/ && (!(key in best) || seconds < best[key])) {
        sub(/, once$/, "", method)
        best[key] = seconds + 0
        who[key] = method
    }
}

END {
    if (n_systems == 0) { print "readme_table.awk: no measurements: make bench-peers first" >"/dev/stderr"; exit 1 }
    printf "%s.\n\n", machine
    print "Median; how many times as long the best peer takes (M METIS and S, S CHOLMOD supernodal, s CHOLMOD simplicial, B CHOLMOD"
    print "solve2 with Bset, F CHOLMOD full solve, E Eigen SimplicialLDLT; all over our order); and how much of our time"
    print "the machine needs at least, to read L or to do the operations."
    for (t = 1; t <= n_tables; t++) table(t)
}

function table(t, c, r, line, rule, filled, text) {
    line = "| |"
    rule = "|---|"
    for (c = 1; c <= n_systems; c++) {
        if (table_of[c] != t) continue
        line = line " " systems[c] ", n " number(seen[systems[c]]) " |"
        rule = rule "---|"
    }
    print "\n" line "\n" rule
    for (r = 1; r <= n_steps; r++) {
        line = "| " steps[r] " |"
        filled = 0
        for (c = 1; c <= n_systems; c++) {
            if (table_of[c] != t) continue
            text = cell(systems[c] SUBSEP steps[r])
            filled += text != ""
            line = line " " text " |"
        }
        if (filled) print line
    }
}

function cell(key, text, alone) {
    if (!(key in ours)) return ""
    alone = key
    if (sub(/, [0-9]+ threads$/, "", alone) && alone in best && (!(key in best) || best[alone] < best[key])) {
        best[key] = best[alone]
        who[key] = who[alone]
    }
    text = time_text(ours[key])
    if (key in best) text = text sprintf("; %.1fx %s", best[key] / ours[key], letters[who[key]])
    if (share[key] > 0) text = text sprintf("; %.0f%%", 100 * share[key])
    return text
}

function time_text(s) {
    if (s < 1e-3) return digits(s * 1e6) " us"
    if (s < 1) return digits(s * 1e3) " ms"
    return digits(s) " s"
}

function digits(x) { return sprintf(x < 9.995 ? "%.2f" : x < 99.95 ? "%.1f" : "%.0f", x) }

function number(n) { return n < 1e6 ? int(n / 1e3 + 0.5) "k" : sprintf("%.1fM", n / 1e6) }

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

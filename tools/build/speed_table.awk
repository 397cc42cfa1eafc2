# speed_table.awk: the results of `make bench-peers` as Markdown tables (make speed-table)
#
#     awk -f tools/build/csv.awk -f tools/build/speed_table.awk peers.machine.txt peers.csv \
#         [peers_harmonic.csv ...] [peers_kinds.csv]
#
# The files are in build/bench-out. There is a table per CSV file, with a column per system and a
# row per step. A cell has three numbers:
#   - the median time of this library;
#   - the median time of the fastest peer as a multiple of it, with a letter for the peer. A peer
#     may use as many threads as this library or one, whichever is faster;
#   - the physical limit as a share of the first number. The limit is the time that the cores in
#     use need to read L or to do the floating-point operations, whichever is longer.
# A local solve has two rows, one with the plan created inside the timed call and one on a plan
# created before. Both have the same peers: cholmod_solve2 finds its reach in every call.
#
# peers_kinds.csv makes a table with a row per kind of system: geometric means, and the worst of
# them in parentheses.

BEGIN {
    add_step("order to factor", "order + analyze + factor")
    add_step("order to factor, one factor", "the same, for one factor")
    add_step("analyze", "analyze, order given")
    add_step("first factor", "first factor")
    add_step("refactor", "refactor")
    add_step("refactor, 2 threads", "refactor, 2 threads")
    add_step("full solve, 1 rhs", "full solve, 1 rhs")
    add_step("full solve, 3 rhs", "full solve, 3 rhs")
    add_step("full solve, 8 rhs", "full solve, 8 rhs")
    add_step("vertex, 1 rhs, solve on a plan", "one vertex, solve on a plan")
    add_step("vertex, 1 rhs, plan + solve", "one vertex, plan + solve")
    add_step("patch 1000, 2 rhs, solve on a plan", "patch of 1000, 2 rhs, solve on a plan")
    add_step("patch 1000, 2 rhs, plan + solve", "patch of 1000, 2 rhs, plan + solve")
    add_step("edge update", "weight of an edge changed")
    add_step("rank-8 update", "8 vertices changed")
    add_step("pin, solve, release", "vertex pinned, solved beside it, released")
    letters["CHOLMOD updown"] = "U"
    letters["CHOLMOD rowdel/rowadd"] = "R"
    letters["CHOLMOD METIS"] = "M"
    letters["CHOLMOD defaults"] = "C"
    letters["CHOLMOD supernodal"] = "S"
    letters["CHOLMOD simplicial"] = "s"
    letters["CHOLMOD solve2 Bset"] = "B"
    letters["CHOLMOD full solve"] = "F"
    letters["Eigen simplicial"] = "E"
    letters["Eigen defaults"] = "A"
}

FNR == 1 && FILENAME ~ /machine\.txt$/ { machine = $0; next }
FNR == 1 {
    split_csv($0)
    for (c = 1; c <= n_fields; c++) column[field[c]] = c
    is_of_kinds = "ratio_one" in column
    if (!is_of_kinds) n_tables++
    next
}

is_of_kinds {
    split_csv($0)
    add_kind(field[column["group"]])
    add_kind("all")
    next
}

{
    split_csv($0)
    system_name = field[column["system"]]
    step = field[column["case"]]
    rhs = field[column["nrhs"]]
    threads = field[column["threads"]]
    if (rhs > 0) step = step ", " rhs " rhs"
    if (threads > 1) step = step ", " threads " threads"
    if (!((n_tables, system_name) in seen)) {
        seen[n_tables, system_name] = field[column["n"]]
        systems[++n_systems] = system_name
        table_of[n_systems] = n_tables
    }
    key = system_name SUBSEP step
    method = field[column["method"]]
    seconds = field[column["median_s"]]
    if (method ~ /^ours/) {
        # The table shows the plain setting, not a forced instruction set or a region.
        if (method ~ /^ours, (solve on a plan|plan \+ solve|one factor)$/) {
            variant = substr(method, 5)
            peers_of[key variant] = key
            key = key variant
        } else if (method != "ours" && method != "ours, given order") next
        ours[key] = seconds
        share[key] = field[column["limit_share"]]
    } else if (!(key in best) || seconds < best[key]) {
        sub(/, once$/, "", method)
        best[key] = seconds + 0
        peer[key] = method
    }
}

END {
    if (n_systems + n_kinds == 0) {
        print "speed_table.awk: no results; run make bench-peers first" >"/dev/stderr"
        exit 1
    }
    printf "%s.\n\n", machine
    print "Each cell has the median time of this library, the time of the fastest peer as a"
    print "multiple of it, and the physical limit as a share of our time. The limit is the least"
    print "time in which the machine can read L or do the operations. Peers run in their best and"
    print "in their default settings, and a letter names the fastest. CHOLMOD with its own"
    print "ordering: `M` METIS, `C` nothing set. CHOLMOD in our ordering: `S` supernodal, `s`"
    print "simplicial, `B` cholmod_solve2 with Bset, `F` a full solve in its fastest setting, `U`"
    print "cholmod_updown on vectors that were permuted before, `R` cholmod_rowdel and rowadd."
    print "Eigen SimplicialLDLT: `A` with AMD, its default, `E` in our ordering. \"For one factor\""
    print "means that `options.purpose` is `SL_PURPOSE_ONE_FACTOR`; by default the order suits"
    print "many local solves."
    for (t = 1; t <= n_tables; t++) table(t)
    if (n_kinds > 0) table_of_kinds()
}

function add_step(name, label) {
    steps[++n_steps] = name
    labels[name] = label
}

# Three right-hand sides belong to the tables that have no eight.
function is_left_out(t, step, c) {
    if (step != "full solve, 3 rhs") return 0
    for (c = 1; c <= n_systems; c++)
        if (table_of[c] == t && ((systems[c] SUBSEP "full solve, 8 rhs") in ours)) return 1
    return 0
}

function table(t, c, r, line, rule, filled, text) {
    line = "| |"
    rule = "|---|"
    for (c = 1; c <= n_systems; c++) {
        if (table_of[c] != t) continue
        line = line " " systems[c] ", n " number(seen[t, systems[c]]) " |"
        rule = rule "---|"
    }
    print "\n" line "\n" rule
    for (r = 1; r <= n_steps; r++) {
        if (is_left_out(t, steps[r])) continue
        line = "| " labels[steps[r]] " |"
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

# Adds the ratios of the current line to those of a kind.
function add_kind(kind, k, name, ratio, is_size, is_worse) {
    if (!(kind in kind_count)) kinds[++n_kinds] = kind
    kind_count[kind]++
    for (k = 1; k <= split("ratio ratio_one ratio_order ratio_order_one nnz_l path", \
                           ratio_names, " "); k++) {
        name = ratio_names[k]
        ratio = field[column[name]]
        is_size = name ~ /^(nnz_l|path)/
        is_worse = is_size ? ratio > worst[kind, name] : ratio < worst[kind, name]
        if (kind_count[kind] == 1 || is_worse) worst[kind, name] = ratio + 0
        logarithm[kind, name] += log(ratio)
    }
}

function mean_and_worst(kind, name) {
    return sprintf("%.2f (%.2f)", exp(logarithm[kind, name] / kind_count[kind]), worst[kind, name])
}

function table_of_kinds(r, k, line) {
    print "\nSystems of 400 to 100,000 rows of many kinds are taken from the matrix to a factor."
    print "The table has geometric means over the systems of a kind, with the worst of them in"
    print "parentheses. The first two columns are the time of the fastest peer, in its own"
    print "ordering, as a multiple of ours, by default and for one factor. The next two are about"
    print "the orderings alone: the time of METIS_NodeND as a multiple of ours by default, and"
    print "the time of AMD as a multiple of ours for one factor. The last two compare our default"
    print "order with that of METIS: the entries of L, and the mean path weight, which is what a"
    print "local solve reads."
    print "\n| kinds of systems | order + analyze + factor | the same, for one factor | order" \
          " | order, for one factor | nnz(L) | path weight |"
    print "|---|---|---|---|---|---|---|"
    for (r = 1; r <= n_kinds; r++) { # "all" comes after the others
        k = kinds[r == 1 ? 1 : r == n_kinds ? 2 : r + 1]
        line = "| " k ", " kind_count[k] " |"
        line = line " " mean_and_worst(k, "ratio") " | " mean_and_worst(k, "ratio_one") " |"
        line = line " " mean_and_worst(k, "ratio_order") " |"
        line = line " " mean_and_worst(k, "ratio_order_one") " |"
        line = line " " mean_and_worst(k, "nnz_l") " | " mean_and_worst(k, "path") " |"
        print line
    }
}

function cell(key, text, peers, one_thread) {
    if (!(key in ours)) return ""
    peers = (key in peers_of) ? peers_of[key] : key
    one_thread = peers
    if (sub(/, [0-9]+ threads$/, "", one_thread) && (one_thread in best) && \
        (!(peers in best) || best[one_thread] < best[peers])) peers = one_thread
    text = time_text(ours[key])
    if (peers in best)
        text = text sprintf("; %.1fx %s", best[peers] / ours[key], letters[peer[peers]])
    if (share[key] > 0) text = text sprintf("; %.0f%%", 100 * share[key])
    return text
}

function time_text(s) {
    if (s < 1e-3) return digits(s * 1e6) " us"
    if (s < 1) return digits(s * 1e3) " ms"
    return digits(s) " s"
}

function number(n) { return n < 1e6 ? int(n / 1e3 + 0.5) "k" : sprintf("%.1fM", n / 1e6) }

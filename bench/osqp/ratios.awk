# ratios.awk: two outputs of osqp_classes.c with QDLDL and two with ours, as a table of ratios
BEGIN {
    FS = ","
    head = "%-12s %5s %6s %6s %4s %9s %6s %9s %6s %6s %6s\n"
    row = "%-12s %5d %6d %6d %4d %9.3f %6.2f %9.3f %6.2f %6.2f %6s\n"
    printf head, "class", "size", "rows", "steps", "rho", "setup", "ratio", "solve", "ratio", \
        "all", "steps"
}
FNR == 1 { file++ }
{
    key = $1 "," $2
    who = file > 2
    if (!(key in rows)) {
        names[count++] = key
        rows[key] = $3
    }
    steps[key, who] = $5
    changes[key, who] = $6
    objective[key, who] = $9
    for (k = 7; k <= 8; k++) {
        if (!((key, who, k) in least) || $k < least[key, who, k]) {
            least[key, who, k] = $k
        }
    }
}
END {
    for (c = 0; c < count; c++) {
        key = names[c]
        split(key, name, ",")
        setup = least[key, 0, 7]
        solve = least[key, 0, 8]
        all = (least[key, 1, 7] + least[key, 1, 8]) / (setup + solve)
        same = steps[key, 0] == steps[key, 1] && changes[key, 0] == changes[key, 1]
        printf row, name[1], name[2], rows[key], steps[key, 0], changes[key, 0], 1e3 * setup, \
            least[key, 1, 7] / setup, 1e3 * solve, least[key, 1, 8] / solve, all, \
            same ? "same" : steps[key, 1]
        sum += log(all)
    }
    printf "geometric mean of all: %.2f\n", exp(sum / count)
}

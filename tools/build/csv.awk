# csv.awk: what the tables of measurements share: lines of CSV files, numbers of three digits

# Three significant digits.
function digits(x) { return sprintf(x < 9.995 ? "%.2f" : x < 99.95 ? "%.1f" : "%.0f", x) }

# Splits a line of a CSV file, with texts in double quotes, into field[1..n_fields].
function split_csv(line, parts, n, k, whole) {
    n = split(line, parts, "\"")
    whole = ""
    for (k = 1; k <= n; k++) {
        if (k % 2 == 0) gsub(",", "\001", parts[k])
        whole = whole parts[k]
    }
    n_fields = split(whole, field, ",")
    for (k = 1; k <= n_fields; k++) gsub("\001", ",", field[k])
}

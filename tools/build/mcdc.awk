# mcdc.awk: conditions that decide alone, by folder
#
# Reads parts of the header, then the functions that llvm-cov reports.

FILENAME ~ /\.h$/ {
    if (/^[A-Za-z].*\(/) { # a definition may begin with its type
        line = $0
        while (match(line, /sl_?[a-z0-9_]*\(/)) {
            folder[substr(line, RSTART, RLENGTH - 1)] = FILENAME
            line = substr(line, RSTART + RLENGTH)
        }
    }
    next
}

{
    sub(/^.*:/, "", $1) # the file of a static function
}

NF >= 10 && $1 in folder {
    split(folder[$1], path, "/")
    conditions[path[3]] += $(NF - 2)
    missed[path[3]] += $(NF - 1)
    if ($(NF - 1) > 0) {
        print $(NF - 1) " of " $(NF - 2) " conditions of " $1 " never decide alone"
    }
}

END {
    for (name in conditions) {
        printf "src/impl/%s: %d of %d conditions decide alone\n", name,
            conditions[name] - missed[name], conditions[name]
    }
}

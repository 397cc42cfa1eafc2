# marginal.awk: the bytes of an object that nothing but one call, or one specialization, reaches
#
#     LC_ALL=C readelf -SsrW OBJECT | awk -f tools/build/marginal.awk specializations.txt -
#
# OBJECT is compiled with -ffunction-sections -fdata-sections: a section for each function and
# table. A relocation in a section says that it uses another. Public calls are the roots. For each
# of them prints the bytes of code and data that no other root reaches; they would go with the call.
# The list has a name and a pattern of functions and tables a line. For each name prints the bytes
# that no root reaches except through these: those, and what only they use. A function that was
# inlined is counted where it went.

FILENAME != "-" {
    if (NF == 2 && !/^#/) pattern[$1] = $2
    next
}

# [Nr] Name Type Address Off Size ...; a space may follow the bracket
/^Section Headers:/ { state = "sections"; next }
/^Relocation section/ {
    state = "relocations"
    split($0, quoted, "'")
    from = quoted[2]
    sub(/^\.rela?/, "", from)
    next
}
/^Symbol table/ { state = "symbols"; next }

state == "sections" && /^ *\[ *[0-9]+\]/ {
    number = $0
    sub(/^ *\[ */, "", number)
    sub(/\].*/, "", number)
    sub(/^ *\[ *[0-9]+\] /, "")
    if ($1 ~ /^\.(text|rodata|data|bss)/) {
        section[number + 0] = $1
        size[$1] = hexadecimal($5)
    }
}

# Num: Value Size Type Bind Vis Ndx Name
state == "symbols" && NF == 8 && ($7 in section) {
    of[$8] = section[$7]
    if ($5 == "GLOBAL" && $4 == "FUNC" && $8 ~ /^sl_/) roots[$8] = section[$7]
}

# Offset Info Type Value Name + Addend. Relocations come before the symbols.
state == "relocations" && NF >= 5 && (from in size) {
    use_from[++uses] = from
    use_to[uses] = $5
}

END {
    for (k = 1; k <= uses; k++) {
        to = use_to[k] in of ? of[use_to[k]] : use_to[k]
        if (to in size) edges[use_from[k]] = edges[use_from[k]] " " to
    }
    for (s in size) # the cold part of a function
        if (s ~ /^\.text\.unlikely\./) {
            whole = s
            sub(/\.unlikely/, "", whole)
            edges[whole] = edges[whole] " " s
        }
    all = reach("", "")
    for (name in roots) printf "%8.1f  %s\n", (all - reach(name, "")) / 1000, name | "sort -rn"
    close("sort -rn")
    for (name in pattern) {
        bytes = all - reach("", pattern[name])
        printf "%8.1f  %s\n", bytes / 1000, name | "sort -rn"
    }
    close("sort -rn")
    count = 0
    for (name in roots) count++
    printf "%8.1f  all of %d calls, kB\n", all / 1000, count
}

function hexadecimal(text,    k, value) {
    for (k = 1; k <= length(text); k++)
        value = 16 * value + index("0123456789abcdef", substr(text, k, 1)) - 1
    return value
}

function is_blocked(s, blocked) {
    sub(/^\.[a-z]+\./, "", s)
    sub(/^(unlikely|hot|rel\.ro\.local|rel\.ro|rel\.local|rel)\./, "", s)
    return s ~ blocked
}

# The bytes of all sections that roots other than `without` reach, not through those that match
# `blocked`.
function reach(without, blocked,    stack, top, seen, name, s, bytes, n,
               to, k) {
    for (name in roots) if (name != without) stack[++top] = roots[name]
    while (top > 0) {
        s = stack[top--]
        if ((s in seen) || (blocked != "" && is_blocked(s, blocked))) continue
        seen[s] = 1
        bytes += size[s]
        n = split(edges[s], to, " ")
        for (k = 1; k <= n; k++) if (!(to[k] in seen)) stack[++top] = to[k]
    }
    return bytes
}

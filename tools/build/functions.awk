# functions.awk: the functions of sources with their lines and parameters (count.sh)
#
#     awk -f tools/build/functions.awk FILE ...
#
# Prints FILE:LINE, name, lines and parameters of each definition that begins in column 1. Lines are
# those from the first of the definition to its closing brace.

FNR == 1 { inside = head = comment = continued = 0 }

# macros
continued || /^[ \t]*#/ { continued = /\\$/; next }

# comments that begin in column 1
comment { comment = !/\*\//; next }
!inside && !head && /^\/\*/ { comment = !/\*\//; next }

!inside && !head && /^[A-Za-z_]/ && !/^(typedef|enum|extern "C")/ {
    first = FNR
    head = 1
    text = ""
}
head {
    line = $0
    gsub(/\/\*[^*]*\*\//, "", line)
    text = text " " line
    if (line ~ /;[ \t]*$/ && line !~ /\{/) { head = 0; next } # a declaration, or a call of a macro
    if (line !~ /\{/) next
    head = 0
    inside = is_function(text)
    if (line ~ /\}[^}]*$/ && balanced(line)) finish() # in one line
    next
}
inside && /^\}/ { finish() }

function finish() {
    if (inside) print FILENAME ":" first, name, FNR - first + 1, parameters
    inside = 0
}

function balanced(s) { return gsub(/\{/, "", s) == gsub(/\}/, "", s) }

# Sets name and parameters. A variable or a type has a = or no parenthesis before its brace.
function is_function(s,    k, depth, list, c) {
    sub(/[ \t]*\{.*/, "", s)
    if (s ~ /=/ || s !~ /\)$/) return 0
    for (k = length(s); k > 0; k--) { # back to the parenthesis that opens the list of parameters
        c = substr(s, k, 1)
        if (c == ")") depth++
        if (c == "(" && --depth == 0) break
    }
    list = substr(s, k + 1, length(s) - k - 1)
    s = substr(s, 1, k - 1)
    if (s ~ /\)$/) sub(/^.*[ *]/, "", s) # the name is made by a macro
    else sub(/^.*[^A-Za-z0-9_]/, "", s)
    name = s
    while (gsub(/\([^()]*\)/, "", list)) { } # parameters of parameters
    parameters = list ~ /^[ \t]*(void)?[ \t]*$/ ? 0 : gsub(/,/, "", list) + 1
    return 1
}

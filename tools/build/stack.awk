# stack.awk: how much stack the library takes, by gcc's -fcallgraph-info=su (make size)
#
#     awk -v frame_limit=BYTES -v chain_limit=BYTES -f tools/build/stack.awk FILE.ci
#
# Prints one line: the largest frame, and the deepest chain of calls by name. Fails if one of them
# exceeds its limit, if a frame has no bound, or if a function calls itself, directly or through
# others. Calls through pointers, of kernels and of tasks, are not followed: their chains are
# measured from the function that is called, and `make test-stack` runs what they add up to.

# The text in quotes behind a key.
function value(key,   at, rest) {
    at = index($0, key ": \"")
    rest = substr($0, at + length(key) + 3)
    return at ? substr(rest, 1, index(rest, "\"") - 1) : ""
}

function fail(text) {
    print "stack: " text
    failed = 1
}

/^node:/ {
    title = value("title")
    label = value("label")
    if (match(label, /[0-9]+ bytes/)) {
        bytes[title] = substr(label, RSTART, RLENGTH) + 0
        name[title] = substr(label, 1, index(label, "\\n") - 1)
        if (label ~ /\(dynamic\)/) fail(name[title] " has a frame without a bound")
    }
}

/^edge:/ {
    from = value("sourcename")
    calls[from] = calls[from] value("targetname") "\n"
}

# Sets chain[f], the bytes of the deepest chain of calls from f on, and next_of[f] on it.
function visit(f,   list, count, k, g, below) {
    state[f] = "open"
    count = split(calls[f], list, "\n")
    for (k = 1; k < count; k++) {
        g = list[k]
        if (!(g in bytes)) continue
        if (!(g in state)) visit(g)
        else if (state[g] == "open") fail("recursion: " name[f] " calls " name[g])
        if (chain[g] > below) {
            below = chain[g]
            next_of[f] = g
        }
    }
    chain[f] = bytes[f] + below
    state[f] = "done"
}

END {
    for (f in bytes) {
        count++
        if (!(f in state)) visit(f)
        if (bytes[f] > bytes[largest]) largest = f
        if (chain[f] > chain[deepest]) deepest = f
    }
    if (!count) fail("no function in the input")
    if (bytes[largest] > frame_limit) fail("the limit of a frame is " frame_limit " bytes")
    if (chain[deepest] > chain_limit) fail("the limit of a chain of calls is " chain_limit " bytes")
    printf "stack: largest frame %d of %d bytes (%s), deepest chain of calls %d of %d (",
        bytes[largest], frame_limit, name[largest], chain[deepest], chain_limit
    for (f = deepest; f != ""; f = next_of[f])
        printf "%s%s %d", f == deepest ? "" : " > ", name[f], bytes[f]
    printf ")%s\n", failed ? "" : ", no recursion"
    exit failed
}

# advice.awk: is the advice of every text followed by a test? (make style)
#
#     awk -f tools/build/advice.awk tests/core/test_advice*.c src/impl/*/*.h src/impl/*/*/*.h
#
# Advice is a text of src that names a call, a constant or an option. Where it is tested, a string
# of tests/core/test_advice*.c is a part of it, or it is a part of the string; one word is none.

BEGIN {
    # of other builds and machines
    elsewhere["files cannot be mapped here: load without SL_LOAD_MAPPED"]
    elsewhere["options.isa has no kernels for L in float"]
    elsewhere["a factor with null pivots: compiled with SL_NO_SINGULAR"]
    elsewhere["the call: compiled with SL_NO_SINGULAR"]
}

# Takes the strings of a file, which adjacent literals make.
function end_file(    rest, piece, string, is_test) {
    is_test = file ~ /test_advice/
    rest = whole
    while (match(rest, /"[^"]*"([ \n]*"[^"]*")*/)) {
        piece = substr(rest, RSTART + 1, RLENGTH - 2)
        rest = substr(rest, RSTART + RLENGTH)
        string = piece
        gsub(/"[ \n]*"/, "", string)
        if (string !~ / /) continue
        if (is_test && length(string) >= 16) tested[string]
        else if (!is_test && string ~ /sl_[a-z]|SL_[A-Z]|options\.|threads\.|stats\.|set\.[a-z]/)
            advice[string] = file
    }
    whole = ""
}

FNR == 1 {
    if (NR > 1) end_file()
    file = FILENAME
    in_comment = 0
}
/^ *#/ { next }
{
    text = $0
    if (in_comment) {
        if (!sub(/^.*\*\//, "", text)) text = ""
        else in_comment = 0
    }
    gsub(/\\"/, "", text)
    gsub(/\/\*([^*]|\*+[^*\/])*\*+\//, "", text)
    if (sub(/\/\*.*$/, "", text)) in_comment = 1
    whole = whole "\n" text
}
END {
    end_file()
    for (text in advice) {
        count++
        found = text in elsewhere
        for (string in tested) found = found || index(text, string) || index(string, text)
        if (!found) {
            print advice[text] ": no test follows \"" text "\""
            failures++
        }
    }
    if (count < 90) {
        print "advice: only " count " texts were found"
        failures++
    }
    if (!failures) print "advice: a test follows each of " count " texts"
    exit failures > 0
}

# errors.awk: does every error have a reason? Reads the parts of src/impl (make style)
#
# 1. A status of an error is named only where its reason is recorded, in a call of one of the
#    functions below, or where it is compared. So no function returns an error without a reason.
# 2. A public call with stats ends each return by handing the last error on to stats: by sli_report,
#    sli_fail_at, or a function that does.

function fail(text) {
    print text
    failures++
}

# The name of the function whose arguments hold position `at` of text: looks back for the
# parenthesis that is open there.
function caller(text, at,    open, k, c, name) {
    for (k = at - 1; k > 0 && at - k < 2000; k--) {
        c = substr(text, k, 1)
        open += (c == "(") - (c == ")")
        if (open > 0 || c == ";" || c == "{" || c == "}") break
    }
    if (open <= 0) return ""
    name = substr(text, 1, k - 1)
    sub(/[ \n]+$/, "", name)
    return match(name, /[A-Za-z_0-9]+$/) ? substr(name, RSTART) : ""
}

# Records the body of each function of the file by its name, and checks rule 1.
function end_file(    text, rest, at, found, before, name, line, signature, head) {
    text = whole
    at = 0
    rest = text
    while (match(rest, /SL_ERR_[A-Z_]+/)) {
        at += RSTART
        found = substr(rest, RSTART, RLENGTH) # caller() matches, too
        before = substr(text, 1, at - 1)
        name = caller(text, at)
        if (name !~ /^(sli_refuse|sli_fail_at|sli_fail|sli_order_refuse)$/ &&
            before !~ /(==|!=|case) *$/) {
            line = gsub(/\n/, "\n", before)
            fail(file ":" line ": " found " without a reason: sli_refuse(status, text)")
        }
        at += length(found) - 1
        rest = substr(text, at + 1)
    }
    head = "\n(SL_API |static |SLI_[A-Z_]+ (static )?)sl_status sli?_[a-z0-9_]+[(][^{;]*[)] [{]"
    while (match(text, head)) {
        signature = substr(text, RSTART + 1, RLENGTH)
        text = substr(text, RSTART + RLENGTH)
        name = signature
        sub(/\(.*/, "", name)
        sub(/.* /, "", name)
        at = index(text, "\n}")
        body[name] = substr(text, 1, at)
        is_public[name] = signature ~ /^SL_API /
        has_stats[name] = signature ~ /sl_stats \*stats/
        where[name] = file
    }
    whole = ""
}

# Do all returns of a function hand the error on?
function check(name,    text, value, callee) {
    if (name in checked) return
    checked[name] = 1
    text = body[name]
    gsub(/[ \n]+/, " ", text)
    while (match(text, /return [^;]*;/)) {
        value = substr(text, RSTART + 7, RLENGTH - 8)
        text = substr(text, RSTART + RLENGTH)
        if (value == "SL_OK" || value ~ /^sli_report\(/ || value ~ /^sli_fail_at\( ?stats/) continue
        callee = value
        sub(/\(.*/, "", callee)
        if (callee in body && has_stats[callee] && value ~ /stats\)$/) check(callee)
        else
            fail(where[name] ": " name " returns " value \
                 ", which stats may not have: sli_report(stats, status)")
    }
}

FNR == 1 {
    if (NR > 1) end_file()
    file = FILENAME
    in_comment = 0
}
{
    text = $0
    if (in_comment) {
        if (!sub(/^.*\*\//, "", text)) text = ""
        else in_comment = 0
    }
    gsub(/\\"/, "", text)
    gsub(/"[^"]*"/, "\"\"", text)
    gsub(/\/\*([^*]|\*+[^*\/])*\*+\//, "", text)
    if (sub(/\/\*.*$/, "", text)) in_comment = 1
    whole = whole "\n" text
}
END {
    end_file()
    for (name in body)
        if (is_public[name] && has_stats[name]) {
            calls++
            check(name)
        }
    if (!failures) print "errors: each has a reason, and " calls " calls with stats hand it on"
    exit failures > 0
}

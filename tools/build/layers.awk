# layers.awk: checks what the parts of src/ include, in which order, and how they name things (make layers)
#
#     awk -f tools/layers.awk src/sparse_local.in.h src/public/*.h src/impl/*.h
#
# The manifest comes first: its comments name the layers (public parts before all, L0, L1, ..., last), its includes
# the order. Each violation is printed as rule, file:line and fix; any makes the exit status 1.

FNR == 1 {
    is_manifest = NR == 1
    if (is_manifest) folder = directory(FILENAME)
    part = substr(FILENAME, length(folder) + 1)
    files[++n_files] = part
    inside_comment = 0
    if (index($0, "/* " base(part) ": ") != 1)
        violation("the first line says what a part is", "start with: /* " base(part) ": ...")
}

is_manifest && /^\/\* (L[0-9]|last)/ { layer = $2 == "last:" ? 99 : substr($2, 2) + 0; layer_seen = 1 }

/^[ \t]*#[ \t]*include[ \t]*"/ {
    split($0, quoted, "\"")
    target = resolve(directory(part), quoted[2])
    if (is_manifest) {
        listed[++n_listed] = target
        order[target] = n_listed
        layer_of[target] = layer_seen ? layer : -1
    } else {
        n_includes++
        from[n_includes] = part
        to[n_includes] = target
        where[n_includes] = FNR
        if (is_repeated(target) && !(target in user)) user[target] = part
    }
}

/^[ \t]*#[ \t]*include[ \t]*</ {
    split($0, angled, /[<>]/)
    if (angled[2] == "metis.h") {
        if (part != "impl/order_metis.h")
            violation("<metis.h> belongs to impl/order_metis.h alone", "ask for what you need there")
    } else if (part != "public/config.h" && part != "impl/base.h") {
        violation("system headers stand in public/config.h and impl/base.h", "move <" angled[2] "> to impl/base.h")
    }
}

# Names at file scope: macros, and what starts in column 1. Comments, strings and lines of macro
# definitions are not looked at.
part ~ /^(public|impl)\// {
    if ($0 ~ /^[ \t]*#[ \t]*define/) {
        macro = $0
        sub(/^[ \t]*#[ \t]*define[ \t]+/, "", macro)
        check_name(identifier(macro))
    } else if (!inside_comment && !continued && $0 ~ /^[A-Za-z_}]/) {
        names_of_line($0)
    }
    continued = $0 ~ /\\$/
    track_comment($0)
}

END {
    check_includes()
    check_listed()
    if (failures) print failures " violation(s)"
    else print "layers: " n_files " files, " n_includes " includes, all in order"
    exit failures > 0
}

function violation_at(file, line, rule, fix) {
    printf "%s%s:%d: %s\n    fix: %s\n", folder, file, line, rule, fix
    failures++
}

function violation(rule, fix) { violation_at(part, FNR, rule, fix) }

function directory(path) { return match(path, /.*\//) ? substr(path, 1, RLENGTH) : "" }

function base(path) { sub(/.*\//, "", path); return path }

function is_repeated(path) { return path ~ /\.inl\.h$/ }

function resolve(dir, target) {
    target = dir target
    gsub(/\/\.\//, "/", target)
    while (sub(/[^\/]+\/\.\.\//, "", target)) { }
    return target
}

# The part through whose place in the manifest a file is judged: a repeated part stands where it is first used.
function stand(path, steps) {
    for (steps = 0; is_repeated(path) && (path in user) && steps < 16; steps++) path = user[path]
    return path
}

function check_includes(    k, a, b) {
    for (k = 1; k <= n_includes; k++) {
        if (is_repeated(to[k])) continue
        a = stand(from[k])
        b = to[k]
        if (!(b in order)) {
            violation_at(from[k], where[k], "includes " b ", which the manifest does not list", "list it, or drop it")
        } else if (a in order && layer_of[b] > layer_of[a]) {
            violation_at(from[k], where[k], "layer " layer_of[a] " includes " b " of layer " layer_of[b], \
                         "a layer may include only layers below it, or its own earlier in the manifest")
        } else if (a in order && order[b] >= order[a]) {
            violation_at(from[k], where[k], "includes " b ", which the manifest lists later", \
                         "swap them in the manifest, or drop the include")
        }
    }
}

function check_listed(    k, is_there, path) {
    for (k = 2; k <= n_files; k++) {
        path = files[k]
        is_there[path] = 1
        if (is_repeated(path) ? !(path in user) : !(path in order))
            violation_at(path, 1, "nothing includes this part", "list it in the manifest, or delete it")
    }
    for (k = 1; k <= n_listed; k++)
        if (!(listed[k] in is_there)) violation_at(listed[k], 1, "listed in the manifest, not among the parts", "write it")
}

function identifier(text) { return match(text, /^[A-Za-z_][A-Za-z_0-9]*/) ? substr(text, 1, RLENGTH) : "" }

function check_name(name) {
    if (name != "" && name !~ /^(sl|sli)_/ && name !~ /^(SL|SLI|SLV|SLW)_/ && name != "SPARSE_LOCAL_IMPLEMENTED")
        violation("`" name "` at file scope has no prefix", "name it sli_" name " (macros: SLI_, SLV_, SLW_)")
}

# What a line in column 1 declares: every name before a parenthesis (the function, and the macros around it), the
# name after struct, enum or union, and the last name before = [ ; (a table or a type).
function names_of_line(line,    rest, name) {
    gsub(/"[^"]*"/, "", line)
    gsub(/\/\*.*\*\//, "", line)
    gsub(/__attribute__ *\(\([^)]*\)*/, "", line)
    rest = line
    if (sub(/\(.*/, "", rest) && match(rest, /[A-Za-z_][A-Za-z_0-9]*$/)) {
        check_name(substr(rest, RSTART, RLENGTH))
    } else if (match(rest, /(struct|enum|union) +[A-Za-z_][A-Za-z_0-9]* *\{/)) {
        name = substr(rest, RSTART, RLENGTH)
        sub(/^[a-z]+ +/, "", name)
        check_name(identifier(name))
    } else if (match(rest, /[A-Za-z_][A-Za-z_0-9]*(\[[^]]*\])* *[=;]/)) {
        check_name(identifier(substr(rest, RSTART, RLENGTH)))
    }
}

# Follows block comments, as far as lines that begin in column 1 need it.
function track_comment(line) {
    gsub(/"[^"]*"/, "", line)
    gsub(/\/\*([^*]|\*[^\/])*\*\//, "", line)
    if (inside_comment) { if (line ~ /\*\//) inside_comment = 0 }
    else if (line ~ /\/\*/) inside_comment = 1
}

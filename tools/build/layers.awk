# layers.awk: checks the direction of all includes and the names at file scope of src/ (make layers)
#
#     awk -f tools/build/layers.awk src/sparse_local.in.h src/public/*.h src/impl/*/*.h OTHER ...
#
# src/: the manifest sparse_local.in.h is the first argument. It lists the parts (the other files of
# src/) bottom up. A folder is a layer, and the manifest lists its parts one after another. A part
# includes parts of lower layers and earlier parts of its own layer, and nothing outside src/. A
# repeated part (*.inl.h) has no include guard and is not in the manifest. It takes the place of
# the first part that includes it.
#
# OTHER: C files of tools/, tests/ and bench/. A file includes files of its own folder, and
#     tools/X      of the tools folders below X: matrix < io < mesh < geometry < draw < cli <
#                  cluster
#     tests/X      of tools/ and tests/lib
#     bench/X      of tools/ and bench/lib
# All of them include sparse_local.h, but nothing of src/.
#
# Each macro that impl/ defines has an #undef in src/.
#
# Each violation is printed as file:line, rule and fix. Any violation makes the exit status 1.

BEGIN {
    n_tools = split("matrix io mesh geometry draw cli cluster", folder_name, " ")
    for (k = 1; k <= n_tools; k++) tools_rank["tools/" folder_name[k] "/"] = k
}

FNR == 1 {
    is_manifest = NR == 1
    if (is_manifest) root = directory(FILENAME)
    in_src = index(FILENAME, root) == 1
    file = FILENAME
    part = in_src ? substr(FILENAME, length(root) + 1) : ""
    if (in_src) files[++n_files] = part
    inside_comment = continued = 0
    n_checked++
    if (index($0, "/* " base(FILENAME) ": ") != 1)
        violation("the first line does not say what the file is", \
                  "begin with: /* " base(FILENAME) ": ...")
}

/^[ \t]*#[ \t]*include[ \t]*"/ {
    split($0, quoted, "\"")
    if (in_src) include_in_src(quoted[2])
    else include_outside_src(quoted[2])
}

in_src && /^[ \t]*#[ \t]*include[ \t]*</ {
    split($0, angled, /[<>]/)
    if (angled[2] == "metis.h") {
        if (part != "impl/ordering/metis.h")
            violation("<metis.h> is included outside impl/ordering/metis.h", \
                      "call the functions of impl/ordering/metis.h")
    } else if (part != "public/config.h" && part != "impl/base/base.h") {
        violation("system header outside public/config.h and impl/base/base.h", \
                  "move <" angled[2] "> to impl/base/base.h")
    }
}

# Names at file scope of a part: macros, and declarations that begin in column 1. Comments, strings
# and the continuation lines of macro definitions are ignored.
part ~ /^(public|impl)\// {
    if ($0 ~ /^[ \t]*#[ \t]*define/) {
        macro = $0
        sub(/^[ \t]*#[ \t]*define[ \t]+/, "", macro)
        check_name(identifier(macro))
        if (part ~ /^impl\// && !(identifier(macro) in defined_at)) {
            defined_at[identifier(macro)] = FNR
            defined_in[identifier(macro)] = file
        }
    } else if ($0 ~ /^[ \t]*#[ \t]*undef/) {
        macro = $0
        sub(/^[ \t]*#[ \t]*undef[ \t]+/, "", macro)
        undefined[identifier(macro)] = 1
    } else if (!inside_comment && !continued && $0 ~ /^[A-Za-z_}]/) {
        check_declaration($0)
    }
    continued = $0 ~ /\\$/
    track_comment($0)
}

END {
    check_order()
    check_listed()
    check_macros()
    if (failures) print failures " violation(s)"
    else print "layers: " n_checked " files, " n_includes " includes, all in order"
    exit failures > 0
}

# Macros of the implementation do not stay behind in the user's file.
function check_macros(name) {
    for (name in defined_at)
        if (name !~ /_H$/ && !(name in undefined))
            violation_at(defined_in[name], defined_at[name], name " is never undefined", \
                         "#undef " name " in impl/base/undef.h")
}

# ---- messages and paths ----

function violation_at(path, line, rule, fix) {
    printf "%s:%d: %s\n    fix: %s\n", path, line, rule, fix
    failures++
}

function violation(rule, fix) { violation_at(file, FNR, rule, fix) }

function directory(path) { return match(path, /.*\//) ? substr(path, 1, RLENGTH) : "" }

function base(path) { sub(/.*\//, "", path); return path }

# The path that an include in a file of folder dir names.
function resolve(dir, target) {
    target = dir target
    gsub(/\/\.\//, "/", target)
    while (sub(/[^\/]+\/\.\.\//, "", target)) { }
    return target
}

# ---- includes outside src/ ----

function include_outside_src(target,    from, to) {
    n_includes++
    if (target !~ /^(src|tools|tests|bench)\// && target != "sparse_local.h")
        target = resolve(directory(file), target)
    from = directory(file)
    to = directory(target)
    if (index(target, root) == 1)
        violation("includes " target, "include sparse_local.h")
    else if (to != "" && to != from && !is_below(to, from))
        violation(from " includes " target, "move what it needs to a folder that both may include")
}

# Whether files of folder `from` may include files of folder `to`.
function is_below(to, from) {
    if (from ~ /^tools\//) return from in tools_rank && to in tools_rank && \
                                  tools_rank[to] < tools_rank[from]
    if (to in tools_rank) return 1
    return (from ~ /^tests\// && to == "tests/lib/") || (from ~ /^bench\// && to == "bench/lib/")
}

# ---- includes in src/ ----

function include_in_src(target) {
    target = resolve(directory(part), target)
    if (is_manifest) {
        listed[++n_listed] = target
        order[target] = n_listed
        layer_of[target] = layer_in_manifest(directory(target))
        return
    }
    n_includes++
    from_part[++n_edges] = part
    to_part[n_edges] = target
    line_of[n_edges] = FNR
    if (is_repeated(target) && !(target in first_user)) first_user[target] = part
}

# The number of a folder's layer, in the order in which the manifest names the folders.
# impl/base has two pieces: undef.h, which is last, undefines the internal macros.
function layer_in_manifest(dir) {
    if (dir == last_dir) return n_layers
    last_dir = dir
    if (dir in is_layer && dir != "impl/base/")
        violation("the manifest lists layer " dir " in two places", \
                  "list its parts one after another")
    is_layer[dir] = 1
    layer_name[++n_layers] = dir
    return n_layers
}

function is_repeated(path) { return path ~ /\.inl\.h$/ }

# The part whose place in the manifest decides what a part may include.
function representative(path, steps) {
    for (steps = 0; is_repeated(path) && (path in first_user) && steps < 16; steps++)
        path = first_user[path]
    return path
}

function check_order(    k, a, b, path) {
    for (k = 1; k <= n_edges; k++) {
        if (is_repeated(to_part[k])) continue
        a = representative(from_part[k])
        b = to_part[k]
        path = root from_part[k]
        if (!(b in order)) {
            violation_at(path, line_of[k], "includes " b ", which the manifest does not list", \
                         "list it or remove the include")
        } else if (a in order && layer_of[b] > layer_of[a]) {
            violation_at(path, line_of[k], \
                         "layer " layer_name[layer_of[a]] " includes " b " of a higher layer", \
                         "include only lower layers, or earlier parts of the same layer")
        } else if (a in order && order[b] >= order[a]) {
            violation_at(path, line_of[k], "includes " b ", which the manifest lists later", \
                         "exchange them in the manifest or remove the include")
        }
    }
}

function check_listed(    k, exists, path) {
    for (k = 2; k <= n_files; k++) {
        path = files[k]
        exists[path] = 1
        if (is_repeated(path) ? !(path in first_user) : !(path in order))
            violation_at(root path, 1, "no file includes this part", \
                         "list it in the manifest or delete it")
    }
    for (k = 1; k <= n_listed; k++)
        if (!(listed[k] in exists))
            violation_at(root listed[k], 1, "the manifest lists this part, but it does not exist", \
                         "write it or remove it from the manifest")
}

# ---- names in src/ ----

function identifier(text) {
    return match(text, /^[A-Za-z_][A-Za-z_0-9]*/) ? substr(text, 1, RLENGTH) : ""
}

function check_name(name) {
    if (name != "" && name !~ /^(sl|sli)_/ && name !~ /^(SL|SLI|SLV|SLW|SLF)_/ && \
        name != "SPARSE_LOCAL_IMPLEMENTED" && name !~ /^(WIN32_LEAN_AND_MEAN|NOMINMAX)$/)
        violation("`" name "` at file scope has no prefix", \
                  "name it sli_" name " (macros: SLI_, SLV_, SLW_, SLF_)")
}

# Checks the name that a line declares: the name before the first parenthesis (a function), the tag
# after struct, enum or union, or the name before = [ or ; (a table or a type).
function check_declaration(line,    rest, name) {
    if (line ~ /__declspec\(dllimport\)/) # a function of Windows: its name is given
        return
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

# Sets inside_comment to whether the next line begins inside a block comment.
function track_comment(line) {
    gsub(/"[^"]*"/, "", line)
    gsub(/\/\*([^*]|\*[^\/])*\*\//, "", line)
    if (inside_comment) { if (line ~ /\*\//) inside_comment = 0 }
    else if (line ~ /\/\*/) inside_comment = 1
}

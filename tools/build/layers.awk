# layers.awk: checks the direction of all includes and the names at file scope of src/ (make layers)
#
#     awk -f tools/build/layers.awk src/sparse_local.in.h src/public/*.h \
#         src/impl/*/*.h src/impl/*/*/*.h OTHER ...
#
# src/: the manifest sparse_local.in.h is the first argument. It lists the parts (the other files of
# src/) bottom up. A folder is a layer with its subfolders, and the manifest lists its parts one
# after another. A part includes parts of lower layers and earlier parts of its own layer, and
# nothing outside src/. A repeated part (*.inl.h, *.list.h) has no include guard and is not in the
# manifest. A part that defines a macro as the path of a header includes it.
# It takes the place of the first part that includes it.
#
# OTHER: C files of tools/, tests/ and bench/. A file includes files of its own folder, and
#     tools/X      of the tools folders below X: adapters < matrix < io < mesh < geometry < draw <
#                  cli
#     tests/X      of tools/ and tests/lib
#     bench/X      of tools/ and bench/lib
# All of them include sparse_local.h, but nothing of src/.
#
# Packs: blocks of the manifest whose condition is defined(SL_WITH_X), with && and || between
# several. SL_WITH_ is in the manifest, public/packs.h and impl/packs/ only. The core, which is
# outside these blocks, includes no part of a pack; a part under a condition includes parts of the
# core and of conditions that follow from its own, also by what public/packs.h defines. The last
# parts, impl/packs/, fill the tables that the core calls through: they include any part. All parts
# of a folder that is a pack of its own, impl/x with a macro SL_WITH_X, are under conditions from
# which SL_WITH_X follows.
#
# Each violation is printed as file:line, rule and fix. Any violation makes the exit status 1.

BEGIN {
    n_tools = split("adapters matrix io mesh geometry draw cli", folder_name, " ")
    for (k = 1; k <= n_tools; k++) tools_rank["tools/" folder_name[k] "/"] = k
}

FNR == 1 {
    is_manifest = NR == 1
    if (is_manifest) {
        root = directory(FILENAME)
        manifest = FILENAME
    }
    in_src = index(FILENAME, root) == 1
    file = FILENAME
    part = in_src ? substr(FILENAME, length(root) + 1) : ""
    if (in_src) files[++n_files] = part
    inside_comment = continued = n_blocks = directive = 0
    n_checked++
    if (index($0, "/* " base(FILENAME) ": ") != 1)
        violation("the first line does not say what the file is", \
                  "begin with: /* " base(FILENAME) ": ...")
}

/SL_WITH_/ && in_src && !is_manifest && !is_about_packs(part) {
    violation("names a macro of a pack", \
              "put what depends on it into a part of its own, under a condition in the manifest")
}

# Blocks of the manifest and of public/packs.h. A condition may go on in the next lines.
(is_manifest || part == "public/packs.h") && /^[ \t]*#[ \t]*(if|ifdef|ifndef|elif|else|endif)/ {
    directive = FNR
}
directive && (is_manifest || part == "public/packs.h") {
    line = directive == FNR ? $0 : line " " $0
    if (sub(/\\$/, "", line)) next
    follow_block(line)
    directive = 0
    next
}
part == "public/packs.h" && /^[ \t]*#[ \t]*define[ \t]+SL_WITH_/ { note_implied($0) }

/^[ \t]*#[ \t]*include[ \t]*"/ || \
(in_src && /^[ \t]*#[ \t]*define[ \t]+SLI_[A-Z_]+[ \t]+"[^"]*\.h"/) {
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
    } else if (!inside_comment && !continued && $0 ~ /^[A-Za-z_}]/) {
        check_declaration($0)
    }
    continued = $0 ~ /\\$/
    track_comment($0)
}

END {
    check_order()
    check_listed()
    check_packs()
    if (failures) print failures " violation(s)"
    else print "layers: " n_checked " files, " n_includes " includes, all in order"
    exit failures > 0
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
        layer_of[target] = layer_in_manifest(layer_folder(target))
        condition_of[target] = block_condition()
        manifest_line[target] = FNR
        return
    }
    n_includes++
    from_part[++n_edges] = part
    to_part[n_edges] = target
    line_of[n_edges] = FNR
    if (is_repeated(target) && !(target in first_user)) first_user[target] = part
}

# public/, or the folder of impl/ that a part is in, at any depth.
function layer_folder(path) {
    return match(path, /^impl\/[^\/]+\//) ? substr(path, 1, RLENGTH) : directory(path)
}

# The number of a folder's layer, in the order in which the manifest names the folders.
function layer_in_manifest(dir) {
    if (dir == last_dir) return n_layers
    last_dir = dir
    if (dir in is_layer)
        violation("the manifest lists layer " dir " in two places", \
                  "list its parts one after another")
    is_layer[dir] = 1
    layer_name[++n_layers] = dir
    return n_layers
}

function is_repeated(path) { return path ~ /\.(inl|list)\.h$/ }

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

# ---- packs ----

function is_about_packs(path) { return path == "public/packs.h" || path ~ /^impl\/packs\// }

# Follows the blocks of a file: block[1 .. n_blocks] are the conditions of those that are open, as
# alternatives of packs, " INVERSE BATCH | SAVE "; "" if a condition is not one of packs.
function follow_block(line,    packs) {
    sub(/\/\*.*/, "", line)
    if (line ~ /#[ \t]*endif/) {
        if (n_blocks > 0) n_blocks--
        return
    }
    if (line ~ /#[ \t]*(else|elif)/) {
        if (n_blocks > 0 && block[n_blocks] != "" && is_manifest)
            violation("a block of packs has a second branch", \
                      "remove it: amalgamate writes what a call of a pack needs")
        if (n_blocks > 0) block[n_blocks] = ""
        return
    }
    packs = alternatives(line)
    if (is_manifest && line ~ /SL_WITH_/) {
        if (packs == "")
            violation("a condition of packs is not defined(SL_WITH_X) with && or || between", \
                      "write it so, without other macros")
        else if (block_condition() != "")
            violation("blocks of packs nest", "write one condition with && for both")
    }
    block[++n_blocks] = packs
}

# The packs of a condition, as in block[]. In public/packs.h !defined(SL_WITH_X) is passed over: it
# only prevents that a macro is defined twice.
function alternatives(line,    rest) {
    sub(/^[ \t]*#[ \t]*/, "", line)
    if (!is_manifest)
        gsub(/(&&[ \t]*)?![ \t]*defined[ \t]*\([ \t]*SL_WITH_[A-Z0-9_]+[ \t]*\)/, "", line)
    if (!sub(/^ifdef[ \t]+/, "", line) && !sub(/^if[ \t]+/, "", line)) return ""
    gsub(/defined[ \t]*\([ \t]*SL_WITH_[A-Z0-9_]+[ \t]*\)/, " & ", line)
    gsub(/defined[ \t]*\([ \t]*|[ \t]*\)|defined[ \t]+/, " ", line)
    gsub(/&&/, " ", line)
    gsub(/\|\|/, "|", line)
    if (!is_manifest) gsub(/[()]/, " ", line)
    rest = line
    gsub(/SL_WITH_[A-Z0-9_]+|[|]|[ \t]/, "", rest)
    if (rest != "" || line !~ /SL_WITH_/) return ""
    gsub(/SL_WITH_/, "", line)
    gsub(/[|]/, " | ", line)
    gsub(/[ \t]+/, " ", line)
    return " " line " "
}

# The condition of packs under which a line of the manifest is, or "".
function block_condition(    k) {
    for (k = 1; k <= n_blocks; k++)
        if (block[k] != "") return block[k]
    return ""
}

# public/packs.h defines a pack within a block whose condition names one pack, or several with ||.
function note_implied(line,    name, names, n, k) {
    sub(/^[ \t]*#[ \t]*define[ \t]+SL_WITH_/, "", line)
    name = identifier(line)
    n = split(block_condition(), names, "|")
    for (k = 1; k <= n; k++) {
        gsub(/ /, "", names[k])
        if (names[k] != "ALL" && names[k] != name) implied[++n_implied] = names[k] " " name
    }
}

# The packs of an alternative and those that they imply.
function closure(packs,    k, pair, changed) {
    packs = " " packs " "
    do {
        changed = 0
        for (k = 1; k <= n_implied; k++) {
            split(implied[k], pair, " ")
            if (index(packs, " " pair[1] " ") && !index(packs, " " pair[2] " ")) {
                packs = packs pair[2] " "
                changed = 1
            }
        }
    } while (changed)
    return packs
}

# Whether condition b holds wherever condition a does.
function follows(a, b,    of_a, of_b, n_a, n_b, i, k, m, n, packs, wanted, holds) {
    if (b == "") return 1
    n_a = split(a, of_a, "|")
    n_b = split(b, of_b, "|")
    if (a == "") return 0
    for (i = 1; i <= n_a; i++) {
        packs = closure(of_a[i])
        for (k = 1; k <= n_b; k++) {
            n = split(of_b[k], wanted, " ")
            holds = 1
            for (m = 1; m <= n; m++)
                if (!index(packs, " " wanted[m] " ")) holds = 0
            if (holds) break
        }
        if (!holds) return 0
    }
    return 1
}

function in_words(condition) {
    if (condition == "") return "the core"
    gsub(/^ +| +$/, "", condition)
    gsub(/ +\| +/, "|", condition)
    gsub(/ +/, " and SL_WITH_", condition)
    gsub(/\|/, " or SL_WITH_", condition)
    return "SL_WITH_" condition
}

# Includes, and the folders of packs. A template is compiled where each part is that includes it.
function check_packs(    k, b, path, pack, is_pack, under, names, n) {
    for (path in condition_of) {
        n = split(condition_of[path], names, /[ |]+/)
        for (k = 1; k <= n; k++)
            if (names[k] != "") is_pack["impl/" tolower(names[k]) "/"] = " " names[k] " "
    }
    for (k = 1; k <= n_listed; k++) {
        path = listed[k]
        pack = layer_folder(path)
        if (!(pack in is_pack) || follows(condition_of[path], is_pack[pack])) continue
        under = condition_of[path] == "" ? "no condition" : in_words(condition_of[path])
        violation_at(manifest, manifest_line[path], \
                     path " is in the folder of a pack, but under " under, \
                     "put it under " in_words(is_pack[pack]) ", or into another folder")
    }
    for (k = 1; k <= n_edges; k++) add_user(from_part[k], to_part[k])
    for (k = 1; k <= n_edges; k++) {
        b = to_part[k]
        if (!(b in condition_of) || is_about_packs(from_part[k])) continue
        check_users(from_part[k], condition_of[b], root from_part[k], line_of[k], b, 0)
    }
}

# Checks that the condition of a target follows from that of the part that includes it, or of each
# part that includes the template which includes it.
function check_users(user, needed, path, line, target, depth,    k, n, all, who, fix) {
    if (is_repeated(user)) {
        n = depth < 16 ? split(users[user], all, " ") : 0
        for (k = 1; k <= n; k++) check_users(all[k], needed, path, line, target, depth + 1)
    } else if (user in condition_of && !follows(condition_of[user], needed)) {
        who = "a part of " in_words(condition_of[user])
        fix = "move what is shared to the core, or change a condition in the manifest"
        if (condition_of[user] == "") {
            who = "the core"
            fix = "call it through a table that impl/packs/ fills, or move what is shared"
        }
        violation_at(path, line, who " includes " target " of " in_words(needed) \
                     (root user == path ? "" : ", by " user), fix)
    }
}

# The files that include a template.
function add_user(from, to) {
    if (is_repeated(to)) users[to] = users[to] " " from
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

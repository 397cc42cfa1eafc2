#!/bin/sh
# check_packs.sh: packs in a small manifest: what amalgamate writes for them, and what make layers
# refuses (make check-packs)
#
#     tests/core/check_packs.sh
#
# The manifest has a core and the packs CHANGE, SAVE and WIDE; WIDE implies SAVE.
# CC  the C compiler, default cc; CXX  the C++ compiler, default g++

root=$(cd "$(dirname "$0")/../.." && pwd)
. "$root/tests/lib/checks.sh"
checks_folder packs
cd "$dir" || exit 1
cc=${CC:-cc}
cxx=${CXX:-g++}
warnings='-Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror'
amalgamate=$root/build/amalgamate

# part PATH TITLE: writes standard input as a guarded part of src.
part() {
    mkdir -p "$(dirname "src/$1")"
    guard=SL_$(echo "$1" | tr 'a-z/.' 'A-Z__')
    { echo "/* ${1##*/}: $2 */"; printf '#ifndef %s\n#define %s\n' "$guard" "$guard"
      cat; echo '#endif'; } >"src/$1"
}

part public/config.h 'version and linkage' <<'C'
#ifndef SL_HEADER
#define SL_HEADER "small.h"
#endif
#define SL_VERSION_MAJOR 1
#define SL_VERSION_MINOR 2
#define SL_VERSION_PATCH 3
#define SL_API extern
C
part public/packs.h 'which packs are compiled' <<'C'
/* SL_WITH_ALL means all. */
#if defined(SL_WITH_ALL)
#undef SL_WITH_CHANGE
#define SL_WITH_CHANGE
#undef SL_WITH_WIDE
#define SL_WITH_WIDE
#endif
#if defined(SL_WITH_WIDE) && \
    !defined(SL_WITH_SAVE)
#define SL_WITH_SAVE
#endif
C
part public/core.h 'the core' <<'C'
/** Adds. */
SL_API int sl_add(int a, int b);
C
part public/change.h 'changes' <<'C'
/** Doubles. SL_API int sl_in_a_comment(void); is no declaration. */
SL_API int sl_change(int a);
#if defined(SL_NEVER)
SL_API int sl_change_back(int a,
                          int b);
#endif
C
part public/save.h 'files' <<'C'
SL_API const char *
sl_save(void);
C
part public/save_change.h 'files of changes' <<'C'
SL_API int sl_save_change(void);
C
part impl/base/base.h 'what all need' <<'C'
/* A comment of the implementation,
 * in two lines. */
static int sli_one(void) {
    /* the first
     * number */
    if (sizeof(int) == 1 || /* branches untested: it has 4 */
        sizeof(int) == 2)
        return 2; /* untested: the same */
    return 1; /* trailing, in
               * two lines */
}
C
cat >src/impl/base/sum.inl.h <<'C'
/* sum.inl.h: a template */
static int SLI_NAME(int a, int b) {
    return a + b + SLI_TERM;
}
#undef SLI_NAME
#undef SLI_TERM
C
sed 's/sum/twice/; s/a + b/a * b/' src/impl/base/sum.inl.h >src/impl/base/twice.inl.h
cat >src/impl/base/each.list.h <<'C'
/* each.list.h: a list
 * of what a macro names */

#include SLI_FOR_EACH
C
mkdir -p src/impl/change
cat >src/impl/change/change.list.h <<'C'
/* change.list.h: templates of changes */

#include "../base/twice.inl.h"
C
part impl/core/core.h 'bodies of the core' <<'C'
#include "../base/base.h"
typedef struct sli_table {
    int (*change)(int a);
} sli_table;
extern const sli_table sli_hooks;
#define SLI_NAME sli_add
#define SLI_TERM 0
#include "../base/sum.inl.h"
int sl_add(int a, int b) {
    return sli_add(a, b) * sli_one() + (sli_hooks.change ? 100 : 0);
}
C
part impl/change/change.h 'bodies of changes' <<'C'
#include "../core/core.h"
#define SLI_NAME sli_double
#define SLI_TERM 0
#define SLI_FOR_EACH "../change/change.list.h"
#include "../base/each.list.h"
#undef SLI_FOR_EACH
int sl_change(int a) {
    return sli_double(a, 2);
}
C
part impl/save/save.h 'bodies of files' <<'C'
const char *sl_save(void) {
    return "saved";
}
C
part impl/save/more/save_change.h 'bodies of files of changes' <<'C'
#include "../../change/change.h"
#include "../save.h"
int sl_save_change(void) {
    return sl_change(*sl_save());
}
C
part impl/wide/wide.h 'bodies of wide' <<'C'
#include "../save/save.h"
int sl_wide(void);
int sl_wide(void) {
    return *sl_save();
}
C
part impl/packs/tables.h 'what packs give the core' <<'C'
#include "../core/core.h"
#ifdef SL_WITH_CHANGE
#include "../change/change.h"
const sli_table sli_hooks = {sl_change};
#elif defined(SL_WITH_SAVE)
const sli_table sli_hooks = {0}; /* saved */
#else
const sli_table sli_hooks = {0};
#endif
C
cat >src/small.in.h <<'C'
/* small.in.h: the manifest of a test */
#ifndef SPARSE_LOCAL_H
#define SPARSE_LOCAL_H
#include "public/config.h"
#include "public/packs.h"
#ifdef __cplusplus
extern "C" {
#endif
#include "public/core.h"
#if defined(SL_WITH_CHANGE)
#include "public/change.h"
#endif
#ifdef SL_WITH_SAVE
#include "public/save.h"
#endif
#if defined(SL_WITH_SAVE) && \
    defined(SL_WITH_CHANGE)
#include "public/save_change.h"
#endif
#ifdef __cplusplus
}
#endif
#endif /* SPARSE_LOCAL_H */
/* ---- bodies ---- */
#if defined(SPARSE_LOCAL_IMPLEMENTATION) && !defined(SPARSE_LOCAL_IMPLEMENTED)
#define SPARSE_LOCAL_IMPLEMENTED
/* base: what all need */
#include "impl/base/base.h"
/* core: additions */
#include "impl/core/core.h"
/* change: multiplications */
#if defined(SL_WITH_CHANGE)
#include "impl/change/change.h"
#endif
/* save: files */
#if defined(SL_WITH_SAVE)
#include "impl/save/save.h"
#endif
#if defined(SL_WITH_SAVE) && defined(SL_WITH_CHANGE)
#include "impl/save/more/save_change.h"
#endif
/* wide: nothing */
#if defined(SL_WITH_WIDE)
#include "impl/wide/wide.h"
#endif
/* packs: tables */
#include "impl/packs/tables.h"
#endif
C

cat >user.c <<'C'
#define SPARSE_LOCAL_IMPLEMENTATION
#include HEADER
int main(void) {
    return sl_add(1, 2) != SUM;
}
C
cat >calls.c <<'C'
#include HEADER
int main(void) {
    return CALL;
}
C

# ---- what amalgamate writes ----

# runs HEADER SUM FLAG ...: a program of the core, without a warning, as C and C++
runs() {
    header=$1 sum=$2
    shift 2
    # shellcheck disable=SC2086
    $cc -std=c99 $warnings -DHEADER="\"$header\"" -DSUM="$sum" "$@" user.c -o user && ./user &&
        $cxx -x c++ -std=c++11 $warnings -DHEADER="\"$header\"" -DSUM="$sum" "$@" user.c \
            -fsyntax-only
}

# refused MESSAGE COMMAND: the command fails, and says MESSAGE.
refused() {
    message=$1
    shift
    "$@" >refused 2>&1 && return 1
    grep -q -e "$message" refused || { cat refused; return 1; }
}

# needs HEADER CALL MACROS FLAG ...: the call is an error that names the macros
needs() {
    header=$1 call=$2 message="${2%%(*}_needs_$3"
    shift 3
    refused "$message" $cc -std=c99 -fsyntax-only -DHEADER="\"$header\"" "-DCALL=$call" "$@" \
        calls.c &&
        refused "$message" $cxx -x c++ -std=c++11 -fsyntax-only -DHEADER="\"$header\"" \
            "-DCALL=$call" "$@" calls.c
}

check 'all packs in one header' '$amalgamate src/small.in.h small.h &&
    $amalgamate --check src/small.in.h small.h'
for flag in CHANGE:103 SAVE:3 WIDE:3 ALL:103 NONE:3; do
    check "SL_WITH_${flag%:*}" 'runs small.h ${flag#*:} -DSL_WITH_${flag%:*}'
done
check 'a call without its pack is an error that names the macro' '
    needs small.h "sl_change(1)" SL_WITH_CHANGE &&
    needs small.h "sl_change_back(1, 2)" SL_WITH_CHANGE -DSL_WITH_SAVE &&
    needs small.h "sl_save() != 0" SL_WITH_SAVE -DSL_WITH_CHANGE &&
    needs small.h "sl_save_change()" SL_WITH_SAVE_and_SL_WITH_CHANGE -DSL_WITH_CHANGE'
check 'no macro for what a comment names' '! grep -q "define sl_in_a_comment" small.h'
check 'a table of contents with the conditions of public parts' '
    grep -q "change.h *changes (SL_WITH_CHANGE)" small.h &&
    grep -q "save_change.h files of changes (SL_WITH_SAVE and SL_WITH_CHANGE)" small.h'
check 'without comments of the implementation' '! grep -q "of the implementation,$" small.h'

check 'a list of templates is one macro, its comments and names of lists stay behind' '
    [ "$(grep -c "define SLI_INL_CHANGE$" small.h)" -eq 1 ] &&
    [ "$(grep -c "define SLI_INL_TWICE$" small.h)" -eq 1 ] &&
    ! grep -e SLI_FOR_EACH -e "a list" -e "templates of changes" small.h'
check '--packs: the core' '$amalgamate --packs "" src/small.in.h core.h && runs core.h 3 &&
    grep -q "^ \* without packs" core.h && ! grep -q "if.*defined(SL_WITH" core.h'
check '--packs: no bodies, headings or templates of other packs' '
    ! grep -e sli_double -e SLI_INL_TWICE -e SLI_INL_CHANGE core.h &&
    ! grep -e "(change:" -e "/\* change:" -e saved core.h &&
    grep -q "SLI_INL_SUM" core.h'
check '--packs: calls of other packs are errors that name the macro' '
    needs core.h "sl_change(1)" SL_WITH_CHANGE &&
    needs core.h "sl_save_change()" SL_WITH_SAVE_and_SL_WITH_CHANGE'
check '--packs: a macro of a pack that is not in the header is an error' '
    refused "core.h is without SL_WITH_CHANGE" \
        $cc -DHEADER="\"core.h\"" -DCALL=0 -DSL_WITH_CHANGE calls.c &&
    refused "core.h is without some packs" \
        $cc -DHEADER="\"core.h\"" -DCALL=0 -DSL_WITH_ALL calls.c'
check '--packs: one pack' '$amalgamate --packs change src/small.in.h one.h &&
    runs one.h 103 && runs one.h 103 -DSL_WITH_CHANGE && grep -q "^ \* with: change$" one.h &&
    needs one.h "sl_save() != 0" SL_WITH_SAVE'
check '--packs: implied ones' '$amalgamate --packs wide src/small.in.h wide.h &&
    runs wide.h 3 && grep -q "^ \* with: save, wide$" wide.h && grep -q "hooks = {0};" wide.h'
check '--packs: all of them' '$amalgamate --packs "wide change" src/small.in.h every.h &&
    runs every.h 103 -DSL_WITH_ALL'
check '--packs: an unknown one is an error that lists the known ones' '
    refused "NONE: no condition" $amalgamate --packs "change none" src/small.in.h x.h &&
    grep -q "fix: name some of: change, save, wide$" refused && [ ! -e x.h ]'
check '--packs --flat' '$amalgamate --flat --packs change src/small.in.h flat.h &&
    runs flat.h 103 && ! grep -q "include SL_HEADER" flat.h'
# pair NAME OPTION ...: NAME.h and NAME.c
pair() {
    pair=$1
    shift
    $amalgamate --declarations "$@" src/small.in.h $pair.h &&
        $amalgamate --bodies "$@" src/small.in.h $pair.c
}
# pair_runs NAME SUM FLAG ...: a program of its two files, without a warning, in C and in C++
pair_runs() {
    pair=$1 sum=$2
    shift 2
    $cc -std=c99 $warnings "$@" -c $pair.c -o pair.o || return 1
    for language in "$cc -std=c99" "$cxx -x c++ -std=c++11"; do
        $language $warnings -DHEADER="\"$pair.h\"" -DSUM="$sum" "$@" -c user.c -o user.o &&
            $cxx user.o pair.o -o user && ./user || return 1
    done
}
check '--declarations, --bodies: one API, each line of the header once' '
    pair pair && pair_runs pair 3 && pair_runs pair 103 -DSL_WITH_ALL &&
    ! grep -e sli_ -e SPARSE_LOCAL_IMPLEMENTED pair.h && ! grep "include SL_HEADER" pair.c &&
    $amalgamate --flat src/small.in.h flat.h &&
    $cc -fpreprocessed -dD -E -P pair.h >lines && $cc -fpreprocessed -dD -E -P pair.c >more &&
    sed -n "/IMPLEMENTATION.*&&/,\$p" more >>lines &&
    $cc -fpreprocessed -dD -E -P flat.h | cmp - lines'
check '--declarations: a call without its pack is an error that names the macro' '
    needs pair.h "sl_change(1)" SL_WITH_CHANGE &&
    needs pair.h "sl_save_change()" SL_WITH_SAVE_and_SL_WITH_CHANGE -DSL_WITH_CHANGE'
check '--declarations, --bodies: the contents are where they say' '
    for file in pair.h pair.c; do
        sed -n "s/^ \* *\([0-9]*\) \(impl.\)* *\([a-z_.]*\).*/\1 \3/p" $file >contents &&
        [ -s contents ] && while read -r line name; do
            sed -n "${line}p" $file | grep -q "$name" || exit 1
        done <contents || exit 1
    done && grep -q " config.h " pair.h && ! grep -q " config.h " pair.c'
check '--declarations, --bodies: of one pack' 'pair changing --packs change &&
    pair_runs changing 103 && grep -q "include \"changing.h\"" changing.c'
check '--bodies: of another version than the header' '
    sed "s/VERSION_MINOR 2/VERSION_MINOR 9/" pair.h >other.h &&
    sed "s/pair.h/other.h/" pair.c >x.c &&
    refused "of another version" $cc -std=c99 -fsyntax-only x.c'
check '--bodies: a manifest that does not say where they begin' '
    sed "/---- bodies/d" src/small.in.h >src/no_half.in.h &&
    refused "where the bodies begin" $amalgamate --bodies src/no_half.in.h x.h && [ ! -e x.h ]'
check '--comments' '$amalgamate --comments --packs "" src/small.in.h read.h && runs read.h 3 &&
    grep -q "^ \* in two lines. \*/" read.h && grep -q "^   \* number \*/" read.h &&
    grep -q "^             \* two lines \*/" read.h && ! grep -q "are in src/impl" read.h'
check '--comments: what the file is; no reasons why no test reaches a line' '
    grep -q "^ \* To be read from the top: it has the comments" read.h &&
    grep -q "untested: " small.h && ! grep -q "untested: " read.h'
check 'the same input gives the same bytes' '
    cp one.h before && rm one.h && $amalgamate --packs change src/small.in.h one.h &&
    cmp before one.h'

# ---- manifests that are refused ----

# manifest SED: a copy of the tree whose manifest is changed
manifest() {
    rm -rf other && cp -r src other && sed "$1" src/small.in.h >other/small.in.h
}
check 'a condition that has other macros' '
    manifest "s/^#if defined(SL_WITH_CHANGE)/& \&\& defined(SL_NO)/" &&
    refused "a condition of packs is" $amalgamate other/small.in.h x.h'
check 'a list whose templates are in another order than before' '
    manifest "" && echo "#include \"../base/sum.inl.h\"" >>other/impl/change/change.list.h &&
    sed -i "s/^#include .*sum.inl.h.*/&\n#include \"..\/base\/twice.inl.h\"/" \
        other/impl/core/core.h &&
    refused "its templates are not in the order of other parts" $amalgamate other/small.in.h x.h'
check 'a block within another one' '
    manifest "s/^#include .public.save_change.*/#ifdef SL_WITH_SAVE\n&\n#endif/" &&
    refused "do not nest" $amalgamate other/small.in.h x.h'
check 'a block with a second branch' '
    manifest "s/^#include .public.save_change.*/&\n#else/" &&
    refused "has a second branch" $amalgamate other/small.in.h x.h'

# ---- make layers ----

layers() {
    awk -f "$root/tools/build/layers.awk" "$1"/small.in.h "$1"/public/*.h "$1"/impl/*/*.h \
        "$1"/impl/*/*/*.h
}
# The small tree has some macros that stay and names of its own: what counts is what is new.
layers src >expected
# layer MESSAGE FIX: a violation of the changed tree that is none of src
layer() {
    layers other | sed 's/^other/src/' | diff expected - >new
    grep -q -e "^> .*$1" new && grep -q -e "^> .*fix: .*$2" new || { cat new; return 1; }
}
check 'layers: the tree is in order' '! grep -q -e pack -e SL_WITH -e includes.*of expected'
check 'layers: a part that names a pack' 'manifest "" &&
    echo "#ifdef SL_WITH_SAVE" >>other/impl/core/core.h &&
    layer "core.h:.*names a macro of a pack" "a part of its own"'
check 'layers: the core includes a pack' 'manifest "" &&
    echo "#include \"../save/save.h\"" >>other/impl/core/core.h &&
    layer "the core includes impl/save/save.h of SL_WITH_SAVE" "a table that impl/packs/ fills"'
check 'layers: a template of the core includes a pack' 'manifest "" &&
    echo "#include \"../save/save.h\"" >>other/impl/base/sum.inl.h &&
    layer "the core includes impl/save/save.h of SL_WITH_SAVE, by impl/core/core.h" "a table"'
check 'layers: a pack includes another one' 'manifest "" &&
    sed -i "s/^const/#include \"..\/change\/change.h\"\n&/" other/impl/save/save.h &&
    layer "a part of SL_WITH_SAVE includes impl/change/change.h of SL_WITH_CHANGE" "to the core"'
check 'layers: a part of a pack under no condition' '
    manifest "s/^#include .impl.save.save.h.*/#endif\n&\n#ifdef SL_WITH_SAVE/" &&
    layer "save.h is in the folder of a pack, but under no condition" "put it under SL_WITH_SAVE"'
check 'layers: a part of a pack under the condition of another one' '
    manifest "s/^#include .impl.save.more.save_change.*/#endif\n#ifdef SL_WITH_CHANGE\n&/" &&
    layer "save_change.h is in the folder of a pack, but under SL_WITH_CHANGE" "SL_WITH_SAVE"'
check 'layers: conditions that amalgamate refuses' '
    manifest "s/^#if defined(SL_WITH_CHANGE)/& \&\& defined(SL_NO)/" &&
    layer "a condition of packs is not" "without other macros" &&
    manifest "s/^#include .public.save_change.*/#ifdef SL_WITH_SAVE\n&\n#endif/" &&
    layer "blocks of packs nest" "one condition" &&
    manifest "s/^#include .public.save_change.*/&\n#else/" &&
    layer "has a second branch" "remove it"'
checks_end

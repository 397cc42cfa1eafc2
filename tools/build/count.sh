#!/bin/sh
# count.sh: what a reader of the library has to know, in numbers (size.sh)
#
#     tools/build/count.sh [constants | functions]
#
# Prints a name and a number a line: public calls; fields of sl_options without reserved; tuning
# constants; functions of src, those above 60 lines and those of more than 6 parameters; files in
# the largest folder of src/impl, subfolders apart. With an argument, lists the constants or the
# functions instead.

cd "$(dirname "$0")/../.." || exit 1
export LC_ALL=C

# A tuning constant is a macro SLI_NAME of src/impl whose value is a number other than 0 and 1,
# which are switches, and not a negative integer, which marks something. Two values of one name, as
# with and without SL_VERIFY, are one constant. Numbers in tables are not counted. These are no
# tuning constants:
#   READ_VERSION WRITE_VERSION SECTIONS_MAX   the format of saved files
#   TILE LANES_MAX CHAINS SUBSET_BITS _WORDS  shapes of registers and machine words
#   HUGE_PAGES POPULATE OSXSAVE               numbers of the operating system and the processor
#   ISAS PARTS                                counts of instruction sets and of parts of a number
constants() {
    awk '
        !/^#define SLI_[A-Z0-9_]+ +[^ ]/ { next }
        $2 ~ /^SLI_((READ|WRITE)_VERSION|SECTIONS_MAX$|SUBSET_(BITS|WORDS)$)/ { next }
        $2 ~ /^SLI_(TILE|LANES_MAX|CHAINS|HUGE_PAGES|POPULATE|OSXSAVE|ISAS|PARTS)$/ { next }
        {
            value = $0
            sub(/^#define [^ ]+ +/, "", value)
            sub(/ *\/[*].*/, "", value)
            gsub(/\((double|float|size_t|sl_int|sl_off|uint64_t)\)/, "", value)
            is_number = value ~ /^[-+*\/()<>.0-9a-fA-FxeEuUlL ]+$/ && value ~ /[0-9]/
            if (is_number && value !~ /^\(?(-[0-9]+|[01])\)?$/ && !($2 in seen))
                print FILENAME, $2, value
            if (is_number && value !~ /^\(?(-[0-9]+|[01])\)?$/) seen[$2] = 1
        }' src/impl/*/*.h src/impl/*/*/*.h
}

functions() {
    awk -f tools/build/functions.awk src/impl/*/*.h src/impl/*/*/*.h src/public/*.h
}

case $1 in
constants | functions) $1; exit ;;
'') ;;
*) sed -n '4p' "$0" >&2; exit 2 ;;
esac

echo calls "$(cat src/public/*.h | grep -c '^SL_API .*(')"
fields=$(sed -n '/^typedef struct sl_options/,/^} sl_options/p' src/public/options.h |
    sed 's/[/][*].*[*][/]//; /[/][*]/,/[*][/]/d' | grep -v reserved | grep -c '^ .*;')
echo options "$fields"
echo constants "$(constants | wc -l)"
functions | awk '
    { functions++; long += $3 > 60; wide += $4 > 6 }
    END {
        print "functions", functions
        print "long_functions", long + 0
        print "wide_functions", wide + 0
    }'
for folder in src/impl/*/ src/impl/*/*/; do
    find "$folder" -maxdepth 1 -type f | wc -l
done | sort -n | awk 'END { print "folder", $1 }'

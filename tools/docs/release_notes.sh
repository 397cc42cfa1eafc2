#!/bin/bash
# release_notes.sh: prints the section of CHANGELOG.md on one version: release_notes.sh 1.0.0
#
# Links are printed as their texts, since they lead to files of the repository, but for those to
# pages of the manual: these are named. Headings are one level higher. Ends with 1 if there is no
# such section, or if it is empty.

cd "$(dirname "$0")/../.." || exit 1
set -o pipefail
awk -v version="$1" '
    /^## / { inside = ($2 == version); if (inside) print "# sparse_local " substr($0, 4); next }
    inside { print; if ($0 != "") lines++ }
    END { if (lines == 0) { print "CHANGELOG.md has nothing on " version >"/dev/stderr"; exit 1 } }
' CHANGELOG.md | sed 's/^###/##/
    s/\[\([a-z]*\)[.]md\](tools[^)]*)/\1 in the manual/g
    s/\[\([^]]*\)\]([^)]*)/\1/g'

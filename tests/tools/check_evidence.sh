#!/bin/bash
# check_evidence.sh: evidence.sh on a made-up Makefile: what runs again, failures, fuzzers, table
#
#     tests/tools/check_evidence.sh
#
# Each target of the Makefile notes that it was run; the file FAIL names those that fail.

cd "$(dirname "$0")/../.." || exit 1
root=$PWD
. tests/lib/checks.sh
checks_folder evidence
evidence=$root/tests/lib/evidence.sh
unset MAKEFLAGS MAKELEVEL MAKE
cd "$dir" && mkdir -p project/tests/fuzz project/src && cd project || exit 1
export GIT_CONFIG_GLOBAL=/dev/null GIT_AUTHOR_NAME=a GIT_AUTHOR_EMAIL=a GIT_COMMITTER_NAME=a
export GIT_COMMITTER_EMAIL=a FUZZ_SLICE=2

# A fuzzer is as fast as its number of executions; a run is not slept through.
cat >Makefile <<'MAKE'
FUZZ_SECONDS = 20
FUZZERS = tests/fuzz/fuzz_one.c tests/fuzz/fuzz_two.c
note = @echo $@ $(JUDGE_COUNT) >>ran; ! grep -qx $@ FAIL
test:
	@echo '   3 passed, 1 s'
	@echo '10 passed, 0 failed, 2 skipped'
	$(note)
packs:
	@echo '1 passed, 0 failed'; echo '2 passed, 1 failed, 4 skipped'
	$(note)
python:
	@echo '==== 7 passed, 3 skipped in 1.25s ===='
	$(note)
judge:
	@echo '[  PASSED  ] 1 test(s).'
	$(note)
mcdc:
	@echo 'mcdc: skipped, clang-99 could not be installed'
	$(note)
docs:
	@echo fine
	$(note)
cov:
	@mkdir -p build/cov && printf 'lines: 100.0%%\nbranches: 99.9%%\n' >build/cov/summary.txt
	@echo '5 passed, 0 failed'
	$(note)
late: docs
	$(note)
slow:
	@echo $@ >>ran; test ! -f HANG || while ! [ -s hangs ]; do sleep 0.1; done
	@kill -TERM $$(cat pid); sleep 1
fuzz: $(FUZZERS:tests/fuzz/fuzz_%.c=fuzz_%)
fuzz_%:
	@mkdir -p build/fuzz && echo fuzz_$* $(FUZZ_SECONDS) >>ran
	@test ! -f HANG || { echo $$$$ >hangs; exec sleep 60; }
	@printf 'stat::number_of_executed_units: 100\nDone 100 runs in $(FUZZ_SECONDS) second(s)\n' \
	>build/fuzz/$*.log; ! grep -qx $@ FAIL
test-page:
	@echo page >>ran
MAKE
touch FAIL tests/fuzz/fuzz_one.c tests/fuzz/fuzz_two.c src/code.h src/README.md
echo /build/ >.gitignore
printf 'ran\nFAIL\npid\nout\nHANG\nhangs\n' >>.gitignore
git init -q . && git add -A && git commit -qm first || exit 1

# evidence ARGUMENT ...: `out` is what it prints, `ran` what it has run
evidence() {
    rm -f ran
    # its process is that of a script that another one may end
    "$evidence" "$@" >out 2>&1 </dev/null &
    echo $! >pid
    wait $!
}
# ran NAME ...: these targets were run, each once, and no other one but the page
ran() {
    grep -v -e fuzz_ -e page ran | cut -d ' ' -f 1 | sort | diff - <(printf '%s\n' "$@" | sort)
}
ran_nothing() {
    ! grep -v page ran
}
in_table() { grep -F -e "$1" out || { cat out; return 1; }; }
all='test packs python judge docs cov'

check 'all targets and fuzzers pass' "evidence 5 $all && ran $all && tail -n 1 ran | grep page"
commit=$(git rev-parse --short HEAD)
today=$(date +%Y-%m-%d)
check 'the table: counts of run.sh, of several, of pytest, of cmocka, and none' "
    in_table '| \`test\` | 10 | 0 | 2 | $commit | $today | ' &&
    in_table '| \`packs\` | 3 | 1 | 4 | $commit | ' && in_table '| \`python\` | 7 | 0 | 3 | ' &&
    in_table '| \`judge\` | 1 | 0 | 0 | ' && in_table '| \`docs\` | yes | 0 | 0 | '"
check 'the table: machine, seconds and remarks' "
    in_table ', $(getconf _NPROCESSORS_ONLN) cores, ' && grep '^| .docs. .* | [0-9]* |  |\$' out &&
    in_table '| lines 100.0%, branches 99.9% |' && in_table '| 1,000,000 systems |'"
check 'the judge alone has its count' "grep -qx 'judge 1000000' ran && grep -qx docs ran"
check 'fuzzers: slices up to their seconds in all, executions added' "
    [ \"\$(grep -c '^fuzz_one 2\$' ran)\" -eq 2 ] && grep -qx 'fuzz_one 1' ran &&
    in_table '| \`fuzz-one\` | 300 runs | 0 | 0 |' && in_table '| \`fuzz-two\` | 300 runs |' &&
    grep '^| .fuzz-one. .* | 5 |  |\$' out"
check 'on the same code nothing runs again' "
    evidence 5 judge docs && ran_nothing &&
    in_table '| \`judge\` | 1 | 0 | 0 | $commit |'"
check 'more seconds: a fuzzer goes on' "evidence 6 docs && grep -qx 'fuzz_two 1' ran &&
    [ \"\$(grep -c '^fuzz_two' ran)\" -le 2 ] && in_table '| \`fuzz-two\` | 400 runs |'"
check 'a target that is new runs alone' "evidence 6 judge docs late && ran docs late"
check 'pages are not code' "
    echo more >>src/README.md && evidence 6 judge docs python && ran_nothing"
check 'other code: rows say so, and where they ran' "
    echo more >>src/code.h && evidence --table judge docs >/dev/null; ! [ -f ran ] &&
    in_table '| \`judge\` | 1 | 0 | 0 | not run on this code; last on $commit | $today | ' &&
    in_table 'Of commit $commit-changed:' && evidence --table never &&
    in_table '| \`never\` | | | | not run on this code |'"
check 'other code: all run again' "git commit -qam second && evidence 2 judge docs &&
    ran judge docs && grep -qx 'fuzz_one 2' ran &&
    in_table \"| \\\`fuzz-one\\\` | 100 runs | 0 | 0 | \$(git rev-parse --short HEAD) |\""
check 'packages are not code of C and fuzzers, other tests not of fuzzers' "
    mkdir -p tools/python tests/core && touch tools/python/a.py &&
    evidence 2 judge docs && ran docs && ! grep fuzz_ ran && touch tests/core/a.c &&
    evidence 2 judge docs && ran docs judge && ! grep fuzz_ ran"
check 'a failure: the others run, its row and the last line say so, and it runs again' "
    echo docs >FAIL && echo 1 >>src/code.h && ! evidence 2 docs judge && ran docs judge &&
    in_table '| \`docs\` | 0 | 1 | 0 | ' && in_table '**failed**' &&
    tail -n 1 out | grep -qx 'failed, or not run: docs' &&
    : >FAIL && evidence 2 docs judge && ran docs && in_table '| \`docs\` | yes | 0 | 0 |'"
check 'a fuzzer that fails: the other one ends; it runs again from the start' "
    echo fuzz_one >FAIL && echo 2 >>src/code.h && ! evidence 4 docs &&
    tail -n 1 out | grep -qx 'failed, or not run: fuzz-one' &&
    in_table '| \`fuzz-two\` | 200 runs' &&
    : >FAIL && evidence 4 docs && in_table '| \`fuzz-one\` | 200 runs | 0 | 0 |'"
check 'what could not be installed is skipped, and runs again' "
    ! evidence 4 mcdc && in_table '**skipped** clang-99 could not be installed' &&
    ! evidence 4 mcdc && ran mcdc"
check 'stopped in the middle: what was done is kept' "
    echo 3 >>src/code.h && ! evidence 4 docs slow judge && ran docs slow &&
    evidence 4 docs judge && ran judge && in_table '| \`docs\` | yes | 0 | 0 |' &&
    in_table '| \`fuzz-one\` | 200 runs |'"
check 'stopped in the middle: fuzzers end, too' "
    touch HANG && ! evidence 9 slow && sleep 1 && ! kill -0 \$(cat hangs) && rm HANG &&
    in_file=\$(grep -c fuzz-one tests/evidence.tsv) && [ \$in_file -eq 1 ]"
check 'a checkout without build: results are those of the file' "
    rm -rf build && evidence 4 docs judge && ran_nothing"
check 'the order: first what .ci does not run; each target is in a Makefile' "
    cd $root && eval \"\$(sed -n \"/^rare='/,/^file=/p\" tests/lib/evidence.sh)\" &&
    grep -v '^ *#' .ci/run >$dir/ci &&
    for target in \$rare; do ! grep -qw -e \"make.* \$target\" $dir/ci || exit 1; done &&
    for target in \$nightly \$often; do
        grep -q \"make.* \$target\b\" $dir/ci || exit 1
    done &&
    for target in \$rare \$nightly \$often; do
        grep -qE \"^(test-%|([a-z-]+ )*\$target)( [a-z-]+)*:\" Makefile */*.mk */*/*.mk || exit 1
    done"
checks_end

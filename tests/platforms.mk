# platforms.mk: tests on other platforms and compilers, under checkers, by fuzzers (a part of the Makefile)

## FUZZ_SECONDS  how long each fuzzer runs
FUZZ_SECONDS ?= 20
## JUDGE_COUNT  how many systems `make judge` tries; JUDGE_SEED is the first one
JUDGE_COUNT ?= 100000
JUDGE_SEED ?= 1
## FUZZ_SEED  the seed of the fuzzers' random numbers; 0 chooses one
FUZZ_SEED ?= 0

.PHONY: deps-locales deps-tcc deps-mingw deps-wasm deps-cov deps-chromium test-exchange test-tcc deps-compilers test-compilers platforms platform-table \
	races valgrind test-stack test-msan test-mingw test-mingw-clang test-wasm cov mcdc fuzz run-fuzz judge evidence test-view

# ---- packages ----

deps-locales: ## locales with a decimal comma, for the tests of Matrix Market files
	@tools/build/deps.sh '/usr/lib/locale/de_DE.utf8=locales-all'

deps-tcc: ## tcc, a C compiler that is neither gcc nor clang
	@tools/build/deps.sh tcc=tcc

deps-mingw: ## compilers for Windows, and Wine, which runs Windows programs
	@tools/build/deps.sh x86_64-w64-mingw32-gcc=gcc-mingw-w64-x86-64-win32 /usr/lib/wine/wine64=wine64

deps-wasm: ## a C library for WebAssembly, and node, which runs it
	@tools/build/deps.sh node=nodejs wasm-ld=lld /usr/lib/wasm32-wasi/libc.a=wasi-libc \
	'/usr/lib/llvm-*/lib/clang/*/lib/wasi/libclang_rt.builtins-wasm32.a=libclang-rt-dev-wasm32'

deps-cov: ## gcovr
	@tools/build/deps.sh gcovr=gcovr

deps-chromium: ## the browser that test-view runs
	@tools/build/deps.sh chromium=chromium

# ---- platforms: the tests on other processors, C libraries and compilers ----

# Of each platform: compiler, emulator, flags, packages, tests. Programs are linked statically with cmocka and zlib (METIS too
# if metis_NAME) that cross_libs.sh compiles, so that they need no library of the platform. The bodies are compiled as
# gnu99, the dialect of a plain `cc -O2`: only there gcc keeps excess precision and contracts a * b + c.
PLATFORMS = i386 i386-x87 armhf aarch64 s390x ppc64le riscv64 musl
cross_i386 = i686-linux-gnu-
flags_i386 = -msse2 -mfpmath=sse
deps_i386 = i686-linux-gnu-gcc=gcc-i686-linux-gnu /usr/i686-linux-gnu/lib/libc.a=libc6-dev-i386-cross
metis_i386 = metis
cross_i386-x87 = $(cross_i386)
flags_i386-x87 = -mfpmath=387
deps_i386-x87 = $(deps_i386)
cross_armhf = arm-linux-gnueabihf-
# The offsets of qemu's directory entries have 64 bits.
flags_armhf = -D_FILE_OFFSET_BITS=64
run_armhf = qemu-arm
deps_armhf = arm-linux-gnueabihf-gcc=gcc-arm-linux-gnueabihf /usr/arm-linux-gnueabihf/lib/libc.a=libc6-dev-armhf-cross
cross_aarch64 = aarch64-linux-gnu-
# test_combination.c compares bits with sums of rounded products.
flags_aarch64 = -ffp-contract=off
run_aarch64 = qemu-aarch64
deps_aarch64 = aarch64-linux-gnu-gcc=gcc-aarch64-linux-gnu /usr/aarch64-linux-gnu/lib/libc.a=libc6-dev-arm64-cross
metis_aarch64 = metis
cross_s390x = s390x-linux-gnu-
run_s390x = qemu-s390x
deps_s390x = s390x-linux-gnu-gcc=gcc-s390x-linux-gnu /usr/s390x-linux-gnu/lib/libc.a=libc6-dev-s390x-cross
cross_ppc64le = powerpc64le-linux-gnu-
run_ppc64le = qemu-ppc64le
deps_ppc64le = powerpc64le-linux-gnu-gcc=gcc-powerpc64le-linux-gnu /usr/powerpc64le-linux-gnu/lib/libc.a=libc6-dev-ppc64el-cross
cross_riscv64 = riscv64-linux-gnu-
run_riscv64 = qemu-riscv64
deps_riscv64 = riscv64-linux-gnu-gcc=gcc-riscv64-linux-gnu /usr/riscv64-linux-gnu/lib/libc.a=libc6-dev-riscv64-cross
cross_musl = musl-
deps_musl = musl-gcc=musl-tools

# All core tests run on i386 and aarch64, where kernels of their own run. Elsewhere a few: the orders, and what depends on the
# size and order of bytes, as saved factors do; and all replays of the fuzzers.
PLATFORM_TESTS = $(patsubst %,tests/core/test_%.c,order_hashes result_hashes factor identity matrix_market matrix_market_file refine \
	submatrix storage storage_use save save_use save_limits save_file save_lies save_damage saved_set saved_set_use saved_set_damage) \
	tests/tools/test_mesh_ply.c
# These platforms are not part of each run, which would notice a name that is gone.
$(foreach test,$(PLATFORM_TESTS),$(if $(wildcard $(test)),,$(error PLATFORM_TESTS: there is no $(test))))
full_i386 = $(CORE_TESTS) tests/tools/test_mesh_ply.c
full_aarch64 = $(CORE_TESTS)
# musl-gcc has no archiver of its own
platform_ar = $(if $(filter musl,$(1)),ar,$(cross_$(1))ar)

.PHONY: $(PLATFORMS:%=deps-%) $(PLATFORMS:%=test-%)
$(PLATFORMS:%=deps-%): deps-%: build/deps.ok
	@tools/build/deps.sh $(deps_$*) $(if $(run_$*),$(run_$*)=qemu-user)
	@CC=$(cross_$*)gcc AR=$(call platform_ar,$*) tools/build/cross_libs.sh build/$* $(metis_$*)

$(PLATFORMS:%=test-%): test-%: deps-% sparse_local.h
	@+tools/build/platform.sh $* '$(cross_$*)gcc $(flags_$*)' '$(or $(run_$*),natively)' \
	$(SUB_MAKE) run-tests B=build/$* CC=$(cross_$*)gcc AR=$(call platform_ar,$*) RUN='$(run_$*)' SL_DATA= \
	INCLUDES='-isystem build/$*/include' OPT='-O1 $(flags_$*)' LINK='$(cross_$*)gcc -static' \
	IMPL_COMPILE='$$(CC) $$(C_FLAGS) -std=gnu99 -O2' METIS=$(if $(metis_$*),-DSL_METIS) \
	TEST_PROGRAMS='$(patsubst tests/%.c,build/$*/tests/%,$(or $(full_$*),$(PLATFORM_TESTS)))' \
	TEST_LIBS=build/$*/libcmocka.a LIBS='$(if $(metis_$*),build/$*/libmetis.a) build/$*/libz.a build/$*/libcjson.a -lm'

test-tcc: deps deps-tcc sparse_local.h
	@+tools/build/platform.sh tcc tcc natively $(SUB_MAKE) run-tests B=build/tcc CC=tcc WARN= DEPEND= SL_DATA= METIS= \
	TEST_PROGRAMS='$(PLATFORM_TESTS:tests/%.c=build/tcc/tests/%)' LIBS='$(FILE_LIBS) -lm'

## COMPILERS  of test-compilers; nothing: gcc-7 and clang-7 to the newest, as far as they are installed
COMPILERS ?=
deps-compilers: ## other versions of gcc and clang, of which Debian has those
	@tools/build/deps.sh gcc-11=gcc-11 clang-13=clang-13 clang-16=clang-16 clang-19=clang-19

test-compilers: sparse_local.h ## the core and all packs by each installed version of gcc and clang, and programs over them
	@tests/core/check_compilers.sh $(COMPILERS)

# The program over the objects of test-s390x, and natively.
test-exchange: test-s390x ## saved objects written on big endian, emulated, loaded on this machine, and the other way round
	@$(MAKE) --no-print-directory $(B)/tests/core/exchange
	@$(cross_s390x)gcc -std=c99 $(WARN) $(PACK_FLAGS) -O1 -I. -static -o build/s390x/exchange tests/core/exchange.c build/s390x/obj/sparse_local.o -lm
	@HERE=$(B)/tests/core/exchange THERE='$(run_s390x) build/s390x/exchange' tests/core/check_exchange.sh

test-i386: ## the header's tests on 32-bit x86 with SSE2
test-i386-x87: ## some of the tests on 32-bit x86 with the x87 unit and its excess precision
test-armhf: ## some of the tests on 32-bit ARM, emulated; plain C kernels
test-aarch64: ## the header's tests on 64-bit ARM with NEON, emulated
test-s390x: ## some of the tests on IBM Z, big endian, emulated
test-ppc64le: ## some of the tests on POWER, emulated
test-riscv64: ## some of the tests on RISC-V, emulated
test-musl: ## some of the tests with the C library musl
test-tcc: ## some of the tests, compiled by tcc

platforms: $(PLATFORMS:%=test-%) test-exchange test-tcc ## the tests on all of these platforms, one after the other with -j1

platform-table: ## prints the results of the platform targets as a Markdown table, as in tools/docs/platforms.md
	@printf '| platform | compiler | run | passed | failed | skipped |\n|---|---|---|---|---|---|\n'
	@cat build/platforms/*.txt

# ---- checkers of memory and of threads ----

races: deps sparse_local.h ## the tests of threads, watched for data races
	@+$(SUB_MAKE) run-tests B=build/races OPT='-O1 -g -fno-var-tracking -fsanitize=thread' $(FEW_TOOLS) \
	TEST_PROGRAMS='$(THREADED:%=build/races/tests/core/%)'

valgrind: deps ## the tests under valgrind (no AVX-512 there)
	@tools/build/deps.sh valgrind=valgrind
	@+$(SUB_MAKE) run-tests RUN='valgrind -q --leak-check=full --error-exitcode=99'

# The tests of what has the largest frames: null vectors, dissections, edits, regions, files, queries.
STACK_TESTS = $(patsubst %,$(B)/tests/core/test_%,fixed factor factor_edit inverse null_pivots null_vectors ordering constraints_rigid constraints_sets \
	pivots plan region submatrix rigid_calls rigid_mass_cases save saved_set saved_set_use selected symbolic_edit threads)
test-stack: deps sparse_local.h ## some of the tests on a stack of 64 kB; the limits on frames and chains of calls are in make size
	@+$(SUB_MAKE) run-tests RUN=tests/lib/small_stack.sh REPLAYS= TEST_PROGRAMS='$(STACK_TESTS)'

# ---- platforms that have no cmocka: tests/lib/cmocka has the part of it that the tests use ----

# The C tests whose only system is the C library and perhaps threads.
PORTABLE_TESTS := $(shell grep -L 'temporary_files\.h\|tools/\|real_data\.h\|unistd\.h' $(CORE_TESTS))
# WASI has no processor time.
WASM_TESTS := $(shell grep -L 'clock()' $(PORTABLE_TESTS))
WITHOUT_CMOCKA = METIS= TEST_LIBS= REPLAYS= SL_DATA=

MSAN_TESTS ?= $(CORE_TESTS)
# zlib is not instrumented: it only reads and writes the files of tests that the sanitizer does not see.
test-msan: deps deps-clang sparse_local.h ## the header's tests under clang's memory sanitizer: no uninitialized value is used
	@+tools/build/platform.sh msan 'clang -fsanitize=memory' natively \
	$(SUB_MAKE) run-tests B=build/msan CC=clang $(WITHOUT_CMOCKA) LIBS='$(FILE_LIBS) -lm' INCLUDES=-Itests/lib/cmocka \
	OPT='-O1 -g -fno-omit-frame-pointer -fsanitize=memory -fsanitize-memory-track-origins -fno-sanitize-recover=all -fsanitize-ignorelist=tests/lib/msan.ignore' \
	TEST_PROGRAMS='$(MSAN_TESTS:tests/%.c=build/msan/tests/%)'

# Programs get names without .exe, as the rules expect them; LIBRARY is the tools, which need POSIX. The isfinite of MinGW
# names a conversion to float that it does not do.
MINGW = x86_64-w64-mingw32-gcc
WINE = env -u TMPDIR WINEDEBUG=-all WINEPREFIX=$(CURDIR)/build/wine /usr/lib/wine/wine64
WINDOWS = $(WITHOUT_CMOCKA) INCLUDES=-Itests/lib/cmocka CFLAGS=-Wno-float-conversion LIBRARY= LINK='$(MINGW) -static' LIBS='-lpthread && mv $$@.exe $$@' RUN='$(WINE)'

test-mingw: deps-mingw sparse_local.h ## the portable tests for Windows, by gcc (plain C kernels), under Wine
	@mkdir -p build && $(WINE) wineboot -i >/dev/null 2>&1
	@+tools/build/platform.sh mingw '$(MINGW)' Wine \
	$(SUB_MAKE) run-tests B=build/mingw CC=$(MINGW) $(WINDOWS) \
	TEST_PROGRAMS='$(PORTABLE_TESTS:tests/%.c=build/mingw/tests/%)'

test-mingw-clang: deps-mingw deps-clang sparse_local.h ## the same by clang, with the AVX2 and AVX-512 kernels
	@mkdir -p build && $(WINE) wineboot -i >/dev/null 2>&1
	@+tools/build/platform.sh mingw-clang 'clang --target=x86_64-w64-mingw32' Wine \
	$(SUB_MAKE) run-tests B=build/mingw_clang CC='clang --target=x86_64-w64-mingw32' $(WINDOWS) \
	TEST_PROGRAMS='$(PORTABLE_TESTS:tests/%.c=build/mingw_clang/tests/%)'

# 8 MB of stack, as on Linux; WebAssembly has 64 kB by default.
test-wasm: deps-wasm deps-clang sparse_local.h ## the portable tests for WebAssembly with SIMD128, under node
	@+tools/build/platform.sh wasm 'clang --target=wasm32-wasi -msimd128' node \
	$(SUB_MAKE) run-tests B=build/wasm CC='clang --target=wasm32-wasi --sysroot=/usr' $(WITHOUT_CMOCKA) \
	OPT='-O2 -msimd128' LINK='$$(CC) -Wl,-z,stack-size=8388608' LIBRARY= LIBS= RUN='node --no-warnings --single-threaded-gc tests/lib/wasi/run.mjs' \
	INCLUDES='-Itests/lib/cmocka -Itests/lib/wasi' TEST_PROGRAMS='$(WASM_TESTS:tests/%.c=build/wasm/tests/%)'
# ---- coverage ----


# Counters are atomic because threads run too. The tests run without DATA, so that the figures are those
# of any checkout. The limits are what the tests reach; they only rise. Both are meant to be 100.
COV_LINES = 100
COV_BRANCHES = 99.9
# A line with `untested: REASON` in a comment is not counted, nor are the branches of one with `branches untested: REASON`: those of
# an inlined copy in which a parameter is constant, and those of a condition that nothing changes. SLW_EACH, SLW_HIGH and SLW_LOW write the
# code of SLI_..._OWN once for each column: whether there are the first two, and in the copy of 8 columns the last, is asked there, too.
# SLI_CUT asks at each array whether it counts.
GCOVR = gcovr --root . --exclude-throw-branches --exclude-unreachable-branches \
	--exclude-branches-by-pattern '.*(SLI_ASSERT\(|branches untested: |SLI_CUT\(|SLW_(EACH|HIGH|LOW)\(SLI_[A-Z]+_OWN,).*' \
	--exclude-lines-by-pattern '.*(/\* untested: |SLI_ASSERT\().*' --print-summary

# gcovr refuses functions that another object has on other lines, as the bodies with SL_NO_SINGULAR have.
cov: deps deps-cov deps-png sparse_local.h ## line and branch coverage of the header and of tools by the tests, with limits; build/cov/index.html
	@if [ -d build/cov ]; then find build/cov '(' -name '*.gcda' -o -name 'test_no_singular.*' ')' -delete; fi
	@+$(SUB_MAKE) run-tests B=build/cov SL_DATA= PROGRAM=build/cov/sparse-local CORE_TESTS='$(filter-out %/test_no_singular.c,$(CORE_TESTS))' \
	ALSO='$(PROGRAM_CHECKS)' OPT='-O0 -g --coverage -fprofile-update=atomic -DTEST_ALL_KERNELS'; status=$$?; \
	echo 'tools/'; $(GCOVR) --filter 'tools/' --html build/cov/tools.html build/cov/obj 2>build/cov/gcovr.log || cat build/cov/gcovr.log; \
	echo 'sparse_local.h'; $(GCOVR) --filter 'sparse_local\.h' --html-details build/cov/index.html \
	--fail-under-line $(COV_LINES) --fail-under-branch $(COV_BRANCHES) build/cov/obj 2>>build/cov/gcovr.log >build/cov/summary.txt; found=$$?; cat build/cov/summary.txt; [ $$found -eq 0 ] || { tail -n 5 build/cov/gcovr.log; exit 1; }; exit $$status

# Each condition has to decide its decision alone. Conditions of one variable, as in a == 1 || a == 2, never do, so that
# there is no limit. clang counts them from version 18 on.
MCDC = 19
MCDC_TESTS = $(sort $(filter-out $(OWN_BODIES),$(wildcard $(patsubst %,tests/core/test_%*.c,arguments bounds errors options csc matrix save forged triangle) tests/core/test_*_use.c tests/core/test_*_wrong.c)))

mcdc: deps sparse_local.h ## conditions of the checks of arguments and files that decide alone (MC/DC); needs clang $(MCDC)
	@+if ! tools/build/deps.sh clang-$(MCDC)=clang-$(MCDC) llvm-cov-$(MCDC)=llvm-$(MCDC) \
	'/usr/lib/llvm-$(MCDC)/lib/clang/*/lib/linux/libclang_rt.profile-*.a=libclang-rt-$(MCDC)-dev'; then \
	echo 'mcdc: skipped, clang-$(MCDC) could not be installed'; exit 0; fi; rm -rf build/mcdc/raw; \
	LLVM_PROFILE_FILE=build/mcdc/raw/%p $(SUB_MAKE) run-tests B=build/mcdc CC=clang-$(MCDC) SL_DATA= \
	OPT='-O0 -DSL_NO_SIMD' LINK='$$(CC) -fprofile-instr-generate' IMPL_COMPILE='$$(CC) $$(C_FLAGS) -w -fprofile-instr-generate -fcoverage-mapping -fcoverage-mcdc' \
	TEST_PROGRAMS='$(MCDC_TESTS:tests/%.c=build/mcdc/tests/%)' \
	REPLAYS='build/mcdc/tests/replay_saved build/mcdc/tests/replay_matrix_market' && \
	llvm-profdata-$(MCDC) merge -o build/mcdc/all build/mcdc/raw && \
	llvm-cov-$(MCDC) report build/mcdc/obj/sparse_local.o -instr-profile=build/mcdc/all -show-mcdc-summary -show-functions sparse_local.h >build/mcdc/functions.txt && \
	awk -f tools/build/mcdc.awk $(sort $(wildcard $(patsubst %,src/impl/%/*.h,base matrix save))) build/mcdc/functions.txt

# ---- fuzzers, random systems ----

fuzz: deps deps-clang sparse_local.h ## each fuzzer for FUZZ_SECONDS, from tests/fuzz/corpus
	@+$(SUB_MAKE) run-fuzz B=build/fuzz CC=clang OPT='-O1 -g -fno-omit-frame-pointer -DSL_VERIFY -DSL_NO_CLOCK \
	-fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=all' \
	IMPL_COMPILE='$$(CC) $$(C_FLAGS) -fno-sanitize-coverage=trace-cmp -fsanitize-coverage-ignorelist=tests/fuzz/kernels.ignore'

$(B)/run/%: $(B)/obj/tests/fuzz/fuzz_%.o $(LIBRARY) $(IMPL)
	@mkdir -p $(@D)
	$(call say,LINK)
	$(Q)$(LINK) -fsanitize=fuzzer -o $@ $^ $(LIBS)

# New inputs stay under B: those worth keeping are copied to tests/fuzz/corpus by hand. The runs are
# short: tracing every comparison of the header (above) and the schedule by entropy take longer than
# the calls themselves. The dictionaries know the words that the traces would find. With -j several run at once.
FUZZ_RUNS = $(FUZZERS:tests/fuzz/fuzz_%.c=run-fuzz-%)
.PHONY: $(FUZZ_RUNS)
run-fuzz: $(FUZZ_RUNS)

$(FUZZ_RUNS): run-fuzz-%: $(B)/run/%
	@mkdir -p $(B)/found/$* tests/fuzz/corpus/$*
	@ASAN_OPTIONS=malloc_context_size=4:quarantine_size_mb=1:max_malloc_fill_size=0 $(B)/run/$* -max_total_time=$(FUZZ_SECONDS) -seed=$(FUZZ_SEED) \
	-max_len=2048 -entropic=0 -print_funcs=0 -reduce_inputs=0 -print_final_stats=1 $(patsubst %,-dict=%,$(wildcard tests/fuzz/$*.dict)) \
	-artifact_prefix=$(B)/found/crash-$*- $(B)/found/$* tests/fuzz/corpus/$* >$(B)/$*.log 2>&1 || { tail -n 60 $(B)/$*.log; exit 1; }
	@awk -v name=$* '/number_of_executed_units/ { runs = $$2 } /average_exec_per_sec/ { rate = $$2 } \
	END { printf "fuzz %s: %d executions, %d a second\n", name, runs, rate }' $(B)/$*.log

judge: deps $(B)/tests/core/test_judge ## JUDGE_COUNT random systems from JUDGE_SEED on: wrong answers with SL_OK and without a signal
	@JUDGE_COUNT=$(JUDGE_COUNT) JUDGE_SEED=$(JUDGE_SEED) $(B)/tests/core/test_judge

## EVIDENCE  targets of make evidence; nothing: all
EVIDENCE ?=
evidence: ## what tests/README.md says of a release: all targets beside all fuzzers, for two hours or FUZZ_SECONDS; goes on where it stopped
	@+tests/lib/evidence.sh $(if $(filter file,$(origin FUZZ_SECONDS)),7200,$(FUZZ_SECONDS)) $(EVIDENCE)

# ---- a browser ----

test-view: deps-chromium deps-png ## the page of sparse-local view in a headless browser: it draws, turns and answers a click
	@+$(SUB_MAKE) run-tests TEST_PROGRAMS= REPLAYS= ALSO=tests/tools/check_view.sh PROGRAM=$(B)/sparse-local

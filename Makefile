# Makefile: makes sparse_local.h from src/, and checks, tests and measures it; `make help` lists what there is

## CC       C compiler: gcc or clang
## CXX      C++ compiler of the C++ checks and of the peers
CXX ?= g++
## OPT      optimization, and whatever a build of one's own needs
OPT ?= -O2
## JOBS     compilations at a time, if make was not told by -j; nothing: one for each processor
JOBS ?= $(shell nproc 2>/dev/null || echo 1)
SUB_MAKE = $(MAKE) --no-print-directory $(if $(filter -j%,$(MAKEFLAGS)),,-j$(JOBS))
## DATA     folder of real meshes and matrices; nothing needs it
DATA ?= ../shared/data
## BENCH    size of the bench: quick, full (to 4e6 unknowns) or nothing
BENCH ?=
## QUESTION questions of the bench by name (build/timed/bench --list); nothing: those of a newcomer, or all with BENCH
QUESTION ?=
## MESH     mesh file that the bench uses instead of its grids
MESH ?=
## OPENMP   compiler flag for the threads of the bench; nothing: a pool of pthreads
OPENMP ?= -fopenmp
## FUZZ_SECONDS  how long each fuzzer runs
FUZZ_SECONDS ?= 20
## JUDGE_COUNT  how many systems `make judge` tries; JUDGE_SEED is the first one
JUDGE_COUNT ?= 100000
JUDGE_SEED ?= 1
## FUZZ_SEED  the seed of the fuzzers' random numbers; 0 chooses one
FUZZ_SEED ?= 0
## B        folder of objects, test programs and the bench; what is the same for all of them stays in build
B ?= build
## V        1 shows every command
V ?=

Q := $(if $(V),,@)
say = @echo '  $(1)  $@'
SL_DATA ?= $(wildcard $(DATA))
export SL_DATA BENCH MESH

# clang warns of constants of an enum in sums of doubles from version 19 on.
WARN_BOTH = -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror $(if $(findstring clang,$(CC)),-Wno-enum-float-conversion)
WARN = $(WARN_BOTH) -Wstrict-prototypes -Wmissing-prototypes
C_FLAGS = -std=c99 $(OPT) $(WARN) -I. $(METIS) $(PACK_FLAGS) $(INCLUDES) $(CFLAGS)
CXX_FLAGS = -std=c++11 $(OPT) $(WARN_BOTH) -I. $(METIS) $(PACK_FLAGS) $(INCLUDES) $(CXXFLAGS)
IMPL_COMPILE = $(CC) $(C_FLAGS)
LINK = $(CC) $(OPT)
DEPEND = -MMD -MP
# The header needs no library by default; our own builds compile the orderings by METIS too.
METIS = -DSL_METIS
# Our own builds have all packs.
PACK_FLAGS = -DSL_WITH_ALL
# zlib and cJSON read and write the files of the tools.
FILE_LIBS = -lz -lcjson
LIBS = -lmetis $(FILE_LIBS) -lm
TEST_LIBS = -lcmocka

PARTS := $(wildcard src/public/*.h src/impl/*/*.h)
SRC := src/sparse_local.in.h $(PARTS)
MAIN := tools/cli/main.c
NEED_PNG := tools/draw/png_write.c
TOOLS := $(filter-out $(MAIN) $(NEED_PNG) tools/build/% tools/packaging/% tools/cluster/% tools/examples/%,$(wildcard tools/*/*.c))
CORE_TESTS := $(wildcard tests/core/test_*.c)
TOOL_TESTS := $(wildcard tests/tools/test_*.c)
TESTS := $(CORE_TESTS) $(TOOL_TESTS)
FUZZERS := $(wildcard tests/fuzz/fuzz_*.c)
SMALL_TASK_TESTS := $(patsubst %,tests/core/test_%.c,threads threads_solve inverse_threads reserve_inverse)
# Tests that compile the bodies with their own faults, or are linked with small tasks.
OWN_BODIES := $(shell grep -l 'define SPARSE_LOCAL_IMPLEMENTATION' $(TESTS) /dev/null) $(SMALL_TASK_TESTS)
BENCH_SOURCES := $(wildcard bench/lib/*.c bench/questions/*.c)
PEERS := $(wildcard bench/peers/*.c bench/peers/*.cpp)

object = $(addprefix $(B)/obj/,$(addsuffix .o,$(1)))
IMPL = $(B)/obj/sparse_local.o
# The bodies again, where small systems are divided among workers, too.
SMALL_TASKS = $(B)/obj/small_tasks.o
LIBRARY = $(B)/libtools.a
PAGE := build/view_page_text.c
TEST_PROGRAMS = $(TESTS:tests/%.c=$(B)/tests/%)
REPLAYS = $(FUZZERS:tests/fuzz/fuzz_%.c=$(B)/tests/replay_%)

.DELETE_ON_ERROR:
.SECONDARY:
.PHONY: deps-locales all help judge map header header-flat size style deps-tcc test-no-simd check-header layers parts check-promises programs deps deps-cxx deps-peers deps-clang \
	deps-cov deps-png test test-clang test-cxx test-tcc platforms platform-table sanitize valgrind cov mcdc fuzz bench bench-peers readme-table \
	figures bench-eigenpairs deps-arpack format tidy clean always test-figures test-page build-tests run-tests run-fuzz run-bench races test-openmp test-no-metis \
	deps-mingw deps-wasm test-msan test-mingw test-mingw-clang test-wasm test-exchange deps-mpi cluster test-cluster

all: check-header layers style parts test programs ## the checks, the tests, and the programs of tools/

help: ## this list
	@echo 'Targets'
	@awk -F ':.*## ' '/^[a-z-]+[a-z0-9-]*:.*## / { printf "  %-16s %s\n", $$1, $$2 }' Makefile tools/packaging/packaging.mk
	@echo 'Variables (make test CC=clang)'
	@sed -n 's/^## /  /p' Makefile tools/packaging/packaging.mk

# ---- the header ----

header: build/amalgamate ## makes sparse_local.h from src/
	build/amalgamate src/sparse_local.in.h sparse_local.h LICENSE

sparse_local.h: build/amalgamate $(SRC) LICENSE
	$(call say,MAKE)
	$(Q)build/amalgamate src/sparse_local.in.h $@ LICENSE
	@touch $@

header-flat: build/amalgamate ## writes build/sparse_local_flat.h: the header without self-inclusion, for pasting
	build/amalgamate --flat src/sparse_local.in.h build/sparse_local_flat.h LICENSE

size: sparse_local.h build/deps.ok ## size of the header and of its object, compile time; fails above the limits
	@tools/build/size.sh

check-header: build/amalgamate ## is sparse_local.h what src/ makes?
	@build/amalgamate --check src/sparse_local.in.h sparse_local.h LICENSE
	@echo 'check-header: sparse_local.h is what src/ makes'

build/amalgamate: $(wildcard tools/build/*.[ch])
	@mkdir -p $(@D)
	$(call say,CC  )
	$(Q)cc -std=c99 -O2 $(WARN) -o $@ $(filter %.c,$^)

layers: ## do all includes go downward, and do the names of src/ have their prefixes?
	@awk -f tools/build/layers.awk $(SRC) $(wildcard tools/*/*.[ch] tests/*/*.[ch] bench/*/*.[ch] bench/*/*.cpp)

map: ## what is in each file of src, tests, tools and bench, by its first comment
	@tools/build/map.sh

style: ## are all lines short enough, and is the wording of the public headers plain?
	@tools/build/check_style.sh

parts: $(patsubst src/%,build/parts/%.ok,$(filter-out %.inl.h,$(PARTS))) ## does every part compile alone?
	@echo 'parts: each of $(words $^) compiles alone'

# Parts above analysis call packs through a table, which is the last part.
PARTS_BELOW = public/% impl/base/% impl/kernels/% impl/matrix/% impl/ordering/% impl/analysis/%
build/parts/%.ok: src/% $(SRC) | build/deps.ok
	@mkdir -p $(@D)
	@printf '#include "$*"\n$(if $(filter $(PARTS_BELOW),$*),,#include "impl/packs/storage_types.h"\n)typedef int sl_this_part_alone;\n' | \
	$(CC) $(C_FLAGS) -Isrc -Wno-unused-function -Wno-unused-variable -fsyntax-only -x c -
	@touch $@

check-promises: sparse_local.h build/deps.ok ## does the header hold each of its promises (C++, two users, SL_STATIC, ...)?
	@CC='$(CC)' CXX='$(CXX)' PROMISES=all tests/core/check_header.sh

# ---- what others must give; Debian packages, installed where missing ----

DEPS = metis.h=libmetis-dev cmocka.h=libcmocka-dev zlib.h=zlib1g-dev cjson/cJSON.h=libcjson-dev
deps: build/deps.ok ## METIS, cmocka, zlib, cJSON
	@tools/build/deps.sh $(DEPS)

build/deps.ok: tools/build/deps.sh
	@mkdir -p $(@D)
	@tools/build/deps.sh $(DEPS)
	@touch $@

deps-png: build/deps-png.ok ## libpng: the pictures of sparse-local
build/deps-png.ok: tools/build/deps.sh
	@mkdir -p $(@D)
	@tools/build/deps.sh png.h=libpng-dev
	@touch $@

deps-cxx: ## g++
	@tools/build/deps.sh $(CXX)=g++

deps-peers: deps-cxx ## CHOLMOD with OpenBLAS, LDL, AMD, Eigen
	@tools/build/deps.sh suitesparse/cholmod.h=libsuitesparse-dev /usr/include/eigen3/Eigen/Sparse=libeigen3-dev \
	/usr/share/doc/libopenblas-dev=libopenblas-dev

deps-arpack: ## ARPACK with OpenBLAS
	@tools/build/deps.sh arpack/arpack.h=libarpack2-dev /usr/share/doc/libopenblas-dev=libopenblas-dev

deps-clang: ## clang with its sanitizers and fuzzer
	@tools/build/deps.sh clang=clang '/usr/lib/llvm-*/lib/clang/*/lib/linux/libclang_rt.fuzzer-*.a=libclang-rt-dev'

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

# ---- compiling ----

# Holds what objects are compiled with, so that they are made anew when that changes.
$(B)/flags: always
	@mkdir -p $(@D)
	@echo '$(CC) $(C_FLAGS) | $(CXX) $(CXX_FLAGS) | $(IMPL_COMPILE)' | cmp -s - $@ || \
	echo '$(CC) $(C_FLAGS) | $(CXX) $(CXX_FLAGS) | $(IMPL_COMPILE)' >$@
always:

$(B)/obj/%.o: %.c $(B)/flags | build/deps.ok sparse_local.h
	@mkdir -p $(@D)
	$(call say,CC  )
	$(Q)$(CC) $(C_FLAGS) $(DEPEND) -c -o $@ $<

$(B)/obj/%.o: %.cpp $(B)/flags | build/deps.ok sparse_local.h
	@mkdir -p $(@D)
	$(call say,CXX )
	$(Q)$(CXX) $(CXX_FLAGS) $(DEPEND) -c -o $@ $<

$(B)/obj/sparse_local.c:
	@mkdir -p $(@D)
	@printf '/* sparse_local.c: the bodies */\n#define SPARSE_LOCAL_IMPLEMENTATION\n#include "sparse_local.h"\n' >$@

$(IMPL) $(SMALL_TASKS): $(B)/obj/sparse_local.c sparse_local.h $(B)/flags | build/deps.ok
	$(call say,CC  )
	$(Q)$(IMPL_COMPILE) $(if $(filter $(SMALL_TASKS),$@),-DSLI_SMALL_TASKS=1) -c -o $@ $<

$(LIBRARY): $(call object,$(TOOLS:.c=) $(PAGE:.c=))
	@rm -f $@
	$(call say,AR  )
	$(Q)$(AR) rcs $@ $^

# The program over the header; main.c finds the commands, which stand in the library.
$(call object,$(NEED_PNG:.c=)): | build/deps-png.ok
$(B)/sparse-local: $(call object,$(MAIN:.c=) $(NEED_PNG:.c=)) $(LIBRARY) $(IMPL)
	$(call say,LINK)
	$(Q)$(LINK) -o $@ $^ $(LIBS) -lpng

# The page of the command view, as an array of its lines.
$(PAGE): tools/draw/view_page.html
	@mkdir -p $(@D)
	$(call say,MAKE)
	$(Q){ printf '/* the lines of view_page.html */\n#include "tools/draw/view_page.h"\n'; \
	printf 'const char *const view_page_text[] = {\n'; \
	sed 's/[\\"]/\\&/g; s/.*/    "&",/' $<; printf '    NULL,\n};\n'; } >$@

programs: $(B)/sparse-local ## build/sparse-local: the paper's experiments on meshes

-include $(shell find $(B)/obj -name '*.d' 2>/dev/null)

# ---- tests ----

# Compiling the tests takes longer than running them.
$(B)/obj/tests/%.o: OPT := $(OPT:-O2=-O1)

$(B)/tests/%: $(B)/obj/tests/%.o $(LIBRARY) $(IMPL)
	@mkdir -p $(@D)
	$(call say,LINK)
	$(Q)$(LINK) -o $@ $(if $(filter tests/$*.c,$(OWN_BODIES)),$(filter-out $(IMPL),$^),$^) $(TEST_LIBS) $(LIBS)

$(SMALL_TASK_TESTS:%.c=$(B)/%): $(SMALL_TASKS)

$(B)/tests/replay_%: $(B)/obj/tests/fuzz/fuzz_%.o $(B)/obj/tests/fuzz/replay.o $(LIBRARY) $(IMPL)
	@mkdir -p $(@D)
	$(call say,LINK)
	$(Q)$(LINK) -o $@ $^ $(LIBS)

# What the variants below share: they differ in B, compiler and flags. PROGRAM is sparse-local, where a script tests it.
PROGRAM =
build-tests: $(TEST_PROGRAMS) $(REPLAYS) $(PROGRAM)
run-tests: build-tests
	@RUN='$(RUN)' CC='$(CC)' CXX='$(CXX)' PROGRAM='$(PROGRAM)' tests/lib/run.sh $(B)/log $(ALSO) $(TEST_PROGRAMS) $(REPLAYS)

PROGRAM_CHECKS = tests/tools/check_program.sh tests/tools/check_output.sh tests/tools/check_hostile.sh

test: deps deps-png ## builds and runs every test on the generated header; ends in a line `N passed, N failed`
	@+$(SUB_MAKE) run-tests ALSO='tests/core/check_header.sh $(PROGRAM_CHECKS)' PROGRAM=$(B)/sparse-local

judge: deps $(B)/tests/core/test_judge ## JUDGE_COUNT random systems from JUDGE_SEED on: wrong answers with SL_OK and without a signal
	@JUDGE_COUNT=$(JUDGE_COUNT) JUDGE_SEED=$(JUDGE_SEED) $(B)/tests/core/test_judge

test-figures: ## counts of tests and fuzzed inputs, as in tests/README.md
	@echo '$(words $(CORE_TESTS)) programs of $(shell cat $(CORE_TESTS) | grep -c 'cmocka_unit_test') core tests'
	@echo '$(words $(TOOL_TESTS)) programs of $(shell cat $(TOOL_TESTS) | grep -c 'cmocka_unit_test') tests of tools'
	@for f in tests/fuzz/corpus/*; do echo "corpus $${f##*/}: $$(ls $$f | wc -l) inputs, $$(cat $$f/* | wc -c) bytes"; done

# What else the page reports is read from the logs of the targets that have run in this checkout.
test-page: ## writes the figures between the marks in tests/README.md
	@tools/build/test_page.sh

test-clang: deps deps-clang sparse_local.h ## the tests, built by clang
	@+$(SUB_MAKE) run-tests B=build/clang CC=clang

test-cxx: deps deps-cxx sparse_local.h ## the header's tests, over bodies compiled as C++11
	@+$(SUB_MAKE) run-tests B=build/cxx TEST_PROGRAMS='$(CORE_TESTS:tests/%.c=build/cxx/tests/%)' LINK='$(CXX) $(OPT)' IMPL_COMPILE='$(CXX) -x c++ $(CXX_FLAGS)'

test-no-metis: deps sparse_local.h ## the header's tests, built without SL_METIS and not linked with METIS
	@+$(SUB_MAKE) run-tests B=build/no_metis TEST_PROGRAMS='$(CORE_TESTS:tests/%.c=build/no_metis/tests/%)' METIS= LIBS='$(FILE_LIBS) -lm'

# those of the kernels, and those of ways that are chosen by what kernels cost
NO_SIMD = test_solve test_plan test_interleaved test_supernodal test_selected test_pins_refused test_pins_trust test_pins_ways \
	test_change_choice test_change_ways

test-no-simd: deps sparse_local.h ## tests of kernels and of choices by their costs, built with -DSL_NO_SIMD
	@+$(SUB_MAKE) run-tests B=build/no_simd CFLAGS='-DSL_NO_SIMD $(CFLAGS)' REPLAYS= \
	TEST_PROGRAMS='$(NO_SIMD:%=build/no_simd/tests/core/%)'

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
PLATFORM_TESTS = $(patsubst %,tests/core/test_%.c,order_hashes factor identity csc_write matrix_market matrix_market_file refine \
	restrict storage storage_use save save_use save_file save_lies save_damage saved_set saved_set_damage) \
	tests/tools/test_mesh_ply.c
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

# The program over the objects of test-s390x, and natively.
test-exchange: test-s390x ## saved objects written on big endian, emulated, loaded on this machine, and the other way round
	@$(MAKE) --no-print-directory $(B)/tests/core/exchange
	@$(cross_s390x)gcc -std=c99 $(WARN) -O1 -I. -static -o build/s390x/exchange tests/core/exchange.c build/s390x/obj/sparse_local.o -lm
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

platform-table: ## prints the results of the platform targets as a Markdown table, as in the README
	@printf '| platform | compiler | run | passed | failed | skipped |\n|---|---|---|---|---|---|\n'
	@cat build/platforms/*.txt

# With SL_VERIFY tasks are small in any case.
sanitize: deps deps-png sparse_local.h ## the tests with address and undefined-behavior sanitizers, and SL_VERIFY
	@+$(SUB_MAKE) run-tests B=build/sanitize SMALL_TASK_TESTS= OPT='-O1 -g -fno-var-tracking -fno-omit-frame-pointer -DSL_VERIFY \
	-fsanitize=address,undefined -fno-sanitize-recover=all' ALSO='$(PROGRAM_CHECKS)' PROGRAM=build/sanitize/sparse-local

THREADED = test_threads test_threads_solve test_ordering_threads test_batch test_batch_factor test_batch_inverse test_inverse_threads test_change_threads

races: deps sparse_local.h ## the tests of threads, watched for data races
	@+$(SUB_MAKE) run-tests B=build/races OPT='-O1 -g -fno-var-tracking -fsanitize=thread' REPLAYS= \
	TEST_PROGRAMS='$(THREADED:%=build/races/tests/core/%)'

test-openmp: deps sparse_local.h ## the tests of threads, with OpenMP compiled in
	@+$(SUB_MAKE) run-tests B=build/openmp OPT='-O2 -fopenmp' REPLAYS= \
	TEST_PROGRAMS='$(THREADED:%=build/openmp/tests/core/%)'

valgrind: deps ## the tests under valgrind (no AVX-512 there)
	@tools/build/deps.sh valgrind=valgrind
	@+$(SUB_MAKE) run-tests RUN='valgrind -q --leak-check=full --error-exitcode=99'

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

# Counters are atomic because threads run too. The tests run without DATA, so that the figures are those
# of any checkout. The limits are what the tests reach; they only rise. Both are meant to be 100.
COV_LINES = 100
COV_BRANCHES = 99.9
GCOVR = gcovr --root . --exclude-throw-branches --exclude-unreachable-branches --exclude-branches-by-pattern '.*SLI_ASSERT\(.*' \
	--exclude-lines-by-pattern '.*(untested: |SLI_ASSERT\().*' --print-summary

cov: deps deps-cov deps-png sparse_local.h ## line and branch coverage of the header and of tools by the tests, with limits; build/cov/index.html
	@if [ -d build/cov ]; then find build/cov -name '*.gcda' -delete; fi
	@+$(SUB_MAKE) run-tests B=build/cov SL_DATA= PROGRAM=build/cov/sparse-local \
	ALSO='$(PROGRAM_CHECKS)' OPT='-O0 -g --coverage -fprofile-update=atomic -DTEST_ALL_KERNELS'; status=$$?; \
	echo 'tools/'; $(GCOVR) --filter 'tools/' --html build/cov/tools.html build/cov/obj 2>build/cov/gcovr.log || cat build/cov/gcovr.log; \
	echo 'sparse_local.h'; $(GCOVR) --filter 'sparse_local\.h' --html-details build/cov/index.html \
	--fail-under-line $(COV_LINES) --fail-under-branch $(COV_BRANCHES) build/cov/obj 2>>build/cov/gcovr.log >build/cov/summary.txt; found=$$?; cat build/cov/summary.txt; [ $$found -eq 0 ] || { tail -n 5 build/cov/gcovr.log; exit 1; }; exit $$status

# Each condition has to decide its decision alone. Conditions of one variable, as in a == 1 || a == 2, never do, so that
# there is no limit. clang counts them from version 18 on.
MCDC = 19
MCDC_TESTS = $(sort $(filter-out $(OWN_BODIES),$(wildcard $(patsubst %,tests/core/test_%*.c,arguments options csc matrix save forged) tests/core/test_*_use.c tests/core/test_*_wrong.c)))

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
# the calls themselves. The dictionaries know the words that the traces would find.
run-fuzz: $(FUZZERS:tests/fuzz/fuzz_%.c=$(B)/run/%)
	@for program in $^; do name=$${program##*/}; words=tests/fuzz/$$name.dict; \
	mkdir -p $(B)/found/$$name tests/fuzz/corpus/$$name; \
	ASAN_OPTIONS=malloc_context_size=4:quarantine_size_mb=1:max_malloc_fill_size=0 $$program -max_total_time=$(FUZZ_SECONDS) -seed=$(FUZZ_SEED) -max_len=2048 -entropic=0 -print_funcs=0 -reduce_inputs=0 -print_final_stats=1 \
	$$([ ! -e $$words ] || echo -dict=$$words) -artifact_prefix=$(B)/found/crash-$$name- \
	$(B)/found/$$name tests/fuzz/corpus/$$name >$(B)/$$name.log 2>&1 || { tail -n 60 $(B)/$$name.log; exit 1; }; \
	awk -v name=$$name '/number_of_executed_units/ { runs = $$2 } /average_exec_per_sec/ { rate = $$2 } \
	END { printf "fuzz %s: %d executions, %d a second\n", name, runs, rate }' $(B)/$$name.log; done

# ---- bench ----

$(B)/bench: $(call object,$(BENCH_SOURCES:.c=)) $(PEER_OBJECTS) $(LIBRARY) $(IMPL)
	$(call say,LINK)
	$(Q)$(LINK) $(OPENMP) -o $@ $^ $(PEER_LIBS) $(LIBS) -lpthread

run-bench: $(B)/bench
	@mkdir -p build/bench-out
	$(BENCH_ENV) $(B)/bench $(or $(QUESTION),$(QUESTION_DEFAULT))

bench: deps sparse_local.h ## times factorizations, full and local solves on this machine; CSV files and plots in build/bench-out
	@+$(SUB_MAKE) run-bench B=build/timed CFLAGS='$(OPENMP) $(CFLAGS)'

# Peers in their best setting: OpenBLAS chooses its kernels itself, whatever core the environment names.
PEER_ENV = env -u OPENBLAS_CORETYPE -u OPENBLAS_L2_SIZE
# Eigen chooses its vector instructions at compile time: its best setting is -march=native, for its own file only.
bench-peers: deps deps-peers sparse_local.h ## the questions peers, peers_harmonic, peers_shifted, peers_complex, peers_kkt and peers_kinds: against CHOLMOD, Eigen and LDL
	@+$(SUB_MAKE) run-bench B=build/peers QUESTION_DEFAULT="peers peers_harmonic peers_shifted peers_complex peers_kkt peers_kinds" LINK=$(CXX) BENCH_ENV='$(PEER_ENV)' \
	CFLAGS='-DSL_BENCH_PEERS $(OPENMP) $(CFLAGS)' INCLUDES='-isystem /usr/include/suitesparse -isystem /usr/include/eigen3' \
	CXXFLAGS='-DSL_BENCH_PEERS -O3 -march=native $(CXXFLAGS)' PEER_LIBS='-lcholmod -lldl -lamd -lopenblas' \
	PEER_OBJECTS='$(addprefix build/peers/obj/,$(addsuffix .o,$(basename $(PEERS))))'

ARPACK_OBJECTS = $(patsubst %.c,build/arpack/obj/%.o,$(wildcard bench/eigen/*.c))
ARPACK_BENCH = B=build/arpack BENCH_ENV='$(PEER_ENV) OPENBLAS_NUM_THREADS=1' CFLAGS='-DSL_BENCH_ARPACK $(OPENMP) $(CFLAGS)' \
	PEER_LIBS='-larpack -lopenblas' PEER_OBJECTS='$(ARPACK_OBJECTS)'
bench-eigenpairs: deps deps-arpack sparse_local.h ## auto-diffusion by the eigenpairs of ARPACK, with our factor as its solver: digits and time
	@+$(SUB_MAKE) run-bench QUESTION_DEFAULT=eigenpairs $(ARPACK_BENCH)

readme-table: ## prints the measurements of the last bench-peers as Markdown tables
	@awk -f tools/build/csv.awk -f tools/build/readme_table.awk build/bench-out/peers.machine.txt build/bench-out/peers.csv \
	$(wildcard build/bench-out/peers_harmonic.csv build/bench-out/peers_kinds.csv)

# ---- clusters ----

deps-chromium: ## the browser that test-view runs
	@tools/build/deps.sh chromium=chromium

test-view: deps-chromium deps-png ## the page of sparse-local view in a headless browser: it draws, turns and answers a click
	@+$(SUB_MAKE) run-tests TEST_PROGRAMS= REPLAYS= ALSO=tests/tools/check_view.sh PROGRAM=$(B)/sparse-local

# Where Debian has two implementations, mpicc may be that of the one without headers.
MPICC ?= $(if $(wildcard /etc/debian_version),mpicc.mpich,mpicc)
export MPIEXEC ?= $(patsubst mpicc%,mpiexec%,$(MPICC))

deps-mpi: ## an implementation of MPI
	@tools/build/deps.sh $(MPICC)=libmpich-dev mpiexec=mpich

$(B)/cluster-mpi: tools/cluster/cluster_mpi.c $(call object,$(NEED_PNG:.c=)) $(LIBRARY) $(IMPL) $(B)/flags
	$(call say,MPI )
	$(Q)$(MPICC) $(C_FLAGS) -o $@ $(filter-out $(B)/flags,$^) $(LIBS) -lpng

cluster: deps-mpi deps-png ## build/cluster-mpi: many queries on one saved factor by the ranks of an MPI job
	@$(MAKE) --no-print-directory $(B)/cluster-mpi

test-cluster: deps-mpi deps-png ## build/cluster-mpi with 1 to 4 ranks, one of them killed
	@+$(SUB_MAKE) run-tests TEST_PROGRAMS= REPLAYS= ALSO=tests/tools/check_cluster.sh PROGRAM='$(B)/cluster-mpi $(B)/sparse-local'

# ---- the paper ----

FIGURES = build/figures$(if $(MESH),/$(firstword $(subst ., ,$(notdir $(MESH)))))
# The bench is that of bench-eigenpairs, the program that of the tests.
figures: deps deps-png deps-arpack sparse_local.h $(B)/sparse-local ## the paper's figures into build/figures, of made-up surfaces or of MESH (two minutes; BENCH=quick less)
	@$(MAKE) --no-print-directory build/arpack/bench $(ARPACK_BENCH)
	@tools/build/figures.sh $(B)/sparse-local build/arpack/bench '$(FIGURES)' '$(MESH)'

# ---- other languages and build systems ----

include tools/packaging/packaging.mk
include tools/docs/docs.mk

# ---- the rest ----

format: ## clang-format over all sources, in place
	clang-format -i $(SRC) $(wildcard tests/*/*.[ch] bench/*/*.[ch] bench/*/*.cpp tools/*/*.[ch])

tidy: sparse_local.h ## clang-tidy over the bodies and the tools
	@printf '#define SPARSE_LOCAL_IMPLEMENTATION\n#include "sparse_local.in.h"\n' >build/tidy.c
	$(Q)clang-tidy --quiet --checks='bugprone-*,-bugprone-easily-swappable-parameters,-bugprone-narrowing-conversions,-bugprone-reserved-identifier,clang-analyzer-*,-clang-analyzer-security*,-clang-analyzer-valist*' \
	build/tidy.c $(TOOLS) -- -std=c99 -I. -Isrc

clean: ## removes everything built
	rm -rf build

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
## B        folder of objects, test programs and the bench; what is the same for all of them stays in build
B ?= build
## HOME_URL where this is published, if it is; make header writes it to the header and the files of packages
HOME_URL ?=
AMALGAMATE = build/amalgamate $(if $(HOME_URL),--home '$(HOME_URL)')
## PACKS    what `make header` selects: "core", "core change save", ...; nothing: everything, in sparse_local.h
PACKS ?=
## V        1 shows every command
V ?=

Q := $(if $(V),,@)
# What is made, with a count; also of how many, if the tests are built in a new folder.
say = $(eval SAID += x)@echo '  $(1)  [$(words $(SAID))$(EXPECTED)] $@'
EXPECTED := $(if $(filter run-tests,$(MAKECMDGOALS)),$(if $(wildcard $(B)/obj),, of about $(words $(wildcard tests/*/*.c tests/*/*.c tools/*/*.c) sparse_local.o)))
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

PARTS := $(wildcard src/public/*.h src/impl/*/*.h src/impl/*/*/*.h)
SRC := src/sparse_local.in.h $(PARTS)
MAIN := tools/cli/main.c
NEED_PNG := tools/draw/png_write.c
TOOLS := $(filter-out $(MAIN) $(NEED_PNG) tools/adapters/% tools/build/% tools/packaging/% tools/examples/% tools/web/% tools/octave/%,$(wildcard tools/*/*.c))
CORE_TESTS := $(wildcard tests/core/test_*.c)
TOOL_TESTS := $(wildcard tests/tools/test_*.c)
TESTS := $(CORE_TESTS) $(TOOL_TESTS)
FUZZERS := $(wildcard tests/fuzz/fuzz_*.c)
SMALL_TASK_TESTS := $(patsubst %,tests/core/test_%.c,threads threads_solve inverse_threads reserve_inverse batch change_threads)
# Tests that compile the bodies with their own faults, or are linked with small tasks.
OWN_BODIES := $(shell grep -l 'define SPARSE_LOCAL_IMPLEMENTATION' $(TESTS) /dev/null) $(SMALL_TASK_TESTS)
BENCH_SOURCES := $(wildcard bench/lib/*.c bench/questions/*.c)

object = $(addprefix $(B)/obj/,$(addsuffix .o,$(1)))
IMPL = $(B)/obj/sparse_local.o
# The bodies again, where small systems are divided among workers, too.
SMALL_TASKS = $(B)/obj/small_tasks.o
LIBRARY = $(B)/libtools.a
PAGE := build/view_page_text.c build/view_live_text.c
TEST_PROGRAMS = $(TESTS:tests/%.c=$(B)/tests/%)
REPLAYS = $(FUZZERS:tests/fuzz/fuzz_%.c=$(B)/tests/replay_%)

.DELETE_ON_ERROR:
.SECONDARY:
.PHONY: all help header check-header layers map style parts check-promises deps deps-png deps-cxx deps-clang always programs \
	build-tests run-tests test quick test-clang test-cxx test-no-metis test-no-simd test-no-singular test-openmp test-pthreads sanitize run-bench bench format tidy clean

all: check-header layers style parts test programs ## the checks, the tests, and the programs of tools/

# The files with targets, the newcomer's first. The first line of each is the heading of its targets.
MAKE_FILES = Makefile tools/docs/docs.mk tests/packs.mk tests/platforms.mk bench/peers.mk bench/last.mk bench/world.mk tools/release.mk tools/packaging/packaging.mk tools/web/web.mk

.DEFAULT_GOAL = help
# head may close the pipe.
help: ## this list
	@trap '' PIPE; { awk -F ':.*## ' 'FNR == 1 { sub(/^# [^:]*: /, ""); sub(/;.*| [(]a part.*/, ""); print (NR == 1 ? "" : "\n") FILENAME ": " $$0 } \
	/^[a-z-]+[a-z0-9-]*:.*## / { printf "  %-17s %s\n", $$1, $$2 }' $(MAKE_FILES); \
	printf '\nVariables (make test CC=clang)\n'; sed -n 's/^## /  /p' $(MAKE_FILES); } 2>/dev/null || true

# ---- the header ----

header: build/amalgamate ## makes sparse_local.h from src/; with PACKS a header of the core and these packs, in build
	@tools/packaging/home.sh '$(HOME_URL)' $(FULL_VERSION)
	$(AMALGAMATE) $(if $(strip $(PACKS)),$(SELECTION),src/sparse_local.in.h sparse_local.h) LICENSE

sparse_local.h: build/amalgamate $(SRC) LICENSE
	$(call say,MAKE)
	$(Q)$(AMALGAMATE) src/sparse_local.in.h $@ LICENSE
	@touch $@

check-header: build/amalgamate ## is sparse_local.h what src/ makes?
	@$(AMALGAMATE) --check src/sparse_local.in.h sparse_local.h LICENSE
	@tools/packaging/home.sh --check '$(HOME_URL)' $(FULL_VERSION)
	@echo 'check-header: sparse_local.h is what src/ makes'

build/amalgamate: $(wildcard tools/build/*.[ch])
	@mkdir -p $(@D)
	$(call say,CC  )
	$(Q)cc -std=c99 -O2 $(WARN) -o $@ $(filter %.c,$^)

layers: ## do all includes go downward, and do the names of src/ have their prefixes?
	@awk -f tools/build/layers.awk $(SRC) $(wildcard tools/*/*.[ch] tests/*/*.[ch] bench/*/*.[ch] bench/*/*.cpp)

map: ## what is in each file of src, tests, tools and bench, by its first comment
	@tools/build/map.sh

style: ## are all lines short enough, is the wording of the public headers plain, has every error a reason, and is advice tested?
	@tools/build/check_style.sh
	@awk -f tools/build/errors.awk $(filter src/impl/%,$(PARTS))
	@awk -f tools/build/advice.awk $(wildcard tests/core/test_advice*.c) $(filter src/impl/%,$(PARTS))

parts: $(patsubst src/%,build/parts/%.ok,$(filter-out %.inl.h %.list.h,$(PARTS))) ## does every part compile alone?
	@echo 'parts: each of $(words $^) compiles alone'

# Parts above analysis call packs through a table, which is the last part.
PARTS_BELOW = public/% impl/base/% impl/kernels/% impl/matrix/% impl/ordering/% impl/analysis/%
build/parts/%.ok: src/% $(SRC) | build/deps.ok
	@mkdir -p $(@D)
	@printf '#include "$*"\n$(if $(filter $(PARTS_BELOW),$*),,#include "impl/packs/storage_types.h"\n#include "impl/packs/singular_table.h"\n)typedef int sl_this_part_alone;\n' | \
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

deps-clang: ## clang with its sanitizers and fuzzer
	@tools/build/deps.sh clang=clang '/usr/lib/llvm-*/lib/clang/*/lib/linux/libclang_rt.fuzzer-*.a=libclang-rt-dev'

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
in_quotes = sed 's/[\\"?]/\\&/g; s/.*/    "&",/' $(1)
build/view_page_text.c: tools/draw/view_page.html
	@mkdir -p $(@D)
	$(call say,MAKE)
	$(Q){ printf '/* the lines of view_page.html */\n#include "tools/draw/view_page.h"\n'; \
	printf 'const char *const view_page_text[] = {\n'; \
	$(call in_quotes,$<); printf '    NULL,\n};\n'; } >$@

# The script of live pages, and the WebAssembly that it runs if make live or make npm has built it.
LIVE_KERNEL := $(wildcard build/web/sparse_local.wasm)
build/live_kernel.txt: always
	@mkdir -p $(@D)
	@echo '$(LIVE_KERNEL)' | cmp -s - $@ || echo '$(LIVE_KERNEL)' >$@

build/view_live_text.c: tools/web/sparse_local.js tools/draw/view_live.js build/live_kernel.txt $(LIVE_KERNEL)
	@mkdir -p $(@D)
	$(call say,MAKE)
	$(Q){ printf '/* the lines of sparse_local.js and view_live.js, and sparse_local.wasm in base64 */\n#include "tools/draw/view_page.h"\n'; \
	printf 'const char *const view_live_script[] = {\n'; \
	$(call in_quotes,tools/web/sparse_local.js tools/draw/view_live.js); printf '    NULL,\n};\nconst char *const view_live_kernel[] = {\n'; \
	$(if $(LIVE_KERNEL),base64 -w 3000 $(LIVE_KERNEL) | $(call in_quotes);) printf '    NULL,\n};\n'; } >$@

programs: $(B)/sparse-local ## build/sparse-local: the paper's experiments on meshes

-include $(shell find $(B)/obj -name '*.d' 2>/dev/null)

# ---- tests ----

# Compiling the tests takes longer than running them.
$(B)/obj/tests/%.o: private OPT := $(OPT:-O2=-O1)

$(B)/tests/%: $(B)/obj/tests/%.o $(LIBRARY) $(IMPL)
	@mkdir -p $(@D)
	$(call say,LINK)
	$(Q)$(LINK) -o $@ $(if $(filter tests/$*.c,$(OWN_BODIES)),$(filter-out $(IMPL),$^),$^) $(TEST_LIBS) $(LIBS)

$(SMALL_TASK_TESTS:%.c=$(B)/%): $(SMALL_TASKS)

$(B)/tests/replay_%: $(B)/obj/tests/fuzz/fuzz_%.o $(B)/obj/tests/fuzz/replay.o $(LIBRARY) $(IMPL)
	@mkdir -p $(@D)
	$(call say,LINK)
	$(Q)$(LINK) -o $@ $^ $(LIBS)

# Of the tools the tests of a fixed list need the list of a folder's files at most. FEW=yes says that CORE_TESTS is such a list.
FEW_TOOLS = TOOLS=tools/io/dataset.c PAGE= REPLAYS=
WITH_TOOLS = $(if $(FEW),$(FEW_TOOLS) TOOL_TESTS=)

# What the variants below share: they differ in B, compiler and flags. PROGRAM is sparse-local, where a script tests it.
PROGRAM =
build-tests: $(TEST_PROGRAMS) $(REPLAYS) $(PROGRAM)
run-tests: build-tests
	@RUN='$(RUN)' CC='$(CC)' CXX='$(CXX)' PROGRAM='$(PROGRAM)' tests/lib/run.sh $(B)/log $(ALSO) $(TEST_PROGRAMS) $(REPLAYS)

PROGRAM_CHECKS = tests/tools/check_program.sh tests/tools/check_output.sh tests/tools/check_hostile.sh

test: deps deps-png ## builds and runs every test on the generated header; ends in a line `N passed, N failed`
	@+$(SUB_MAKE) run-tests ALSO='tests/core/check_header.sh tests/tools/check_evidence.sh $(PROGRAM_CHECKS)' PROGRAM=$(B)/sparse-local

# The core, a test of each kind of call, and what most changes break first.
QUICK = arguments csc factor ordering solve symbolic null_pivots errors options out_of_memory inverse_diagonal change_use constraints_use \
	submatrix_use fixed save_use batch complex_use refine_local matrix_market pivots_rare
quick: deps sparse_local.h ## what to run after each edit: the header without SIMD, and tests of each pack
	@+$(SUB_MAKE) run-tests B=build/quick OPT='-O0 -DSL_NO_SIMD' $(FEW_TOOLS) TEST_PROGRAMS='$(QUICK:%=build/quick/tests/core/test_%)'

test-clang: deps deps-clang sparse_local.h ## the tests, built by clang
	@+$(SUB_MAKE) run-tests B=build/clang CC=clang $(WITH_TOOLS)

test-cxx: deps deps-cxx sparse_local.h ## the header's tests, over bodies compiled as C++11
	@+$(SUB_MAKE) run-tests B=build/cxx TEST_PROGRAMS='$(CORE_TESTS:tests/%.c=build/cxx/tests/%)' LINK='$(CXX) $(OPT)' IMPL_COMPILE='$(CXX) -x c++ $(CXX_FLAGS)'

test-no-metis: deps sparse_local.h ## the header's tests, built without SL_METIS and not linked with METIS
	@+$(SUB_MAKE) run-tests B=build/no_metis $(WITH_TOOLS) TEST_PROGRAMS='$(CORE_TESTS:tests/%.c=build/no_metis/tests/%)' METIS= LIBS='$(FILE_LIBS) -lm'

# those of the kernels, and those of ways that are chosen by what kernels cost
NO_SIMD = test_solve test_plan test_interleaved test_supernodal test_selected test_constraints_refused test_constraints_trust test_constraints_sets \
	test_change_choice test_change_ways

test-no-simd: deps sparse_local.h ## tests of kernels and of choices by their costs, built with -DSL_NO_SIMD
	@+$(SUB_MAKE) run-tests B=build/no_simd CFLAGS='-DSL_NO_SIMD $(CFLAGS)' $(FEW_TOOLS) \
	TEST_PROGRAMS='$(NO_SIMD:%=build/no_simd/tests/core/%)'

# those of regular systems
NO_SINGULAR = test_no_singular test_factor_overflow test_solve test_plan test_supernodal test_small test_growth test_null_judge \
	test_result_hashes test_threads test_change_several test_constraints_use test_submatrix test_inverse_use test_region_use \
	test_selected_use test_complex_use test_parts_use test_refine_local test_advice_calls

test-no-singular: deps sparse_local.h ## tests of regular systems, built with -DSL_NO_SINGULAR
	@+$(SUB_MAKE) run-tests B=build/no_singular CFLAGS='-DSL_NO_SINGULAR $(CFLAGS)' $(FEW_TOOLS) \
	TEST_PROGRAMS='$(NO_SINGULAR:%=build/no_singular/tests/core/%)'

THREADED = test_threads test_threads_least test_threads_solve test_ordering_threads test_batch test_batch_factor test_inverse_threads test_change_threads

test-openmp: deps sparse_local.h ## the tests of threads, with OpenMP compiled in
	@+$(SUB_MAKE) run-tests B=build/openmp OPT='-O2 -fopenmp' $(FEW_TOOLS) \
	TEST_PROGRAMS='$(THREADED:%=build/openmp/tests/core/%)'

test-pthreads: deps sparse_local.h ## the tests of threads, with SL_PTHREADS compiled in
	@+$(SUB_MAKE) run-tests B=build/pthreads OPT='-O2 -pthread -DSL_PTHREADS' $(FEW_TOOLS) \
	TEST_PROGRAMS='$(THREADED:%=build/pthreads/tests/core/%)'

# With SL_VERIFY tasks are small in any case.
sanitize: deps deps-png sparse_local.h ## the tests with address and undefined-behavior sanitizers, and SL_VERIFY
	@+$(SUB_MAKE) run-tests B=build/sanitize SMALL_TASK_TESTS= OPT='-O1 -g -fno-var-tracking -fno-omit-frame-pointer -DSL_VERIFY \
	-fsanitize=address,undefined -fno-sanitize-recover=all' ALSO='$(PROGRAM_CHECKS)' PROGRAM=build/sanitize/sparse-local

# ---- bench ----

# Without the program's commands and, but for plots, its pictures. The header takes longest and is first.
BENCH_TOOLS = $(filter-out tools/cli/% tools/draw/%,$(TOOLS)) tools/draw/plot.c tools/draw/colors.c
$(B)/bench: $(IMPL) $(call object,$(BENCH_SOURCES:.c=) $(BENCH_TOOLS:.c=)) $(PEER_OBJECTS)
	$(call say,LINK)
	$(Q)$(LINK) $(OPENMP) -o $@ $^ $(PEER_LIBS) $(LIBS) -lpthread

# What the files of the bench name as the state that was measured.
MEASURED = BENCH_COMMIT=$$(git rev-parse --short HEAD 2>/dev/null)$$(git status --porcelain sparse_local.h bench 2>/dev/null | sed 's/.*/-changed/; q')
run-bench: $(B)/bench
	@mkdir -p build/bench-out
	$(Q)$(MEASURED) $(BENCH_ENV) $(ALONE) $(B)/bench $(or $(QUESTION),$(QUESTION_DEFAULT))

bench: deps sparse_local.h ## times factorizations, full and local solves on this machine; CSV files and plots in build/bench-out
	@+$(SUB_MAKE) run-bench B=build/timed CFLAGS='$(OPENMP) $(CFLAGS)'

# ---- the rest ----

format: ## clang-format over all sources, in place
	clang-format -i $(SRC) $(wildcard tests/*/*.[ch] bench/*/*.[ch] bench/*/*.cpp tools/*/*.[ch])

tidy: sparse_local.h ## clang-tidy over the bodies and the tools
	@printf '#define SPARSE_LOCAL_IMPLEMENTATION\n#include "sparse_local.in.h"\n' >build/tidy.c
	$(Q)clang-tidy --quiet --checks='bugprone-*,-bugprone-easily-swappable-parameters,-bugprone-narrowing-conversions,-bugprone-reserved-identifier,clang-analyzer-*,-clang-analyzer-security*,-clang-analyzer-valist*' \
	build/tidy.c $(TOOLS) -- -std=c99 -I. -Isrc

clean: ## removes everything built
	rm -rf build

include tests/platforms.mk
include tests/packs.mk
include bench/peers.mk
include bench/last.mk
include bench/world.mk
include tools/release.mk

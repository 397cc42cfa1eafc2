# packs.mk: headers of chosen packs, and their checks and tests (a part of the Makefile)

# ---- make header PACKS="core change" ----

# The core is in any header. Alone it is written for readers, with the comments of the implementation.
SELECTED = $(filter-out core,$(PACKS))
no_blank :=
SELECTION = $(if $(SELECTED),,--comments) --packs '$(SELECTED)' src/sparse_local.in.h \
	build/sparse_local_$(or $(subst $(no_blank) $(no_blank),_,$(strip $(SELECTED))),core).h

# ---- checks ----

# Those that the conditions of the manifest name, in small letters.
PACK_NAMES := $(shell tr -c 'A-Z_\n' '\n' <src/sparse_local.in.h | sed -n 's/^SL_WITH_//p' | sort -u | tr A-Z a-z)

.PHONY: check-packs test-packs test-pack-core $(PACK_NAMES:%=test-pack-%)

check-packs: build/packs/small.ok $(patsubst %,build/packs/%.ok,core all $(PACK_NAMES)) ## do the core, each pack alone and all compile, with the right calls?
	@echo 'check-packs: the core, all, and each alone of: $(PACK_NAMES)'

# The log is shown if a check fails.
build/packs/%.ok: tests/core/check_pack_builds.sh sparse_local.h build/amalgamate
	@mkdir -p $(@D)
	$(call say,CHECK)
	@CC='$(CC)' CXX='$(CXX)' $< $* >build/packs/$*.log 2>&1 || { cat build/packs/$*.log; exit 1; }
	@touch $@

build/packs/small.ok: tests/core/check_packs.sh tools/build/layers.awk build/amalgamate
	@mkdir -p $(@D)
	$(call say,CHECK)
	@CC='$(CC)' CXX='$(CXX)' $< >build/packs/small.log 2>&1 || { cat build/packs/small.log; exit 1; }
	@touch $@

# ---- tests ----

# The core and each pack alone, with -DSL_NO_SIMD: which kernels run is not what these tests are about. Tests that use tools or more
# than one pack are left to `make test`.
PACK_TESTS_core =
$(PACK_NAMES:%=test-pack-%) test-pack-core: test-pack-%: deps sparse_local.h
	@+$(SUB_MAKE) run-tests B=build/pack_$* LIBRARY= REPLAYS= OPT='-O1 -DSL_NO_SIMD' \
	PACK_FLAGS=$(if $(filter-out core,$*),-DSL_WITH_$(shell echo $* | tr a-z A-Z)) \
	TEST_PROGRAMS='$(PACK_TESTS_$*:%=build/pack_$*/tests/core/test_%)'

test-packs: $(patsubst %,test-pack-%,core $(PACK_NAMES)) ## the core with its tests, and each pack with its own; test-pack-change for one

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

# The core and each pack, with -DSL_NO_SIMD: which kernels run is not what these tests are about. A pack is alone but for those of
# PACK_ALSO, which its tests use. Of tools they have only the list of a folder's files. Tests of many packs are left to `make test`.
PACK_TESTS_core = advice_calls checks csc csc_products csc_triplets factor factor_fail factor_overflow levels mindeg order_hashes order_kkt ordering peel plan \
	relaxation rigid_mass_cases small solve subnormal symbolic symbolic_order zero_mean_cases
PACK_TESTS_inverse = inverse inverse_diagonal region selected selected_use stats
PACK_TESTS_change = change change_columns change_drift change_rare change_scaled change_several supernodal
PACK_ALSO_change = edit
PACK_TESTS_constraints = constraints constraints_rigid constraints_trust constraints_sets
PACK_ALSO_constraints = change
PACK_TESTS_edit = submatrix
PACK_ALSO_edit = constraints
PACK_TESTS_fixed = fixed fixed_rare
PACK_TESTS_save = save save_file saved_set saved_set_use save_lies
PACK_ALSO_save = accuracy complex float pivots
PACK_TESTS_batch = batch matrix_sum scatter
PACK_TESTS_complex = complex complex_use
PACK_ALSO_complex = inverse
PACK_TESTS_float = storage
PACK_ALSO_float = accuracy inverse
PACK_TESTS_accuracy = bounds bounds_nulls bounds_rare condition refine refine_local reserve
PACK_ALSO_accuracy = edit float
PACK_TESTS_files = csc64 locale matrix_market matrix_market_file
PACK_TESTS_pivots = pivots_rare
PACK_ALSO_pivots = float

$(PACK_NAMES:%=test-pack-%) test-pack-core: test-pack-%: deps sparse_local.h
	@+$(SUB_MAKE) run-tests B=build/pack_$* $(FEW_TOOLS) OPT='-O1 -DSL_NO_SIMD' \
	PACK_FLAGS='$(patsubst %,-DSL_WITH_%,$(shell echo $(filter-out core,$*) $(PACK_ALSO_$*) | tr a-z A-Z))' \
	TEST_PROGRAMS='$(PACK_TESTS_$*:%=build/pack_$*/tests/core/test_%)'

test-packs: $(patsubst %,test-pack-%,core $(PACK_NAMES)) ## the core with its tests, and each pack with its own; test-pack-change for one

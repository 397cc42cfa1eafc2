# packaging.mk: what others build on: C++ adapters, compiled libraries, installation (a part of the Makefile)

## ADAPTER_CXX, ADAPTER_STD  compilers and C++ standards of test-adapters: 'g++ clang++', '11 14 17 20'
ADAPTER_CXX ?= $(CXX)
ADAPTER_STD ?= 11 17

.PHONY: deps-eigen test-adapters

deps-eigen: deps-cxx ## Eigen: the tests of its adapter
	@tools/build/deps.sh /usr/include/eigen3/Eigen/Sparse=libeigen3-dev

# ---- C++ ----

ADAPTERS = $(wildcard tools/adapters/*.hpp)
EIGEN = -isystem /usr/include/eigen3
# test_raii is built with exceptions and without
ADAPTER_NAMES = test_raii test_returning test_eigen

# $(1) compiler, $(2) standard, $(3) program, $(4) source, $(5) flags
define adapter_program
build/adapters/$(1)-$(2)-$(3): tests/adapters/$(4).cpp tests/adapters/check.hpp $(ADAPTERS) $$(IMPL)
	@mkdir -p $$(@D)
	$$(call say,CXX )
	$$(Q)$(1) -std=c++$(2) -O0 $$(WARN_BOTH) -I. $(EIGEN) $(5) -o $$@ $$< $$(IMPL) $$(LIBS) -lpthread
endef
$(foreach cxx,$(ADAPTER_CXX),$(foreach std,$(ADAPTER_STD),\
	$(eval $(call adapter_program,$(cxx),$(std),test_raii,test_raii,))\
	$(eval $(call adapter_program,$(cxx),$(std),test_returning,test_raii,-fno-exceptions))\
	$(eval $(call adapter_program,$(cxx),$(std),test_eigen,test_eigen,))))
ADAPTER_PROGRAMS = $(foreach cxx,$(ADAPTER_CXX),$(foreach std,$(ADAPTER_STD),\
	$(ADAPTER_NAMES:%=build/adapters/$(cxx)-$(std)-%)))

test-adapters: deps deps-eigen sparse_local.h ## the C++ and Eigen adapters, for each of ADAPTER_CXX and ADAPTER_STD
	@$(MAKE) --no-print-directory $(ADAPTER_PROGRAMS)
	@tests/lib/run.sh build/adapters/log $(ADAPTER_PROGRAMS)

# packaging.mk: what others build on: C++ adapters, compiled libraries, installation (a part of the Makefile)

## PREFIX   where `make install` puts things; DESTDIR, if any, comes before it
PREFIX ?= /usr/local
LIBDIR ?= $(PREFIX)/lib
INCLUDEDIR ?= $(PREFIX)/include
## ADAPTER_CXX, ADAPTER_STD  compilers and C++ standards of test-adapters: 'g++ clang++', '11 14 17 20'
ADAPTER_CXX ?= $(CXX)
ADAPTER_STD ?= 11 17
## PYTHON   Python of test-python, with NumPy, SciPy and pytest
PYTHON ?= $(shell python3 -c 'import numpy, pytest, scipy' 2>/dev/null && echo python3 || echo /usr/bin/python3)
## INSTALL_PARTS  what check-install checks, as in check_install.sh; nothing: all
INSTALL_PARTS ?=
## WHEELS   platforms of make wheels
WHEELS ?= manylinux musllinux windows
## SHARED_FLAGS, SHARED_LIBS  more for the compiled library: -DSL_METIS and -lmetis, -fopenmp
SHARED_FLAGS ?=
SHARED_LIBS ?=

.PHONY: deps-eigen deps-packaging test-adapters test-clients test-osqp bench-osqp shared test-shared deps-abi abi abi-record \
	install uninstall check-install deps-python deps-python-more deps-torch deps-wheels wheels old-debian test-wheels test-home test-python test-workers raster test-python-build bench-python deps-octave octave test-octave

deps-eigen: deps-cxx ## Eigen: the tests of its adapter
	@tools/build/deps.sh /usr/include/eigen3/Eigen/Sparse=libeigen3-dev

deps-packaging: ## cmake, meson, pkg-config, mandoc: the checks of the installation
	@tools/build/deps.sh cmake=cmake meson=meson ninja=ninja-build pkg-config=pkg-config mandoc=mandoc

# ---- C++ ----

ADAPTERS = $(wildcard tools/adapters/*.hpp)
EIGEN = -isystem /usr/include/eigen3
# test_raii is built with exceptions and without
# test_clients is run by a target of its own
ADAPTER_NAMES = test_raii test_returning test_eigen test_eigen_hostile test_eigen_names test_eigen_pivots

# $(1) compiler, $(2) standard, $(3) program, $(4) source, $(5) flags
define adapter_program
build/adapters/$(1)-$(2)-$(3): tests/adapters/$(4).cpp $(wildcard tests/adapters/*.hpp) $(ADAPTERS) $$(IMPL)
	@mkdir -p $$(@D)
	$$(call say,CXX )
	$$(Q)$(1) -std=c++$(2) -O0 $$(WARN_BOTH) -I. $(EIGEN) $(5) -o $$@ $$< $$(IMPL) $$(LIBS) -lpthread
endef
$(foreach cxx,$(ADAPTER_CXX),$(foreach std,$(ADAPTER_STD),\
	$(eval $(call adapter_program,$(cxx),$(std),test_raii,test_raii,))\
	$(eval $(call adapter_program,$(cxx),$(std),test_returning,test_raii,-fno-exceptions))\
	$(eval $(call adapter_program,$(cxx),$(std),test_eigen,test_eigen,))\
	$(eval $(call adapter_program,$(cxx),$(std),test_eigen_hostile,test_eigen_hostile,))\
	$(eval $(call adapter_program,$(cxx),$(std),test_eigen_names,test_eigen_names,))\
	$(eval $(call adapter_program,$(cxx),$(std),test_eigen_pivots,test_eigen_pivots,))\
	$(eval $(call adapter_program,$(cxx),$(std),test_clients,test_clients,))))
ADAPTER_PROGRAMS = $(foreach cxx,$(ADAPTER_CXX),$(foreach std,$(ADAPTER_STD),\
	$(ADAPTER_NAMES:%=build/adapters/$(cxx)-$(std)-%)))

# In C, with each pair of types of QDLDL and OSQP, whose headers are osqp_interface.h here; QDLDL also with the macros of SCS.
C_ADAPTER_PROGRAMS = $(foreach types,int_double long_double int_float long_float,build/adapters/test_qdldl-$(types) build/adapters/test_osqp-$(types)) \
	$(foreach types,DLONG_double int_SFLOAT DLONG_SFLOAT,build/adapters/test_qdldl-$(types)) $(patsubst %,build/adapters/test_%-c,mesh symmetric)
C_ADAPTER_TYPES = $(if $(findstring long,$@),-DQDLDL_LONG -DOSQP_USE_LONG) $(if $(findstring float,$@),-DQDLDL_FLOAT -DOSQP_USE_FLOAT) \
	$(if $(findstring DLONG,$@),-DDLONG) $(if $(findstring SFLOAT,$@),-DSFLOAT)
OSQP_HEADERS = $(addprefix build/adapters/osqp/,osqp.h lin_alg.h types.h printing.h qdldl_interface.h codegen.h)
$(OSQP_HEADERS):
	@mkdir -p $(@D)
	@echo '#include "tests/adapters/osqp_interface.h"' >$@

$(C_ADAPTER_PROGRAMS): $(wildcard tests/adapters/*.[ch] tools/adapters/*.[ch]) $(OSQP_HEADERS) $(IMPL)
	$(call say,CC  )
	$(Q)$(CC) $(C_FLAGS) -O1 $(C_ADAPTER_TYPES) -Ibuild/adapters/osqp -o $@ $(@:build/%-$(lastword $(subst -, ,$@))=tests/%).c $(IMPL) $(TEST_LIBS) $(LIBS)

test-adapters: deps deps-eigen sparse_local.h ## the adapters: C++ and Eigen, for each of ADAPTER_CXX and ADAPTER_STD; QDLDL, OSQP
	@$(MAKE) --no-print-directory $(ADAPTER_PROGRAMS) $(C_ADAPTER_PROGRAMS)
	@CC='$(CC)' LIBRARY='$(IMPL)' LIBS='$(LIBS)' tests/lib/run.sh build/adapters/log $(ADAPTER_PROGRAMS) $(C_ADAPTER_PROGRAMS) tests/adapters/check_world.sh

## QDLDL, OSQP, CATCH2  folders of their sources, of which test-osqp and bench-osqp build OSQP: any QDLDL 0.1, OSQP 1.0, Catch2 2.13
QDLDL ?=
OSQP ?=
CATCH2 ?=
test-osqp: deps-packaging sparse_local.h ## the own tests of QDLDL and of OSQP, on our names and our solver; needs QDLDL, OSQP, CATCH2
	@CC='$(CC)' QDLDL='$(QDLDL)' OSQP='$(OSQP)' CATCH2='$(CATCH2)' JOBS='$(JOBS)' tests/adapters/check_osqp.sh test

bench-osqp: deps-packaging sparse_local.h ## whole runs of OSQP on its seven classes, with our solver and with QDLDL; needs QDLDL, OSQP
	@CC='$(CC)' QDLDL='$(QDLDL)' OSQP='$(OSQP)' CATCH2= JOBS='$(JOBS)' tests/adapters/check_osqp.sh bench

CLIENT_PROGRAMS = $(foreach cxx,$(ADAPTER_CXX),$(ADAPTER_STD:%=build/adapters/$(cxx)-%-test_clients))

test-clients: deps deps-eigen sparse_local.h ## what libigl and geometry-central do with a solver, on ours and on Eigen's
	@$(MAKE) --no-print-directory $(CLIENT_PROGRAMS)
	@tests/lib/run.sh build/adapters/log $(CLIENT_PROGRAMS)

# ---- the compiled library ----

VERSION := $(shell sed -n 's/^\#define SL_VERSION_M[A-Z]* //p; s/^\#define SL_VERSION_PATCH //p' src/public/config.h | paste -sd.)
# What packages call themselves: between releases the version has a suffix, which Python spells as .dev0.
FULL_VERSION := $(VERSION)$(shell sed -n 's/^\#define SL_VERSION_SUFFIX "\([^"]*\)".*/\1/p' src/public/config.h)
# Before 1.0 a minor version may change the API, and so the soname has it.
SOVERSION := $(shell echo $(VERSION) | sed 's/^\(0\.[0-9]*\)\..*/\1/; s/^\([1-9][0-9]*\)\..*/\1/')
SO = build/lib/libsparse_local.so
SHARED_SOURCE = tools/packaging/sparse_local.c

shared: $(SO) build/lib/libsparse_local.a ## build/lib/libsparse_local.so and .a, which export sl_ only

build/lib/flags: always
	@mkdir -p $(@D)
	@echo '$(CC) $(OPT) $(SHARED_FLAGS) $(CFLAGS) | $(SHARED_LIBS) $(LDFLAGS)' | cmp -s - $@ || \
	echo '$(CC) $(OPT) $(SHARED_FLAGS) $(CFLAGS) | $(SHARED_LIBS) $(LDFLAGS)' >$@

build/lib/sparse_local.o: $(SHARED_SOURCE) sparse_local.h build/lib/flags
	$(call say,CC  )
	$(Q)$(CC) -std=c99 $(OPT) -fPIC -fvisibility=hidden -I. $(SHARED_FLAGS) $(CFLAGS) -c -o $@ $<

build/lib/libsparse_local.a: build/lib/sparse_local.o
	@rm -f $@
	$(call say,AR  )
	$(Q)$(AR) rcs $@ $<

$(SO): build/lib/sparse_local.o tools/packaging/libsparse_local.map
	$(call say,LINK)
	$(Q)$(CC) $(OPT) -shared -Wl,-soname,libsparse_local.so.$(SOVERSION) \
	-Wl,--version-script=tools/packaging/libsparse_local.map -Wl,--no-undefined \
	-o $@.$(VERSION) $< $(SHARED_FLAGS) $(SHARED_LIBS) $(LDFLAGS) -lm
	@ln -sf libsparse_local.so.$(VERSION) $@.$(SOVERSION)
	@ln -sf libsparse_local.so.$(VERSION) $@

test-shared: shared ## does the shared library export what the header declares, and nothing else?
	@CC='$(CC)' VERSION=$(VERSION) SOVERSION=$(SOVERSION) tests/adapters/check_shared.sh

deps-abi: ## abidiff, which compares declarations
	@tools/build/deps.sh abidiff=abigail-tools

abi: shared deps-abi ## is what releases declared and named as it was, and do programs of one run with the library of another?
	@CC='$(CC)' VERSION=$(FULL_VERSION) tests/abi/check_abi.sh

abi-record: deps $(B)/tests/core/test_saved_releases ## at a release: what it declares and names goes to tests/abi, factors it saves to the corpus
	@CC='$(CC)' VERSION=$(VERSION) tests/abi/check_abi.sh record
	@SL_RECORD_SAVED=1 $(B)/tests/core/test_saved_releases

# ---- installation ----

# The program needs libpng. Where it cannot be built, the rest is installed.
install: shared ## header, adapters, libraries, pkg-config and CMake files, program, man page to DESTDIR/PREFIX
	@echo '#include <png.h>' | $(CC) $(CPPFLAGS) -E -x c - >/dev/null 2>&1 && $(MAKE) --no-print-directory programs || \
	echo 'sparse-local is not built: it needs libpng-dev and zlib1g-dev'
	@VERSION=$(VERSION) SOVERSION=$(SOVERSION) PREFIX='$(PREFIX)' LIBDIR='$(LIBDIR)' INCLUDEDIR='$(INCLUDEDIR)' \
	DESTDIR='$(DESTDIR)' HOME_URL='$(HOME_URL)' PRIVATE_LIBS='$(SHARED_LIBS)' PROGRAM='$(B)/sparse-local' tools/packaging/install.sh install

uninstall: ## removes what install put there
	@VERSION=$(VERSION) SOVERSION=$(SOVERSION) PREFIX='$(PREFIX)' LIBDIR='$(LIBDIR)' INCLUDEDIR='$(INCLUDEDIR)' \
	DESTDIR='$(DESTDIR)' tools/packaging/install.sh uninstall

check-install: deps-packaging deps-cxx sparse_local.h ## strangers' projects by pkg-config, CMake and meson, outside the tree
	@CC='$(CC)' CXX='$(CXX)' VERSION=$(VERSION) tests/adapters/check_install.sh $(INSTALL_PARTS)

test-home: sparse_local.h ## does HOME_URL reach the header, the packages and the manual?
	@CC='$(CC)' PYTHON='$(PYTHON)' tests/adapters/check_home.sh

# ---- Python ----

DIST = /usr/lib/python3/dist-packages
deps-python: ## NumPy, SciPy, pytest, pip and setuptools
	@$(PYTHON) -c 'import numpy, pytest, scipy, setuptools, wheel' 2>/dev/null || tools/build/deps.sh \
	$(DIST)/numpy=python3-numpy $(DIST)/scipy=python3-scipy $(DIST)/pytest=python3-pytest \
	$(DIST)/pip=python3-pip $(DIST)/setuptools=python3-setuptools $(DIST)/wheel=python3-wheel

deps-python-more: ## joblib, Dask, MPI and mypy: tests of the Python package that are skipped without them
	@tools/build/deps.sh $(DIST)/joblib=python3-joblib $(DIST)/distributed=python3-distributed /usr/bin/mypy=mypy \
	$(DIST)/mpi4py=python3-mpi4py mpiexec.openmpi=openmpi-bin

deps-torch: ## torch, for the derivatives of the Python package
	@$(PYTHON) -c 'import torch' 2>/dev/null || tools/build/deps.sh $(DIST)/torch=python3-torch

# From a copy, as from a source distribution: pip leaves files beside pyproject.toml.
PYTHON_SOURCES = $(filter-out %/__pycache__,$(wildcard tools/python/*.* tools/python/sparse_local/* tools/python/sparse_local/*/*.py)) \
	$(SHARED_SOURCE) sparse_local.h LICENSE
define python_copy
rm -rf $(1) && mkdir -p $(dir $(1)) && cp -r tools/python $(1) && rm -rf $(1)/build $(1)/*.egg-info && \
mkdir -p $(1)/csrc && cp sparse_local.h LICENSE $(SHARED_SOURCE) tools/packaging/libsparse_local.map $(1)/csrc
endef

# The wheel of this machine, once.
build/python/installed: $(PYTHON_SOURCES)
	@rm -rf build/python
	@$(call python_copy,build/python/source)
	$(call say,PIP )
	$(Q)$(PYTHON) -m pip wheel --quiet --no-index --no-deps --no-build-isolation --disable-pip-version-check \
	--wheel-dir build/python/wheel build/python/source
	$(Q)$(PYTHON) -m pip install --quiet --root-user-action=ignore --no-index --no-deps --disable-pip-version-check \
	--target build/python/site build/python/wheel/*.whl
	@touch $@

deps-wheels: deps-python deps-mingw deps-clang ## musl, MinGW and clang: wheels for other systems, and Wine, which loads the DLL
	@tools/build/deps.sh musl-gcc=musl-tools objdump=binutils

wheels: deps-wheels sparse_local.h ## build/wheels: the source distribution, and wheels for Linux (glibc, musl) and Windows, with tags that are checked
	@$(MAKE) --no-print-directory build/wheels/made

build/wheels/flags: always
	@mkdir -p $(@D)
	@echo '$(CC) $(PYTHON) $(WHEELS) $(COMMIT_TIME)' | cmp -s - $@ || echo '$(CC) $(PYTHON) $(WHEELS) $(COMMIT_TIME)' >$@

# Times in wheels are those of the last commit, so that one commit gives the same bytes.
COMMIT_TIME = $(shell git log -1 --format=%ct 2>/dev/null || echo 1767225600)
build/wheels/made: $(PYTHON_SOURCES) tools/packaging/old_glibc.c tools/packaging/libsparse_local.map build/wheels/flags
	@$(call python_copy,build/wheels-source)
	$(call say,PIP )
	$(Q)CC='$(CC)' PYTHON='$(PYTHON)' SOURCE_DATE_EPOCH=$(COMMIT_TIME) tools/python/wheels.sh build/wheels-source build/wheels $(WHEELS)
	@touch $@

## OLD_DEBIAN  folder of an older Debian, made by make old-debian, in which test-wheels installs the wheel, too
OLD_DEBIAN ?=
old-debian: ## build/old_debian: Debian 11 with NumPy and pip, 500 MB
	@tools/build/deps.sh debootstrap=debootstrap
	@test -f build/old_debian/usr/bin/pip3 || debootstrap --variant=minbase --include=python3-pip,python3-numpy bullseye build/old_debian

test-wheels: wheels ## each wheel: its tag, pip, exports; libraries loaded under glibc, musl and Wine; the source distribution
	@CC='$(CC)' PYTHON='$(PYTHON)' WINE='$(WINE)' SOURCE_DATE_EPOCH=$(COMMIT_TIME) tests/adapters/check_wheels.sh build/wheels $(abspath $(OLD_DEBIAN))

test-python: deps-python sparse_local.h ## the package of tools/python, from its wheel, against SciPy, and its examples
	@$(MAKE) --no-print-directory build/python/installed
	@rm -rf build/python/source/tests build/python/source/examples build/python/source/gallery
	@cp -r tools/python/tests tools/python/examples tools/python/gallery tools/python/README.md build/python/source
	@cd build/python && PYTHONPATH=site $(PYTHON) -B -m pytest -q -p no:cacheprovider $(if $(PYTHON_TESTS),$(PYTHON_TESTS:%=source/tests/%),source/tests)

test-workers: deps-python-more ## of these the tests of workers: processes, joblib, Dask and MPI on one factor, and of large rasters
	@$(MAKE) --no-print-directory test-python PYTHON_TESTS='test_shared.py test_workers.py test_raster.py'

## RASTER   arguments of tools/python/examples/raster.py for make raster
RASTER ?= build/raster --size 1000 --points 400 --engines dask mpi --kill
raster: deps-python-more ## pair resistances and currents of a raster, each step killed once and resumed: RASTER='FOLDER --size 5745 --points 1415 --engines dask mpi --kill'
	@$(MAKE) --no-print-directory build/python/installed
	@OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1 \
	COMMIT=$$(git describe --always --dirty 2>/dev/null) COMPILER="$$($(CC) --version | sed 's/^\([a-z]*\).* \([0-9.]*\)$$/\1 \2/;q')" \
	PYTHONPATH=build/python/site $(PYTHON) -B tools/python/examples/raster.py $(RASTER)

# The source distribution and the wheel by `build`, without a network; each is installed and runs the example, whose picture is kept.
test-python-build: deps-python sparse_local.h ## python3 -m build, offline: both distributions are installed and draw a picture
	@tools/build/deps.sh $(DIST)/build=python3-build $(DIST)/matplotlib=python3-matplotlib
	@rm -rf build/python-dist
	@$(call python_copy,build/python-dist/source)
	@$(PYTHON) -m build --no-isolation --skip-dependency-check --outdir build/python-dist/out build/python-dist/source >build/python-dist/log 2>&1 || \
	{ tail -n 40 build/python-dist/log; exit 1; }
	@for file in build/python-dist/out/*; do \
	$(PYTHON) -m pip install --quiet --root-user-action=ignore --no-index --no-deps --no-build-isolation --disable-pip-version-check \
	--target $$file.site $$file && PYTHONPATH=$$file.site $(PYTHON) -B tools/python/examples/heat.py $$file.png || exit 1; done

bench-python: test-python ## times the package against scipy.sparse.linalg.splu
	@cp tools/python/bench.py build/python && PYTHONPATH=build/python/site $(PYTHON) -B build/python/bench.py

# ---- Octave ----

## OCTAVE   Octave of test-octave; its mkoctfile compiles
OCTAVE ?= octave-cli
## OCTAVE_FLAGS  more for its compiler: '-O1 -DSL_NO_SIMD' compiles in a third of the time
OCTAVE_FLAGS ?=
OCTAVE_MEX = build/octave/sparse_local_mex.mex

deps-octave: ## Octave and its mkoctfile, 200 MB
	@tools/build/deps.sh $(OCTAVE)=octave mkoctfile=octave-dev

octave: deps-octave $(OCTAVE_MEX) ## build/octave: the mex file of tools/octave

$(OCTAVE_MEX): $(wildcard tools/octave/*.[ch]) tools/octave/sparse_local_make.m sparse_local.h
	@mkdir -p $(@D)
	$(call say,MEX )
	$(Q)$(OCTAVE) -qfH --path tools/octave --eval "sparse_local_make('$(@D)'$(foreach f,-Wall -Wextra -Werror $(OCTAVE_FLAGS),, '$(f)'))"

test-octave: octave ## the classes of tools/octave, their examples and help texts
	@$(OCTAVE) -qfH $(patsubst %,--path %,build/octave tools/octave $(addprefix tools/octave/,gptoolbox examples tests)) --eval test_sparse_local

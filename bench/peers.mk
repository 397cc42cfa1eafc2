# peers.mk: measurements against other libraries, tables and figures of them (a part of the Makefile)

.PHONY: deps-peers deps-arpack bench-peers bench-eigenpairs speed speed-pages speed-peers speed-eigenpairs speed-threads speed-optimization speed-sizes speed-osqp speed-pool figures

PEERS := $(wildcard bench/peers/*.c bench/peers/*.cpp)

deps-peers: deps-cxx ## CHOLMOD with OpenBLAS, LDL, AMD, Eigen, MUMPS, Scotch
	@tools/build/deps.sh dmumps_c.h=libmumps-seq-dev scotch/scotch.h=libscotch-dev suitesparse/cholmod.h=libsuitesparse-dev /usr/include/eigen3/Eigen/Sparse=libeigen3-dev \
	/usr/share/doc/libopenblas-dev=libopenblas-dev

deps-arpack: ## ARPACK with OpenBLAS
	@tools/build/deps.sh arpack/arpack.h=libarpack2-dev /usr/share/doc/libopenblas-dev=libopenblas-dev

# Peers in their best setting: OpenBLAS chooses its kernels itself, whatever core the environment names.
PEER_ENV = env -u OPENBLAS_CORETYPE -u OPENBLAS_L2_SIZE
# Eigen chooses its vector instructions at compile time: its best setting is -march=native without assertions, for its own file only.
bench-peers: deps deps-peers sparse_local.h ## the questions peers, peers_harmonic, peers_shifted, peers_complex, peers_kkt, peers_kinds, peers_small and peers_multifrontal: against CHOLMOD, Eigen, LDL, MUMPS and Scotch
	@+$(SUB_MAKE) run-bench B=build/peers QUESTION_DEFAULT="peers peers_harmonic peers_shifted peers_complex peers_kkt peers_kinds peers_small peers_multifrontal" LINK=$(CXX) BENCH_ENV='$(PEER_ENV)' \
	CFLAGS='-DSL_BENCH_PEERS $(OPENMP) $(CFLAGS)' INCLUDES='-isystem /usr/include/suitesparse -isystem /usr/include/eigen3 -isystem /usr/include/scotch' \
	CXXFLAGS='-DSL_BENCH_PEERS -O3 -DNDEBUG -march=native $(CXXFLAGS)' PEER_LIBS='-lcholmod -lldl -lamd -ldmumps_seq -lmumps_common_seq -lmpiseq_seq -lscotch -lscotcherr -lopenblas' \
	PEER_OBJECTS='$(addprefix build/peers/obj/,$(addsuffix .o,$(basename $(PEERS))))'

ARPACK_OBJECTS = $(patsubst %.c,build/arpack/obj/%.o,$(wildcard bench/eigen/*.c))
ARPACK_BENCH = B=build/arpack BENCH_ENV='$(PEER_ENV) OPENBLAS_NUM_THREADS=1' CFLAGS='-DSL_BENCH_ARPACK $(OPENMP) $(CFLAGS)' \
	PEER_LIBS='-larpack -lopenblas' PEER_OBJECTS='$(ARPACK_OBJECTS)'
bench-eigenpairs: deps deps-arpack sparse_local.h ## auto-diffusion by the eigenpairs of ARPACK, with our factor as its solver: digits and time
	@+$(SUB_MAKE) run-bench QUESTION_DEFAULT=eigenpairs $(ARPACK_BENCH)

# ---- the figures of README.md and the manual ----

## ALONE    command in front of each measurement that keeps other programs away: 'chrt -f 20 taskset -c 1'
ALONE ?=

## MEASURE  what make speed measures; a file whose part is left out stays as it is
MEASURE ?= peers eigenpairs threads optimization sizes $(if $(OSQP),osqp)

# Two threads need both cores: ALONE is left out there, and where a compiler works, whose processor time is taken.
SPEED = build/speed
SPEED_RUN = BENCH_OUT=$(SPEED) MESH= BENCH=
OF_POOL = CFLAGS='$(CFLAGS)' OPENMP=
speed: deps deps-peers deps-arpack sparse_local.h build/amalgamate ## measures the figures of README.md and the manual anew and writes them there (needs a quiet machine; MEASURE, OSQP, QDLDL)
	@rm -rf $(SPEED)
	@+for part in $(MEASURE); do $(SUB_MAKE) speed-$$part || exit 1; done
	@python3 -B tools/docs/figures.py record $(SPEED)
	@python3 -B tools/docs/figures.py pages

speed-peers:
	@+$(SUB_MAKE) bench-peers $(SPEED_RUN) QUESTION='peers peers_harmonic peers_kinds peers_small peers_kkt'

speed-eigenpairs:
	@+$(SUB_MAKE) bench-eigenpairs $(SPEED_RUN) QUESTION=

speed-threads:
	@+$(SUB_MAKE) run-bench B=build/pool $(OF_POOL) $(SPEED_RUN) QUESTION='cold two_threads' ALONE=

speed-optimization:
	@+$(SUB_MAKE) run-bench B=build/pool $(OF_POOL) BENCH_OUT=$(SPEED)/O2 MESH= BENCH=quick QUESTION=cold
	@+$(SUB_MAKE) run-bench B=build/pool_O0 OPT=-O0 $(OF_POOL) BENCH_OUT=$(SPEED)/O0 MESH= BENCH=quick QUESTION=cold

speed-sizes: speed-pool
	@tools/build/size.sh && cp build/size/sizes.csv $(SPEED) && $(MEASURED) BENCH_OUT=$(SPEED) build/pool/bench --machine sizes

speed-osqp: speed-pool
	@+$(SUB_MAKE) bench-osqp ACCURACY=1e-3 && cp build/osqp/*.1e-3.?.csv $(SPEED) && $(MEASURED) BENCH_OUT=$(SPEED) build/pool/bench --machine osqp

# It names the machine of what is measured without it.
speed-pool:
	@mkdir -p $(SPEED)
	@+$(SUB_MAKE) build/pool/bench B=build/pool $(OF_POOL)

speed-pages: ## writes the figures of tools/docs/figures into README.md and the manual
	@python3 -B tools/docs/figures.py pages

# ---- the paper ----

FIGURES = build/figures$(if $(MESH),/$(firstword $(subst ., ,$(notdir $(MESH)))))
# The bench is that of bench-eigenpairs, the program that of the tests.
figures: deps deps-png deps-arpack sparse_local.h $(B)/sparse-local ## the paper's figures into build/figures, of made-up surfaces or of MESH (two minutes; BENCH=quick less)
	@$(MAKE) --no-print-directory build/arpack/bench $(ARPACK_BENCH)
	@tools/build/figures.sh $(B)/sparse-local build/arpack/bench '$(FIGURES)' '$(MESH)'

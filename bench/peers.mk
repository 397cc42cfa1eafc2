# peers.mk: measurements against other libraries, tables and figures of them (a part of the Makefile)

.PHONY: deps-peers deps-arpack bench-peers bench-eigenpairs speed speed-pages figures

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

# Two threads need both cores, and so ALONE is left out. What is compiled, is so between the measurements. OSQP needs its sources.
SPEED = build/speed
SPEED_RUN = BENCH_OUT=$(SPEED) MESH= BENCH=
speed: deps deps-peers deps-arpack sparse_local.h build/amalgamate ## measures the figures of README.md and the manual anew: their files and the pages; with OSQP, QDLDL those of OSQP
	@rm -rf $(SPEED)
	@+$(SUB_MAKE) bench-peers $(SPEED_RUN) QUESTION='peers peers_harmonic peers_kinds peers_small peers_kkt'
	@+$(SUB_MAKE) bench-eigenpairs $(SPEED_RUN)
	@+$(SUB_MAKE) run-bench B=build/pool_O2 $(SPEED_RUN) QUESTION='cold two_threads' ALONE=
	@+for o in O2 O0; do $(SUB_MAKE) run-bench B=build/pool_$$o OPT=-$$o MESH= BENCH=quick QUESTION=cold BENCH_OUT=$(SPEED)/$$o || exit 1; done
	@$(if $(OSQP),+$(SUB_MAKE) bench-osqp ACCURACY=1e-3 && cp build/osqp/*.1e-3.?.csv $(SPEED) && BENCH_OUT=$(SPEED) build/pool_O2/bench --machine osqp)
	@tools/build/size.sh && cp build/size/sizes.csv $(SPEED) && BENCH_OUT=$(SPEED) build/pool_O2/bench --machine sizes
	@python3 -B tools/docs/figures.py record $(SPEED)
	@python3 -B tools/docs/figures.py pages

speed-pages: ## writes the figures of tools/docs/figures into README.md and the manual
	@python3 -B tools/docs/figures.py pages

# ---- the paper ----

FIGURES = build/figures$(if $(MESH),/$(firstword $(subst ., ,$(notdir $(MESH)))))
# The bench is that of bench-eigenpairs, the program that of the tests.
figures: deps deps-png deps-arpack sparse_local.h $(B)/sparse-local ## the paper's figures into build/figures, of made-up surfaces or of MESH (two minutes; BENCH=quick less)
	@$(MAKE) --no-print-directory build/arpack/bench $(ARPACK_BENCH)
	@tools/build/figures.sh $(B)/sparse-local build/arpack/bench '$(FIGURES)' '$(MESH)'

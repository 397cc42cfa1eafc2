# web.mk: the npm package: WebAssembly, JavaScript, types; the kernel of live pages (a part of the Makefile)

.PHONY: deps-npm deps-types deps-bundlers npm live live-page test-npm test-live bench-npm

deps-npm: ## clang, lld and a C library for WebAssembly, and node
	@tools/build/deps.sh node=nodejs clang=clang wasm-ld=lld /usr/lib/wasm32-wasi/libc.a=wasi-libc \
	'/usr/lib/llvm-*/lib/clang/*/lib/wasi/libclang_rt.builtins-wasm32.a=libclang-rt-dev-wasm32'

deps-types: ## tsc, which checks the types of the package
	@tools/build/deps.sh tsc=node-typescript

deps-bundlers: ## esbuild and webpack, which bundle the package for browsers
	@tools/build/deps.sh esbuild=esbuild webpack=webpack

# The module has at most so many bytes in gzip -9. Fewer functions are inlined and fewer loops unrolled than with -O2, which
# gives a fifth of the bytes back and takes as long; -Os takes three times as long for a factorization.
WEB_LIMIT = 150000
WEB_CC = clang --target=wasm32-wasi --sysroot=/usr
WEB_OPT = -O2 -mllvm -inline-threshold=0 -fno-vectorize -mllvm -unroll-runtime=0 -mllvm -unroll-threshold=100
WEB_LINK = -mexec-model=reactor -Wl,--strip-all -Wl,-z,stack-size=1048576 -Wl,--stack-first
WEB_PACKAGE = build/npm/package
WEB_FILES = sparse_local.js node.js sparse_local.d.ts heat.js README.md

build/web/sparse_local.wasm: tools/web/sparse_local_web.c sparse_local.h tools/web/web.mk
	@mkdir -p $(@D)
	$(call say,WASM)
	$(Q)$(WEB_CC) -std=c99 $(WEB_OPT) -msimd128 -Wall -Wextra -Wno-unused-function -Werror -I. -c -o build/web/module.o $<
	$(Q)$(WEB_CC) $(WEB_LINK) -o $@ build/web/module.o
	@bytes=$$(gzip -9 -c $@ | wc -c); echo "sparse_local.wasm: $$(wc -c <$@) bytes, $$bytes in gzip, of which $(WEB_LIMIT) are allowed"; \
	[ $$bytes -le $(WEB_LIMIT) ] || { rm $@; exit 1; }

fill_package_json = sed 's/@VERSION@/$(FULL_VERSION)/; s/@LICENSE@/$(firstword $(shell head -n 1 LICENSE))/; \
	$(if $(HOME_URL),s|@HOME_URL@|$(subst &,\&,$(HOME_URL))|,/@HOME_URL@/d)' tools/web/package.json
build/npm/package.json: always
	@mkdir -p $(@D) && $(fill_package_json) >$@

npm: deps-npm ## build/npm/sparse-local-VERSION.tgz and its folder, build/npm/package: WebAssembly, JavaScript, types
	@$(MAKE) --no-print-directory build/web/sparse_local.wasm
	@rm -rf $(WEB_PACKAGE) && mkdir -p $(WEB_PACKAGE)
	@cp build/web/sparse_local.wasm LICENSE $(WEB_FILES:%=tools/web/%) $(WEB_PACKAGE)
	@$(fill_package_json) >$(WEB_PACKAGE)/package.json
	@tar -cf - -C build/npm --mtime='UTC 1985-10-26' --owner=0 --group=0 --numeric-owner --sort=name package | \
	gzip -9n >build/npm/sparse-local-$(FULL_VERSION).tgz
	@echo "build/npm/sparse-local-$(FULL_VERSION).tgz: $$(wc -c <build/npm/sparse-local-$(FULL_VERSION).tgz) bytes"

live: deps-npm deps-png ## build/sparse-local with the kernel of live pages: sparse-local view --live
	@$(MAKE) --no-print-directory build/web/sparse_local.wasm
	@$(MAKE) --no-print-directory programs

live-page: live ## build/manual/live.html: an example of a live page
	@mkdir -p build/manual
	@$(B)/sparse-local view star:5 --live --from 100 --out build/manual/live.html

## BUNDLERS  folder in which npm has installed esbuild, webpack with webpack-cli, vite, for test-npm
BUNDLERS ?=
test-npm: npm ## the npm package under node, its types, bundlers, and pages in headless Chromium where they can be installed
	@for what in types bundlers chromium; do $(MAKE) --no-print-directory deps-$$what >/dev/null 2>&1 || true; done
	@PACKAGE=$(WEB_PACKAGE) BUNDLERS='$(BUNDLERS)' tests/lib/run.sh build/npm/log tests/web/check_package.sh tests/web/check_bundlers.sh

test-live: live ## pages of view --live in headless Chromium; LIVE_MESH=hills:318x318: frame times of 100 thousand vertices
	@$(MAKE) --no-print-directory deps-chromium
	@PROGRAM=$(B)/sparse-local tests/lib/run.sh build/web/log tests/web/check_live.sh; status=$$?; \
	grep ' ms ' build/web/log/check_live.sh.log; exit $$status

bench-npm: npm ## times the npm package on the heat of a grid with 100 thousand unknowns; PEER=FOLDER of cholesky-solve beside it
	@node tools/web/bench.mjs $(WEB_PACKAGE) $(PEER)

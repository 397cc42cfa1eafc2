# release.mk: sizes and counts, the flat header, packages, the manual, a release (a part of the Makefile)

.PHONY: header-flat header-pair check-pair size marginal test-figures test-page release check-release

header-flat: build/amalgamate ## writes build/sparse_local_flat.h: the header without self-inclusion, for pasting
	$(AMALGAMATE) --flat src/sparse_local.in.h build/sparse_local_flat.h LICENSE

header-pair: build/amalgamate ## writes build/pair: sparse_local.h with the declarations, sparse_local.c with the bodies
	@mkdir -p build/pair
	$(AMALGAMATE) --declarations src/sparse_local.in.h build/pair/sparse_local.h LICENSE
	$(AMALGAMATE) --bodies src/sparse_local.in.h build/pair/sparse_local.c LICENSE

check-pair: header-pair sparse_local.h ## do these two files give the calls, the code and the bits of the header?
	@CC='$(CC)' CXX='$(CXX)' tests/core/check_pair.sh build/pair sparse_local.h

size: sparse_local.h build/amalgamate build/deps.ok ## sizes and compile times of the core and of all; with SIZE=full of each pack; fails above the limits
	@tools/build/size.sh

build/marginal/bodies.o: sparse_local.h
	@mkdir -p $(@D)
	$(call say,CC  )
	$(Q)gcc -std=c99 -O2 $(PACK_FLAGS) -DSPARSE_LOCAL_IMPLEMENTATION -ffunction-sections -fdata-sections -x c -c -o $@ $<

marginal: build/marginal/bodies.o ## kB of object that nothing but a public call, or a specialization, reaches
	@LC_ALL=C readelf -SsrW $< | awk -f tools/build/marginal.awk tools/build/specializations.txt -

test-figures: ## counts of tests and fuzzed inputs, as in tests/README.md
	@echo '$(words $(CORE_TESTS)) programs of $(shell cat $(CORE_TESTS) | grep -c 'cmocka_unit_test') core tests'
	@echo '$(words $(TOOL_TESTS)) programs of $(shell cat $(TOOL_TESTS) | grep -c 'cmocka_unit_test') tests of tools'
	@for f in tests/fuzz/corpus/*; do echo "corpus $${f##*/}: $$(ls $$f | wc -l) inputs, $$(cat $$f/* | wc -c) bytes"; done

# What else the page reports is read from the logs of the targets that have run in this checkout.
test-page: ## writes the figures between the marks in tests/README.md
	@tools/build/test_page.sh

include tools/packaging/packaging.mk
include tools/docs/docs.mk
include tools/web/web.mk

# ---- release ----

RELEASE = build/release/sparse_local-$(FULL_VERSION)

# The tarball is what git has of the last commit, and the generated header; owner and times are fixed, so that the same commit gives
# the same bytes. Nothing is installed: deps.sh says what is missing.
release: export DEPS_INSTALL = no
release: check-header docs npm wheels ## build/release: headers, tarball, manual, wheels, npm package, notes, and a list with licences and checksums
	@test -z "$$(git status --porcelain)" || { echo 'release: there are changes that are not committed'; exit 1; }
	@case $(VERSION) in 0.*) ;; *) test -f tests/abi/sparse_local-$(VERSION).h && test -f tests/abi/names-$(VERSION).txt || { echo 'release: make abi-record, and commit it'; exit 1; } ;; esac
	@rm -rf build/release && mkdir -p build/release
	@cp sparse_local.h tools/adapters/sparse_local* build/release
	@$(MAKE) --no-print-directory header-flat && cp build/sparse_local_flat.h build/release
	@$(MAKE) --no-print-directory header-pair && mkdir build/release/pair && cp build/pair/sparse_local.[ch] build/release/pair
	@$(MAKE) --no-print-directory header PACKS=core && cp build/sparse_local_core.h build/release
	@git archive --format=tar --prefix=sparse_local-$(FULL_VERSION)/ HEAD | gzip -9n >$(RELEASE).tar.gz
	@tar --sort=name --owner=0 --group=0 --mtime="$$(git log -1 --format=@%ct)" -cf - -C build manual | gzip -9n >$(RELEASE)-manual.tar.gz
	@mkdir build/release/python && cp build/wheels/*.whl build/wheels/*.tar.gz build/release/python && cp build/npm/*.tgz build/release
	@tools/docs/release_notes.sh $(FULL_VERSION) >build/release/NOTES.md
	@HOME_URL='$(HOME_URL)' tools/packaging/release_contents.sh build/release >build/CONTENTS.md && mv build/CONTENTS.md build/release
	@cd build/release && sha256sum $$(find * -type f | sort) >../SHA256SUMS && mv ../SHA256SUMS .
	@ls -l build/release build/release/python

check-release: release ## the files of a release, each used by itself in an empty folder
	@CC='$(CC)' CXX='$(CXX)' PYTHON='$(PYTHON)' WINE='$(WINE)' SOURCE_DATE_EPOCH=$(COMMIT_TIME) tests/adapters/check_release.sh build/release

# docs.mk: the manual, the examples in it, and what a release consists of (a part of the Makefile)

.PHONY: docs test-examples release

docs: ## build/manual/index.html: guide, API, algorithms, formats; fails if a link leads nowhere
	@python3 tools/docs/manual.py build/manual

# ---- examples ----

EXAMPLE_PROGRAMS = $(patsubst tools/examples/%.c,$(B)/examples/%,$(wildcard tools/examples/*.c))

$(B)/examples/%: tools/examples/%.c tools/examples/example.h $(IMPL)
	@mkdir -p $(@D)
	$(call say,CC  )
	$(Q)$(CC) $(C_FLAGS) -o $@ $< $(IMPL) $(LIBS)

test-examples: deps sparse_local.h ## compiles and runs the programs of tools/examples
	@$(MAKE) --no-print-directory $(EXAMPLE_PROGRAMS)
	@cd $(B)/examples && for program in $(notdir $(EXAMPLE_PROGRAMS)); do \
	./$$program >$$program.txt || { echo "$$program failed"; cat $$program.txt; exit 1; }; done
	@echo '$(words $(EXAMPLE_PROGRAMS)) passed, 0 failed'

# ---- release ----

RELEASE = build/release/sparse_local-$(VERSION)

# The tarball is what git has of the last commit, and the generated header; owner and times are fixed, so that the same commit gives
# the same bytes.
release: check-header docs ## build/release: header, flat header, tarball, manual, notes and checksums
	@test -z "$$(git status --porcelain)" || { echo 'release: there are changes that are not committed'; exit 1; }
	@rm -rf build/release && mkdir -p build/release
	@cp sparse_local.h build/release
	@$(MAKE) --no-print-directory header-flat && cp build/sparse_local_flat.h build/release
	@git archive --format=tar --prefix=sparse_local-$(VERSION)/ HEAD | gzip -9n >$(RELEASE).tar.gz
	@tar --sort=name --owner=0 --group=0 --mtime="$$(git log -1 --format=@%ct)" -cf - -C build manual | gzip -9n >$(RELEASE)-manual.tar.gz
	@tools/docs/release_notes.sh $(VERSION) >build/release/NOTES.md
	@cd build/release && sha256sum *.h *.tar.gz >SHA256SUMS
	@ls -l build/release

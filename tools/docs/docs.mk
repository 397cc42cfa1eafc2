# docs.mk: the manual and the examples in it (a part of the Makefile)

.PHONY: docs test-examples

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

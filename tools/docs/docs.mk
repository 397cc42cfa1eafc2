# docs.mk: the manual and the examples in it (a part of the Makefile)

.PHONY: docs pictures test-examples

docs: ## build/manual/index.html: tutorial, tasks, API, background; fails if a document names what does not exist, a figure is of no file, or there are too many words
	@rm -rf build/manual
	@HOME_URL='$(HOME_URL)' python3 -B tools/docs/manual.py build/manual
	@python3 -B tools/docs/test_figures.py -q
	@python3 -B tools/docs/named_files.py
	@python3 -B tools/docs/test_named_files.py -q

pictures: programs test-examples ## the pictures of the manual, by the commands in its pages
	@PROGRAM=$(B)/sparse-local tools/docs/pictures.sh

# ---- examples ----

# Those of the manual, to be pasted: with example.h in them, and with the packs that they name alone. Here they are linked with
# the bodies that the tests have.
EXAMPLES = $(patsubst tools/examples/%.c,%,$(wildcard tools/examples/*.c))

test-examples: deps docs $(IMPL) ## compiles and runs the programs of tools/examples, as the manual shows them
	@mkdir -p $(B)/examples
	@cp build/manual/examples/*.obj $(B)/examples
	@cd $(B)/examples && for name in $(EXAMPLES); do \
	sed '/define SPARSE_LOCAL_IMPLEMENTATION/d' $(CURDIR)/build/manual/examples/$$name.c >$$name.c && \
	$(CC) $(filter-out $(PACK_FLAGS),$(C_FLAGS)) -I$(CURDIR) -o $$name $$name.c $(abspath $(IMPL)) $(LIBS) && \
	./$$name >$$name.txt || { echo "$$name failed"; cat $$name.txt; exit 1; }; done
	@echo '$(words $(EXAMPLES)) passed, 0 failed'

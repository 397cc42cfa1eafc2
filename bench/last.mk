# last.mk: speed beside older versions of the header (a part of the Makefile)

## ISA      instruction set of bench-last: scalar, avx2 or avx512; nothing: the best
ISA ?=

.PHONY: bench-last run-bench-last

# fbd0a44d: version 0.1.0, before packs; 711cb521: the last that called itself 1.0.0
LAST_COMMITS = fbd0a44d 711cb521

# All versions are compiled alike. Of older ones only the tables stay global, so that they can be linked together.
LAST = build/last
LAST_CC = $(CC) -std=c99 -O2 -w $(PACK_FLAGS)
last_object = $(Q)$(LAST_CC) -I$(1) -DLAST_TABLE=last_$(2) -DLAST_NAME='"$(2)"' -c -o $@ $<

$(LAST)/%/sparse_local.h:
	@mkdir -p $(@D)
	$(Q)git show $*:sparse_local.h >$@

$(LAST)/this.o: bench/last/one_header.c bench/last/last.h sparse_local.h
	@mkdir -p $(@D)
	$(call say,CC  )
	$(call last_object,.,this)

$(LAST)/%.o: bench/last/one_header.c bench/last/last.h $(LAST)/%/sparse_local.h
	$(call say,CC  )
	$(call last_object,$(LAST)/$*,$*)
	$(Q)objcopy --keep-global-symbol=last_$* $@

# What makes and reads systems uses this version itself.
LAST_OBJECTS = $(call object,$(addprefix bench/last/,main race subjects) \
	$(addprefix bench/lib/,graph_kinds graph_networks harness kkt_programs systems))
$(B)/obj/bench/last/main.o: private override CFLAGS += -DLAST_HEADERS='$(foreach c,$(LAST_COMMITS),X($(c)))'

$(B)/bench_last: $(LAST_OBJECTS) $(LAST_COMMITS:%=$(LAST)/%.o) $(LAST)/this.o $(LIBRARY)
	$(call say,LINK)
	$(Q)$(LINK) -o $@ $^ $(LIBS)

run-bench-last: $(B)/bench_last
	@$(B)/bench_last $(if $(filter quick,$(BENCH)),--quick) $(if $(ISA),--isa $(ISA)) $(wildcard $(DATA)/meshes/*)

bench-last: deps sparse_local.h ## times calls beside those of older versions of the header; names rows above 1.03
	@+missing=$$(for c in $(LAST_COMMITS); do git cat-file -e $$c:sparse_local.h 2>/dev/null || echo $$c; done); \
	if [ -n "$$missing" ]; then echo "bench-last: left out, the history of git does not have" $$missing; \
	else $(SUB_MAKE) run-bench-last; fi

# packs.mk: headers of chosen packs, and their checks and tests

# ---- make header PACKS="core change" ----

# The core is in any header. Alone it is written for readers, with the comments of the implementation.
SELECTED = $(filter-out core,$(PACKS))
no_blank :=
SELECTION = $(if $(SELECTED),,--comments) --packs '$(SELECTED)' src/sparse_local.in.h \
	build/sparse_local_$(or $(subst $(no_blank) $(no_blank),_,$(strip $(SELECTED))),core).h

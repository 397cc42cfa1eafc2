# world.mk: projects of others, with their solver and with ours (a part of the Makefile)

## SOURCES  folder of the checkouts of other projects that `make world` builds; WORLD: only these of them
SOURCES ?=
WORLD ?=

.PHONY: world

world: deps-packaging deps-eigen build/python/installed ## projects of others, with their solver and with ours; writes tools/docs/world.md; needs SOURCES
	@CC='$(CC)' CXX='$(CXX)' PYTHON='$(PYTHON)' JOBS='$(JOBS)' bench/world/world.sh '$(SOURCES)' tools/docs/world.md $(WORLD)

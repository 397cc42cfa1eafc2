#!/bin/sh
# small_stack.sh: runs a program on a stack of STACK_KB kB, 64 by default (make test-stack)
ulimit -s "${STACK_KB:-64}" && exec "$@"

#!/usr/bin/env bash
# Makes mutants, which are small faults in the sources, and counts those that the tests notice. On demand: the copy of
# the tree in build-mutants/ is built once for all mutants, and all tests run once to see which mutants they reach.
#
#     tests/mutants/run.sh [--seed 1] [--count 30] [--least 85] [--longest 3600] [--programs] [FILE…]
#     tests/mutants/run.sh --list [--seed 1] [--count 30] [FILE…]   # the mutants, without building anything
#
# The mutants are chosen from a seed over the sources in partition, solvers and engine, or in the files and folders that
# are named. Operators: comparison, logic (&& for ||), condition (always true or false), sign, off by one, wrong
# neighbour, swapped arguments, left-out call, forgotten update. A mutant that does not compile does not count.
#
# Of each mutant, the tests that reach it run until one fails: that of its source first, then the fastest. Tests that
# take more than --longest seconds are left out, and those of the programs without --programs. The output ends with the
# mutants that no test notices. The exit status is 0 if at least --least percent are noticed.
# build-mutants/build/reached.txt lists which test reaches which mutants.

set -euo pipefail
# shellcheck source=samples/common/setup.sh
source "$(dirname "${BASH_SOURCE[0]}")/../../samples/common/setup.sh"
unset SEAMFLOW_CORPUS
export CCACHE_BASEDIR="$PWD"

install_packages python3-clang
exec /usr/bin/python3 -B tests/mutants/run_mutants.py "$@"

#!/usr/bin/env bash
# Measures which lines of partition/, solvers/, engine/ and samples/ the tests run, and fails if they are less than
# 90 %. Prints the percentage of each folder; in build-coverage/coverage/ are uncovered.txt (the lines of each file that
# no test runs), index.html (the same as pages) and coverage.json.
#
#     tests/coverage/run.sh
#
# What is left out: the tests of the browser and of an installed library, which run code that is built elsewhere, and
# the corpus, so that all machines have the same figure.

set -euo pipefail
# shellcheck source=samples/common/setup.sh
source "$(dirname "${BASH_SOURCE[0]}")/../../samples/common/setup.sh"
unset SEAMFLOW_CORPUS

readonly least=90
readonly folders=(partition solvers engine samples)
readonly build_folder=build-coverage
readonly report="$build_folder/coverage"

mapfile -t more < <(page_packages)
install_packages gcovr "${more[@]}"
build coverage
find "$build_folder" -name '*.gcda' -delete
status=0
ctest --preset coverage --parallel "$(nproc)" || status=1

mkdir -p "$report"
pattern="$(IFS='|' && echo "${folders[*]}")"
gcovr --root . --filter "($pattern)/" "$build_folder" -j "$(nproc)" --gcov-executable "${GCOV:-gcov}" \
    --json "$report/coverage.json" --html-details "$report/index.html"
python3 tests/coverage/summary.py "$report/coverage.json" "$report/uncovered.txt" "$least" || status=1
echo "The lines that no test runs: $report/uncovered.txt; as pages: $report/index.html"
exit "$status"

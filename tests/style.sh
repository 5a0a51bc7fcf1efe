#!/usr/bin/env bash
# Checks the layout of all sources (.clang-format) and the names in them (.clang-tidy). Installs what is missing of
# the two tools and of what they read: benchmark's sources include OpenMP's header, and the compiler's own is not
# clang's.
#
#     tests/style.sh

set -euo pipefail
# shellcheck source=samples/common/setup.sh
source "$(dirname "${BASH_SOURCE[0]}")/../samples/common/setup.sh"

install_packages clang-format clang-tidy libomp-dev
readonly folders=(partition solvers engine samples tests)
find "${folders[@]}" \( -name '*.h' -o -name '*.cpp' \) -print0 | xargs -0 clang-format --dry-run -Werror
# Approx alone has a scale of 1: of small numbers it accepts any.
if grep -rn 'Approx(' tests --include='*.cpp' --include='*.h' | grep -v -e '^tests/support/relative.h:' -e 'isApprox('; then
    echo "Compare numbers with relative() of tests/support/relative.h, which is relative to small ones, too." >&2
    exit 1
fi
configure release
# Most sources are included by those of the unity build, where the filter of headers covers them.
# Names of one file may shadow those of another in its batch; within a file the compiler warns.
run-clang-tidy -quiet -p build -extra-arg=-Wno-shadow -extra-arg=-Wno-unknown-warning-option -j "$(nproc)" "$PWD/($(IFS='|' && echo "${folders[*]}")|build/.*/Unity)/" >build/clang-tidy.log 2>&1 || {
    grep -E -A 4 'error:|warning:' build/clang-tidy.log
    exit 1
}
echo "The layout and the names of all sources are as they should be."

#!/usr/bin/env bash
# Builds everything and runs all tests, from a bare Debian 12 on. Ends with the summary of ctest and its exit status.
#
#     tests/run.sh [--preset release|debug|asan|tsan]
#
# The tests that need a corpus of meshes look for it in the directory SEAMFLOW_CORPUS.

set -euo pipefail
if [[ -n "${SEAMFLOW_CORPUS:-}" ]]; then
    SEAMFLOW_CORPUS="$(realpath -- "$SEAMFLOW_CORPUS")"
    export SEAMFLOW_CORPUS
fi
# shellcheck source=samples/common/setup.sh
source "$(dirname "${BASH_SOURCE[0]}")/../samples/common/setup.sh"

usage() {
    echo "usage: tests/run.sh [--preset release|debug|asan|tsan]" >&2
    exit 2
}

preset=release
while (($# > 0)); do
    case "$1" in
    --preset)
        (($# >= 2)) || usage
        preset="$2"
        shift 2
        ;;
    --preset=*)
        preset="${1#*=}"
        shift
        ;;
    *) usage ;;
    esac
done

mapfile -t more < <(page_packages)
install_packages doxygen "${more[@]}"
build "$preset"
exec ctest --preset "$preset" --parallel "$(nproc)"

#!/usr/bin/env bash
# Builds everything and runs all tests, from a bare Debian 12 on. Ends with the summary of ctest and its exit status.
#
#     tests/run.sh [--all] [--preset release|debug|asan|tsan|coverage]
#     tests/run.sh --permissive     # what a build without libraries under the GPL has of its own, and that it has none
#     tests/run.sh --sanitizers     # all tests under ASan and UBSan, the engine's under TSan, a flow under valgrind
#     tests/run.sh --coverage       # which lines the tests reach, at least 90 % of them
#
# With --all the library is also built once more, as shared libraries. The last two are described in
# tests/sanitizers/run.sh and tests/coverage/run.sh. The tests that need a corpus of meshes look for it in the directory
# SEAMFLOW_CORPUS.

set -euo pipefail
if [[ -n "${SEAMFLOW_CORPUS:-}" ]]; then
    SEAMFLOW_CORPUS="$(realpath -- "$SEAMFLOW_CORPUS")"
    export SEAMFLOW_CORPUS
fi
# shellcheck source=samples/common/setup.sh
source "$(dirname "${BASH_SOURCE[0]}")/../samples/common/setup.sh"

# usage STATUS: to standard output when it was asked for.
usage() {
    sed -n 's/^#  *tests\/run.sh/tests\/run.sh/p' tests/run.sh >&$(($1 == 0 ? 1 : 2))
    exit "$1"
}

preset=release
all=0
targets=()
tests=()
while (($# > 0)); do
    case "$1" in
    --preset)
        (($# >= 2)) || usage 2
        preset="$2"
        shift 2
        ;;
    --preset=*)
        preset="${1#*=}"
        shift
        ;;
    --permissive)
        preset=permissive
        targets=(solvers_tests engine_tests seamflow_programs_test)
        # Noise and rounding are removed without factorisations: nothing there is different.
        tests=(--tests-regex '^(solvers|engine)\.|^samples.programs$|^licence$'
            --label-exclude '^solvers/(denoising|rounding|normals)$')
        shift
        ;;
    --all)
        all=1
        shift
        ;;
    --sanitizers | --coverage)
        (($# == 1)) || usage 2
        exec "tests/${1#--}/run.sh"
        ;;
    -h | --help) usage 0 ;;
    *) usage 2 ;;
    esac
done

mapfile -t more < <(page_packages)
case "$preset" in
asan | tsan) more+=("${sanitizer_packages[@]}") ;;
*) more+=("${python_packages[@]}") ;;
esac
install_packages doxygen python3-clang "${more[@]}"
build "$preset" "${targets[@]}"
if ((all)); then
    more=(--build-config All)
else
    more=()
fi
exec ctest --preset "$preset" "${more[@]}" "${tests[@]}" --no-label-summary --parallel "$(nproc)"

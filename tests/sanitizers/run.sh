#!/usr/bin/env bash
# Looks for errors in memory, undefined behaviour and races, in three parts; each is run whatever the others find. Ends
# with what each has found, and the exit status 0 if that is nothing.
#
#     tests/sanitizers/run.sh [asan|tsan|valgrind]…     # these parts, by default all
#
#     asan       all tests under AddressSanitizer (with leaks) and UndefinedBehaviorSanitizer; preset asan
#     tsan       the engine's tests under ThreadSanitizer, and that it finds races; preset tsan
#     valgrind   the program smooth of the release build under memcheck: a mesh in several sub-meshes, two threads
#
# What is left out: the corpus of meshes and the consumers of an installed library (they need large meshes, and builds
# of their own); what single tests leave out is said by them. Nothing of the project's own is suppressed: the files in
# this folder name what of other libraries is, and why.

set -euo pipefail
# shellcheck source=samples/common/setup.sh
source "$(dirname "${BASH_SOURCE[0]}")/../../samples/common/setup.sh"
unset SEAMFLOW_CORPUS

asan() {
    build asan
    ctest --preset asan --parallel "$(nproc)"
}

tsan() {
    build tsan engine_tests distributed_tests seamflow_race
    ctest --preset tsan --parallel "$(nproc)"
}

# memcheck COMMAND…: fails with what it finds, memory that nothing points to at the end included.
memcheck() {
    valgrind --quiet --error-exitcode=99 --leak-check=full --errors-for-leak-kinds=definite \
        --show-leak-kinds=definite --num-callers=30 "$@"
}

# Sweeps and converged steps, of a symmetric Laplacian and of one that is not.
valgrind_flow() {
    build release generate smooth
    local folder=build/valgrind
    mkdir -p "$folder"
    build/bin/generate mixed "$folder/mesh.ply" --vertices 2000
    local flow
    for flow in "fujiwara --converge never" "fujiwara --converge 1e-6" "ptackova-velho --converge never"; do
        # shellcheck disable=SC2086
        memcheck build/bin/smooth "$folder/mesh.ply" "$folder/smooth.ply" --time-step-edges 1 --steps 2 \
            --subdomains 6 --threads 2 --laplacian $flow
    done
}

(($# > 0)) || set -- asan tsan valgrind
for part in "$@"; do
    if [[ "$part" != @(asan|tsan|valgrind) ]]; then
        echo "there is no part $part: asan, tsan, valgrind" >&2
        exit 2
    fi
done
mapfile -t more < <(page_packages)
install_packages doxygen "${sanitizer_packages[@]}" "${more[@]}"

summary=()
status=0
for part in "$@"; do
    run="$part"
    [[ "$part" != valgrind ]] || run=valgrind_flow
    SECONDS=0
    # In a shell of its own, which ends at the first command that fails; `if` and `||` would switch that off.
    set +e
    (
        set -e
        "$run"
    )
    failed=$?
    set -e
    ((failed == 0)) || status=1
    summary+=("$(printf '%-9s %s, %d s' "$part" "$( ((failed == 0)) && echo passed || echo FAILED)" "$SECONDS")")
done
printf '%s\n' "" "Sanitizers:" "${summary[@]}"
exit "$status"

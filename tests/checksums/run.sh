#!/usr/bin/env bash
# Prints a checksum of what `smooth` writes in each of 89 runs: every Laplacian on every kind of mesh by every way of
# taking a step. On demand, before and after a change that is to change no bit; the processor and the libraries must be
# the same both times, for BLAS chooses its kernels by them.
#
#     tests/checksums/run.sh [FOLDER] >before     # of the programs in build/bin, or in another folder
#     tests/checksums/run.sh | diff before -

set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

bin="$(realpath "${1:-build/bin}")"
readonly bin
readonly laplacians=(fujiwara alexa-wardetzky ptackova-velho)
folder="$(mktemp -d)"
trap 'rm -r "$folder"' EXIT
cd "$folder"

for kind in triangles quads hexagons mixed two-level-cylinder noisy-sphere; do
    "$bin/generate" "$kind" "$kind.ply" --vertices 3000 >/dev/null
done
"$bin/generate" quads odd.obj --vertices 3000 >/dev/null
# A third of its faces each, and vertices that stay.
n="$(grep -c '^f' odd.obj)"
seq 0 $((n - 1)) | awk -v n="$n" '{print int(3 * $1 / n)}' >labels.txt
seq 0 97 2900 >fixed.txt

# run NAME INPUT OPTION…
run() {
    local name="$1" input="$2" output="out.${2##*.}"
    shift 2
    "$bin/smooth" "$input" "$output" "$@" --quiet >/dev/null
    printf '%s  %s\n' "$(sha256sum <"$output" | cut -c 1-16)" "$name"
}

for laplacian in "${laplacians[@]}"; do
    flow=(--laplacian "$laplacian" --time-step-edges 3 --steps 3)
    for kind in triangles quads hexagons mixed two-level-cylinder noisy-sphere; do
        run "$laplacian $kind, 8 sweeps" "$kind.ply" "${flow[@]}" --subdomains 8 --converge never
        run "$laplacian $kind, 8 converged" "$kind.ply" "${flow[@]}" --subdomains 8 --converge 1e-8
    done
    run "$laplacian, undecomposed" mixed.ply "${flow[@]}" --subdomains 1
    run "$laplacian, as chosen" noisy-sphere.ply "${flow[@]}"
    for k in 2 64; do
        run "$laplacian, $k sweeps" quads.ply "${flow[@]}" --subdomains "$k" --converge never
        run "$laplacian, $k converged" hexagons.ply "${flow[@]}" --subdomains "$k" --converge 1e-6
        run "$laplacian, $k plain" quads.ply "${flow[@]}" --subdomains "$k" --plain
    done
    run "$laplacian, Ventcell" quads.ply "${flow[@]}" --subdomains 8 --plain --conditions adapted-ventcell --q 0.5
    for conditions in schwarz robin; do
        run "$laplacian, $conditions" quads.ply "${flow[@]}" --subdomains 8 --plain --conditions "$conditions"
    done
    run "$laplacian, explicit" quads.ply --laplacian "$laplacian" --time-step-edges 0.1 --steps 3 --scheme explicit
    run "$laplacian, labels and fixed vertices" odd.obj "${flow[@]}" --labels labels.txt --fix fixed.txt
    run "$laplacian, small memory" mixed.ply "${flow[@]}" --subdomains 8 --converge never --memory-limit 4M
    run "$laplacian, one thread" mixed.ply "${flow[@]}" --subdomains 8 --converge never --threads 1
    run "$laplacian, begun" quads.ply "${flow[@]}" --subdomains 8 --converge never --checkpoint "state-$laplacian"
    run "$laplacian, gone on" quads.ply "${flow[@]:0:4}" --steps 5 --subdomains 8 --converge never \
        --checkpoint "state-$laplacian"
done
for laplacian in fujiwara alexa-wardetzky; do
    run "$laplacian, free boundary" two-level-cylinder.ply --laplacian "$laplacian" --time-step-edges 3 --steps 3 \
        --subdomains 8 --boundary free --rescale area
done

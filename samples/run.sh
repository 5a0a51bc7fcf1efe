#!/usr/bin/env bash
# Builds the programs and shows them at work, from a bare Debian 12 on: makes a mesh, smooths it in eight sub-meshes,
# compares the result with the undecomposed flow. The files are left in output/; with node and npm on the PATH, among
# them a page that shows it all in a browser. They are not installed for that: Debian's npm brings hundreds of packages.
#
#     samples/run.sh

set -euo pipefail
# shellcheck source=samples/common/setup.sh
source "$(dirname "${BASH_SOURCE[0]}")/common/setup.sh"

echo "The first time this takes some five minutes, most of it for building; later some seconds."
install_packages
build release generate smooth compare inspect figures

readonly bin=build/bin
readonly out=output
mkdir -p "$out"

# Says what is run, and runs it.
run() {
    echo
    echo "\$ $*"
    "$@"
}

readonly flow=(--radius 4% --steps 8)
if grep -qx 'SEAMFLOW_PAGE_FOUND:INTERNAL=TRUE' build/CMakeCache.txt; then
    readonly page=(--html "$out/page.html")
    readonly page_text="page.html           all of it to look at in a browser, step by step, with plots"
else
    readonly page=()
    readonly page_text="(a page for the browser takes node and npm: install them and run this again)"
fi
run "$bin/generate" noisy-sphere "$out/input.ply" --vertices 50000 --amplitude 0.4 --noise 0.5
run "$bin/smooth" "$out/input.ply" "$out/smooth.ply" "${flow[@]}" --subdomains 8 \
    --reference --parts "$out/parts.ply" --report "$out/report.json" "${page[@]}"
run "$bin/smooth" "$out/input.ply" "$out/undecomposed.ply" "${flow[@]}" --subdomains 1
run "$bin/compare" "$out/undecomposed.ply" "$out/smooth.ply" --report "$out/compare.json"
run "$bin/generate" gear "$out/gear.ply" --vertices 50000 --noise 0.3
run "$bin/smooth" "$out/gear.ply" "$out/smooth_gear.ply" --preset cad

cat <<END

A noisy star was smoothed by eight steps of mean curvature flow: cut into eight sub-meshes, and undecomposed. The lines
of compare tell how far the two results are apart. A noisy gear was smoothed with its edges kept.

In $PWD/$out:
    input.ply           the mesh before
    smooth.ply          after the flow, in eight sub-meshes
    undecomposed.ply    after the flow, without a cut
    parts.ply           the eight sub-meshes in colours
    report.json         times, sizes and distances, step by step
    compare.json        the distance of the two results
    gear.ply, smooth_gear.ply   the gear before and after
    $page_text

Open the .ply files with MeshLab, ParaView or Blender, the .json files with any text editor.
END

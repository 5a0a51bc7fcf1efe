#!/usr/bin/env bash
# Fails when a folder includes upwards (partition <- solvers <- engine <- samples, tests), when folders at any depth or
# files include each other in a circle, or when a header lets in a library that only source files may use.
#
#     tests/layering.sh [ROOT]

set -uo pipefail
cd "${1:-$(dirname "${BASH_SOURCE[0]}")/..}" || exit 1

status=0

# forbid WHAT REASON FOLDER…: no line of the folders' sources may match.
forbid() {
    local pattern="$1" reason="$2" found
    shift 2
    if found="$(grep -rnE --include='*.h' --include='*.cpp' "$pattern" "$@")"; then
        printf '%s:\n%s\n\n' "$reason" "$found"
        status=1
    fi
}

# The same for headers alone.
forbid_in_headers() {
    local pattern="$1" reason="$2" found
    shift 2
    if found="$(grep -rnE --include='*.h' "$pattern" "$@")"; then
        printf '%s:\n%s\n\n' "$reason" "$found"
        status=1
    fi
}

for folder in partition solvers engine samples tests; do
    [[ -d $folder ]] || { echo "there is no folder $folder"; status=1; }
done
forbid '#include "(solvers|engine|samples|tests)/' 'partition knows meshes, not equations' partition
forbid '#include "(engine|samples|tests)/' 'solvers know equations, not threads' solvers
forbid '#include "(samples|tests)/' 'the engine knows neither samples nor tests' engine
# The rooms of products know what they share, and not each other; presets name the options of both.
forbid '#include "engine/(setup|steppers|sweep|ranks|fields|flow|mean_curvature|diffuse|geodesic)' 'removing noise knows no flow' \
    engine/denoise engine/denoise.h engine/denoise.cpp engine/motion engine/surface
mapfile -t of_flows < <(find engine/flow engine/setup engine/steppers engine/sweep engine/ranks engine/fields -name '*.h' -o -name '*.cpp' |
    grep -v '^engine/setup/presets')
forbid '#include "(engine/denoise|solvers/denoising)' 'flows do not know how noise is removed' \
    /dev/null engine/mean_curvature_flow.h engine/mean_curvature_flow.cpp \
    engine/diffuse.h engine/diffuse.cpp engine/geodesic_distance.h engine/geodesic_distance.cpp "${of_flows[@]}"
forbid '#include "tests/' 'samples do not use tests' samples
forbid '#include "[^/"]*"|#include "\.\.?/' 'includes start with the name of their folder' partition solvers engine samples tests
# Except in the room of what the libraries below do with threads and memory.
mapfile -t equations < <(find solvers -name '*.h' -o -name '*.cpp' | grep -v '^solvers/platform/')
forbid '#include <(oneapi|tbb|thread|mutex|condition_variable|atomic|future)[/>]' 'equations know no threads' \
    /dev/null "${equations[@]}"
forbid '#include <(umfpack|cholmod|oneapi|tbb)' 'meshes know no solvers' partition
forbid_in_headers '#include <(metis|umfpack|cholmod|oneapi|tbb|OpenMesh|CGAL|omp)' \
    'libraries other than Eigen are for source files' partition solvers engine

# require_no_circle WHAT: of what stands before and behind each blank, by tsort, which knows what a circle is.
require_no_circle() {
    local circles
    if ! circles="$(sort -u | tsort 2>&1 >/dev/null)" || [[ -n $circles ]]; then
        printf '%s include each other in a circle:\n%s\n\n' "$1" "$circles"
        status=1
    fi
}

includes="$(grep -roE --include='*.h' --include='*.cpp' '^#include "[^"]+"' partition solvers engine samples |
    sed -E 's|:#include "| |; s|"$||')"
require_no_circle folders < <(sed -E 's|/[^/ ]*( \|$)|\1|g' <<<"$includes" | awk '$1 != $2')
# A header and its source are one room.
require_no_circle files < <(sed -E 's#\.(h|cpp)( |$)#\2#g' <<<"$includes" | awk '$1 != $2')
exit "$status"

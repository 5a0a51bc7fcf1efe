#!/usr/bin/env bash
# Times what grows with a surface: fans of triangles around one vertex, small copies in the middle of a sphere, and
# two surfaces that are nearly the same. Seconds; each row is twice the one before, so a linear time doubles.
#
#     samples/benchmark/surfaces.sh [PROGRAMS]     PROGRAMS: the folder of the programs [build/bin]
set -euo pipefail
programs=$(realpath "${1:-build/bin}")
folder=$(mktemp -d)
trap 'rm -r "$folder"' EXIT
cd "$folder"
TIMEFORMAT=%R

seconds() { { time "$@" > output.txt 2>&1; } 2>&1 || { cat output.txt >&2; return 1; }; }

# A cylinder of $1 sides, whose caps are fans of triangles around their centres.
fan() {
    awk -v n="$1" 'BEGIN {
        for (z = 0; z < 2; ++z)
            for (i = 0; i < n; ++i)
                printf "v %.17g %.17g %d\n", cos(2 * atan2(0, -1) * i / n), sin(2 * atan2(0, -1) * i / n), z
        print "v 0 0 0\nv 0 0 1"
        for (i = 1; i <= n; ++i) {
            j = i % n + 1
            print "f", i, j, n + j, n + i "\nf", j, i, 2 * n + 1 "\nf", n + i, n + j, 2 * n + 2
        }
    }'
}

# The vertices of an OBJ file times $1.
scaled() { awk -v s="$1" '$1 == "v" { printf "v %.17g %.17g %.17g\n", s * $2, s * $3, s * $4; next } 1'; }

printf '%10s %10s %10s %10s\n' sides inspect compare smooth
for n in 12500 25000 50000 100000; do
    fan $n > fan.obj
    printf '%10d %10s %10s %10s\n' $n "$(seconds "$programs/inspect" fan.obj)" \
        "$(seconds "$programs/compare" fan.obj fan.obj)" \
        "$(seconds "$programs/smooth" fan.obj out.obj --radius 1% --self-intersections)"
done
printf '%10s %10s %10s %10s\n' vertices "times .1" "times .001" noise
for n in 20000 40000 80000 160000; do
    "$programs/generate" noisy-sphere sphere.obj --vertices $n --noise 0 > /dev/null
    "$programs/generate" noisy-sphere noisy.obj --vertices $n > /dev/null
    scaled .1 < sphere.obj > tenth.obj
    scaled .001 < sphere.obj > thousandth.obj
    printf '%10d %10s %10s %10s\n' $n "$(seconds "$programs/compare" tenth.obj sphere.obj)" \
        "$(seconds "$programs/compare" thousandth.obj sphere.obj)" "$(seconds "$programs/compare" noisy.obj sphere.obj)"
done

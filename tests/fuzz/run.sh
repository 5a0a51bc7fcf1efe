#!/usr/bin/env bash
# Tries hostile files on all readers: libFuzzer with the address and undefined behaviour sanitizers, from seeds that the
# project makes itself. Installs clang if it is missing. What is found is left in build-fuzz/findings/, and tried
# again by every later run.
#
#     tests/fuzz/run.sh [--seconds N] [HARNESS…]
#
# N: in all, 300 unless told, and a second for each harness at least; as many of them run at once as there are
# processors.
# HARNESS: obj, off, ply, stl, glb, gltf, labels, vertex_set, checkpoint; all but checkpoint, which needs the whole library,
# unless told.

set -euo pipefail
# shellcheck source=samples/common/setup.sh
source "$(dirname "${BASH_SOURCE[0]}")/../../samples/common/setup.sh"

usage() {
    echo "usage: tests/fuzz/run.sh [--seconds N] [HARNESS…]" >&2
    exit 2
}

seconds=300
harnesses=()
while (($# > 0)); do
    case "$1" in
    --seconds)
        [[ "${2:-}" =~ ^[0-9]+$ ]] || usage
        seconds="$((10#$2))"
        shift 2
        ;;
    obj | off | ply | stl | glb | gltf | labels | vertex_set | checkpoint)
        harnesses+=("$1")
        shift
        ;;
    *) usage ;;
    esac
done
((${#harnesses[@]} > 0)) || harnesses=(obj off ply stl glb gltf labels vertex_set)

fuzzer_packages() {
    any_command clang++ || echo clang
    compgen -G '/usr/lib/llvm-*/lib/clang/*/lib/linux/libclang_rt.fuzzer-x86_64.a' >/dev/null || echo libclang-rt-dev
    # Without it what is found comes with addresses instead of names.
    any_command llvm-symbolizer || compgen -G '/usr/lib/llvm-*/bin/llvm-symbolizer' >/dev/null || echo llvm
}
mapfile -t more < <(fuzzer_packages)
install_packages "${more[@]}"
cmake --preset fuzz --log-level=WARNING >/dev/null
seeds=(make_seeds)
[[ " ${harnesses[*]} " != *" checkpoint "* ]] || seeds+=(make_checkpoint_seeds)
cmake --build --preset fuzz --target "${seeds[@]}" "${harnesses[@]/#/fuzz_}"

readonly folder=build-fuzz/fuzzing findings=build-fuzz/findings
rm -rf "$folder/seeds"
mkdir -p "$folder" "$findings"
for program in "${seeds[@]}"; do
    build-fuzz/bin/"$program" "$folder/seeds"
done

# Files that are written are waited for until they are on the disk: in memory that takes no time. A harness that finds
# something leaves its own behind.
memory=/dev/shm
[[ -d "$memory" && -w "$memory" ]] || memory="${TMPDIR:-/tmp}"
TMPDIR="$(mktemp -d -p "$memory" seamflow-fuzz-XXXXXX)"
export TMPDIR
pids=()
end() {
    ((${#pids[@]} == 0)) || kill "${pids[@]}" 2>/dev/null || true
    rm -rf "$TMPDIR"
}
trap end EXIT
trap 'exit 130' INT
trap 'exit 143' TERM

# What was found interesting in earlier runs is where the next one goes on.
fuzz() {
    local name="$1" time="$2"
    mkdir -p "$folder/corpus/$name" "$findings/$name"
    exec build-fuzz/bin/"fuzz_$name" -max_total_time="$time" -timeout=20 -rss_limit_mb=3000 -print_final_stats=1 \
        -dict="$folder/seeds/$name.dict" -artifact_prefix="$findings/$name/" \
        "$folder/corpus/$name" "$folder/seeds/$name" "$findings/$name" >"$folder/$name.log" 2>&1
}

n_processors="$(nproc)"
readonly n_processors
n_rounds=$(((${#harnesses[@]} + n_processors - 1) / n_processors))
each=$((seconds / n_rounds))
# libFuzzer takes 0 for no limit.
((each > 0)) || each=1
status=0
for ((first = 0; first < ${#harnesses[@]}; first += n_processors)); do
    names=("${harnesses[@]:first:n_processors}")
    pids=()
    for name in "${names[@]}"; do
        fuzz "$name" "$each" &
        pids+=($!)
    done
    for i in "${!names[@]}"; do
        if wait "${pids[$i]}"; then
            runs="$(sed -n 's/^stat::number_of_executed_units: *//p' "$folder/${names[$i]}.log")"
            echo "${names[$i]}: $runs files in $each s, nothing found"
        else
            status=1
            tail -n 40 "$folder/${names[$i]}.log"
            echo "${names[$i]}: something was found; the file is in $findings/${names[$i]}" >&2
        fi
    done
done
exit "$status"

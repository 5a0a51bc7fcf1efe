#!/usr/bin/env bash
# Puts faults into the sources, one at a time, and tells which of them the tests notice, and which test did. On demand:
# it takes about half a minute a fault, and builds the project once before the first.
#
#     tests/mutants/run.sh [--tree FOLDER] [NAME…]     # these faults, by default all; 'ply-*' means several
#     tests/mutants/run.sh --list [NAME…]              # what they break
#     tests/mutants/run.sh --check [NAME…]             # whether they apply to the tree: takes a second, builds nothing
#
# The faults are in tests/mutants/*.faults, one list for each folder. Of each there is
#
#     == NAME
#     A sentence that says what breaks.
#     build: targets to build
#     tests: regular expression of the tests that should notice it, as for ctest
#     survives: why no test can or need notice it (only where none does)
#     --- a/FILE and what follows: `git diff -U1`
#
# A fault that its own tests let pass is given to all others before it is said to survive, but for those that build,
# need a browser, take minutes or depend on how fast programs run. The exit status is 0 if all faults apply and build,
# nine of ten are noticed, and all others are argued.
#
# The sources are changed in a copy of the tree: build-mutants/, or a FOLDER outside the tree. It stays for the next
# run, which builds what is different and puts right what an interrupted one has left.

set -euo pipefail
# shellcheck source=samples/common/setup.sh
source "$(dirname "${BASH_SOURCE[0]}")/../../samples/common/setup.sh"
unset SEAMFLOW_CORPUS

readonly least=90
readonly slow='^(consumer|corpus|doc|layering|mutants|fuzz)|allocations_in_flows|interruption|in_browser'
# In KiB, of one process: a fault may take all memory there is. A limit of the address space would change how programs
# run.
readonly most_memory=$((8 << 20))

# usage STATUS: to standard output when it was asked for.
usage() {
    sed -n 's/^#  *tests\/mutants\/run.sh/tests\/mutants\/run.sh/p' tests/mutants/run.sh >&$(($1 == 0 ? 1 : 2))
    exit "$1"
}

# ---- the lists

names=()
declare -A folder sentence targets tests argument verdict

# read_list FOLDER: the diffs go to $patches/NAME.
read_list() {
    local line name='' in_diff=0 list="tests/mutants/$1.faults"
    while IFS= read -r line; do
        case "$line" in
        '== '*)
            name="${line#== }"
            [[ -z "${folder[$name]:-}" ]] || { echo "there are two faults $name" >&2 && exit 2; }
            names+=("$name")
            folder[$name]="$1"
            in_diff=0
            ;;
        'build: '*) targets[$name]="${line#build: }" ;;
        'tests: '*) tests[$name]="${line#tests: }" ;;
        'survives: '*) argument[$name]="${line#survives: }" ;;
        *)
            [[ "$line" != '--- '* ]] || in_diff=1
            if ((in_diff == 1)); then
                printf '%s\n' "$line" >>"$patches/$name"
            else
                sentence[$name]="${sentence[$name]:-}$line"
            fi
            ;;
        esac
    done <"$list"
}

# choose PATTERN…: leaves the faults in `names` that one of them matches; all, if there is none.
choose() {
    (($# > 0)) || return 0
    local pattern name chosen=()
    for pattern in "$@"; do
        local before=${#chosen[@]}
        for name in "${names[@]}"; do
            # shellcheck disable=SC2053
            [[ "$name" != $pattern ]] || chosen+=("$name")
        done
        ((${#chosen[@]} > before)) || { echo "there is no fault $pattern" >&2 && exit 2; }
    done
    names=("${chosen[@]}")
}

list_faults() {
    local name
    for name in "${names[@]}"; do
        printf '%-10s %-40s %s\n' "${folder[$name]}" "$name" "${sentence[$name]}"
    done
}

# patched NAME FOLDER [OPTION…]
patched() {
    local name="$1" root="$2"
    shift 2
    patch --force --silent --strip=1 --fuzz=0 --reject-file=- --directory="$root" "$@" <"$patches/$name" >/dev/null 2>&1
}

check_faults() {
    local name status=0
    for name in "${names[@]}"; do
        if [[ -z "${sentence[$name]:-}" || -z "${targets[$name]:-}" || -z "${tests[$name]:-}" ]]; then
            echo "$name lacks a sentence, targets or tests"
            status=1
        elif ! patched "$name" . --dry-run; then
            echo "$name does not apply"
            status=1
        fi
    done
    echo "${#names[@]} faults"
    return "$status"
}

# ---- the copy of the tree

# files FOLDER: those that are not built, sorted.
files() {
    (cd "$1" && find . \( -path './.git' -o -path './.cache' -o -path './build' -o -path './build-*' -o -path './output' \
        \) -prune -o -type f -print | sort)
}

# What is not among the sources goes from the copy: it must be a copy that an earlier run has made, or none yet.
copy_tree() {
    local file
    if [[ -d "$tree" && -n "$(ls -A "$tree")" && ! -d "$tree/build/mutants" ]]; then
        echo "$tree is neither empty nor a copy for faults: name another folder" >&2
        exit 2
    fi
    mkdir -p "$tree/build/mutants"
    while IFS= read -r file; do
        if ! cmp -s "$file" "$tree/$file"; then
            mkdir -p "$(dirname "$tree/$file")"
            cp "$file" "$tree/$file"
        fi
    done < <(files .)
    while IFS= read -r file; do
        rm "$tree/$file"
    done < <(comm -13 <(files .) <(files "$tree"))
}

# in_copy LOG COMMAND…
in_copy() {
    local log="$1"
    shift
    (cd "$tree" && "$@") >>"$log" 2>&1
}

# build_targets LOG [TARGET…]: all of them by default.
build_targets() {
    local log="$1"
    shift
    if (($# > 0)); then
        in_copy "$log" cmake --build build --target "$@"
    else
        in_copy "$log" cmake --build build
    fi
}

# run_tests LOG SECONDS OPTION…: stops at the first that fails.
run_tests() (
    log="$1"
    seconds="$2"
    shift 2
    ulimit -d "$most_memory"
    cd "$tree"
    timeout --kill-after=10 "$seconds" ctest --test-dir build --parallel "${CTEST_PARALLEL_LEVEL:-$(nproc)}" \
        --output-on-failure --stop-on-failure --no-tests=error "$@" >>"$log" 2>&1 &
    # Ctrl-C does not reach what timeout starts.
    trap 'kill $!; exit 130' INT TERM
    wait $!
)

# tests_named EXPRESSION: their names.
tests_named() {
    ctest --test-dir "$tree/build" --show-only --tests-regex "$1" | sed -n 's/^ *Test *#[0-9]*: //p'
}

# prepare: the unchanged copy passes the tests that the chosen faults name.
prepare() {
    local name log="$tree/build/mutants/unchanged.log"
    copy_tree
    mkdir -p "$tree/build/mutants"
    : >"$log"
    if [[ ! -f "$tree/build/build.ninja" ]]; then
        in_copy "$log" cmake --preset release -DSEAMFLOW_BUILD_SAMPLES=ON -DSEAMFLOW_BUILD_TESTS=ON \
            -DSEAMFLOW_PAGE=OFF -DSEAMFLOW_WARNINGS_AS_ERRORS=OFF -DCMAKE_UNITY_BUILD_BATCH_SIZE=8 || fail_unchanged "$log"
    fi
    local wanted=() all_tests=()
    for name in "${names[@]}"; do
        read -ra more <<<"${targets[$name]}"
        wanted+=("${more[@]}")
    done
    mapfile -t wanted < <(printf '%s\n' "${wanted[@]}" | sort -u)
    build_targets "$log" "${wanted[@]}" || fail_unchanged "$log"
    for name in "${names[@]}"; do
        mapfile -t more < <(tests_named "${tests[$name]}")
        ((${#more[@]} > 0)) || { echo "$name: there are no tests ${tests[$name]}" >&2 && exit 1; }
        all_tests+=("${more[@]}")
    done
    SECONDS=0
    run_tests "$log" 3600 --tests-regex "^($(IFS='|' && echo "${all_tests[*]}"))\$" ||
        fail_unchanged "$log"
    # What takes longer than all tests together do unchanged has no end.
    most_seconds=$((60 + SECONDS))
}

fail_unchanged() {
    tail -n 30 "$1" >&2
    echo "The unchanged tree does not build, or fails its tests: nothing can be said of faults; see $1" >&2
    exit 1
}

# ---- the verdicts

# noticed_by LOG STATUS: the name of the test that failed.
noticed_by() {
    local test
    test="$(grep -v -e '\*\*\*Skipped' -e '\*\*\*Not Run' "$1" |
        sed -n 's/^ *[0-9]*\/[0-9]* *Test *#[0-9]*: \([^ ]*\) .*\*\*\*.*/\1/p' | head -n 1)"
    if [[ -n "$test" ]]; then
        echo "noticed by $test"
    elif (($2 == 124 || $2 == 137)); then
        echo "noticed, for tests have no end"
    else
        echo "cannot be tested, see $1"
    fi
}

# judge NAME LOG: prints what becomes of a fault that is in the copy.
judge() {
    local name="$1" log="$2" status=0
    read -ra wanted <<<"${targets[$name]}"
    build_targets "$log" "${wanted[@]}" || { echo "does not build, see $log" && return; }
    run_tests "$log" "$most_seconds" --tests-regex "${tests[$name]}" || status=$?
    ((status == 0)) || { noticed_by "$log" "$status" && return; }
    build_targets "$log" || { echo "does not build, see $log" && return; }
    run_tests "$log" 3600 --exclude-regex "$slow" || status=$?
    if ((status == 0)); then
        echo "survives"
    else
        echo "$(noticed_by "$log" "$status"), which the list does not name"
    fi
}

try_out() {
    local name="$1" log="$tree/build/mutants/$1.log"
    : >"$log"
    if patched "$name" "$tree"; then
        verdict[$name]="$(judge "$name" "$log")"
        patched "$name" "$tree" --reverse
    else
        verdict[$name]="does not apply"
    fi
    printf '%-10s %-40s %s\n' "${folder[$name]}" "$name" "${verdict[$name]}"
}

# count PATTERN [FOLDER]: the faults of such verdicts.
count() {
    local name n=0
    for name in "${names[@]}"; do
        # shellcheck disable=SC2053
        [[ "${verdict[$name]}" != $1 || "${folder[$name]}" != ${2:-*} ]] || n=$((n + 1))
    done
    echo "$n"
}

report() {
    local name of_folder status=0
    printf '\n%-10s %7s %8s %9s %7s\n' folder faults noticed survivors unsound
    for of_folder in partition solvers engine samples '*'; do
        (($(count '*' "$of_folder") == 0)) ||
            printf '%-10s %7d %8d %9d %7d\n' "${of_folder/#\*/all}" "$(count '*' "$of_folder")" \
                "$(count 'noticed*' "$of_folder")" "$(count survives "$of_folder")" \
                "$(($(count 'does not*' "$of_folder") + $(count 'cannot*' "$of_folder")))"
    done
    for name in "${names[@]}"; do
        case "${verdict[$name]}" in
        survives)
            printf '\n%s survives. %s\n%s\n' "$name" "${sentence[$name]}" "${argument[$name]:-NOT ARGUED}"
            [[ -n "${argument[$name]:-}" ]] || status=1
            ;;
        noticed*)
            [[ -z "${argument[$name]:-}" ]] ||
                printf '\n%s is noticed, though its list argues why it is not.\n' "$name"
            ;;
        *)
            printf '\n%s %s.\n' "$name" "${verdict[$name]}"
            status=1
            ;;
        esac
    done
    local score=$((100 * $(count 'noticed*') / ${#names[@]}))
    printf '\nScore: %d %% of %d faults are noticed; %d %% are wanted.\n' "$score" "${#names[@]}" "$least"
    ((score >= least)) || status=1
    return "$status"
}

# ---- the command

task=run
tree=build-mutants
while [[ "${1:-}" == -* ]]; do
    case "$1" in
    --list | --check)
        task="${1#--}"
        shift
        ;;
    --tree)
        (($# >= 2)) || usage 2
        tree="$2"
        shift 2
        ;;
    -h | --help) usage 0 ;;
    *) usage 2 ;;
    esac
done
tree="$(realpath -m -- "$tree")"
patches="$(mktemp -d)"
trap 'rm -r "$patches"' EXIT
trap 'exit 130' INT
for name in partition solvers engine samples; do
    read_list "$name"
done
choose "$@"

case "$task" in
list) list_faults ;;
check) check_faults ;;
run)
    install_packages patch
    prepare
    for name in "${names[@]}"; do
        try_out "$name"
    done
    report
    ;;
esac

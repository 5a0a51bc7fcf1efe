# shellcheck shell=bash
# Sourced by samples/run.sh and tests/run.sh: what both need before they can build.
# After it: the working directory is the root of the project.

set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/../.."

# So that ccache knows the same source in another build folder.
export CCACHE_BASEDIR="${CCACHE_BASEDIR:-$PWD}"

readonly packages=(
    g++ cmake ninja-build pkg-config
    libtbb-dev libeigen3-dev libsuitesparse-dev libopenblas-dev libmetis-dev libopenmesh-dev
    libfmt-dev libxxhash-dev
    libhypre-dev libopenmpi-dev openmpi-bin zlib1g-dev
    doctest-dev libcli11-dev nlohmann-json3-dev
)

# For the Python module, the pictures of figures, and their tests; all else does without.
# shellcheck disable=SC2034
readonly python_packages=(python3-dev python3-numpy python3-matplotlib pybind11-dev mypy)

# For the presets asan and tsan, and for tests/sanitizers/run.sh.
# shellcheck disable=SC2034
readonly sanitizer_packages=(clang llvm libclang-rt-dev valgrind)

# missing_packages PACKAGE…: prints those that are not installed, one a line.
missing_packages() {
    local installed
    installed="$(dpkg-query -W -f '${binary:Package} ${db:Status-Status}\n' "$@" 2>/dev/null |
        sed -n 's/^\([^ :]*\)[^ ]* installed$/\1/p')" || true
    local package
    for package in "$@"; do
        grep -qxF -- "$package" <<<"$installed" || echo "$package"
    done
}

# any_command NAME…: whether one of them is there, from whatever source.
any_command() {
    local name
    for name in "$@"; do
        if command -v "$name" >/dev/null; then
            return 0
        fi
    done
    return 1
}

# page_packages: prints what is missing to build the page of --html and to open it in a browser, one a line.
page_packages() {
    if ! any_command node nodejs || ! any_command npm; then
        printf '%s\n' nodejs npm
    fi
    any_command chromium-headless-shell chromium chromium-browser google-chrome || echo chromium-headless-shell
}

# as_root COMMAND…: runs it as root, if that is possible.
as_root() {
    if ((EUID == 0)); then
        env DEBIAN_FRONTEND=noninteractive "$@"
    else
        sudo env DEBIAN_FRONTEND=noninteractive "$@"
    fi
}

# Without package lists, or with outdated ones, packages are not found: the lists are fetched then, and only then.
apt_install() {
    echo "Installing $*"
    if apt-cache show --no-all-versions "$@" >/dev/null 2>&1 &&
        as_root apt-get -qq install --no-install-recommends -y "$@"; then
        return 0
    fi
    as_root apt-get -qq update && as_root apt-get -qq install --no-install-recommends -y "$@"
}

# install_packages [MORE…]: installs what is missing; does nothing else, and takes no time, if nothing is.
install_packages() {
    if ! command -v dpkg-query >/dev/null; then
        echo "This is no Debian system: make sure of the equivalents of ${packages[*]} $*" >&2
        return 0
    fi
    local missing
    mapfile -t missing < <(missing_packages "${packages[@]}" "$@")
    if ((${#missing[@]} == 0)); then
        return 0
    fi
    if { ((EUID != 0)) && ! command -v sudo >/dev/null; } || ! apt_install "${missing[@]}"; then
        echo "These packages are missing; they have to be installed by root or with sudo:" >&2
        echo "    apt-get install ${missing[*]}" >&2
        return 1
    fi
}

# configure PRESET
configure() {
    cmake --preset "$1" -DSEAMFLOW_BUILD_SAMPLES=ON -DSEAMFLOW_BUILD_TESTS=ON --log-level=WARNING >/dev/null
}

# build PRESET [TARGET…]: configures and builds the targets, by default all.
build() {
    local preset="$1"
    shift
    configure "$preset"
    if (($# > 0)); then
        cmake --build --preset "$preset" --target "$@"
    else
        cmake --build --preset "$preset"
    fi
}

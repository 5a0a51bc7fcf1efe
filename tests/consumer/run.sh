#!/usr/bin/env bash
# Builds and runs the consumer in one of the ways in which a program comes by the library.
#
#     tests/consumer/run.sh \
#         install|headers|documents|package|find_package|pkg-config|destdir|add_subdirectory|shared BUILD WORK \
#         [CMAKE_ARGUMENT…]
#
# BUILD is a build folder of the project. WORK is for what is made here; `install` installs into WORK/static, from where
# find_package and pkg-config take it. add_subdirectory takes the objects of BUILD (see reuse.sh). shared compiles the
# library once more, with shared libraries and without optimisation, and installs that, too: into WORK/shared.

set -euo pipefail
way="$1"
build="$2"
mkdir -p "$3"
work="$(realpath "$3")"
shift 3
sources="$(realpath "$(dirname "${BASH_SOURCE[0]}")")"
root="$(realpath "$sources/../..")"

# configure_consumer NAME ARGUMENT…: in the folder WORK/NAME. What was compiled there before, and fits, stays.
configure_consumer() {
    local name="$1"
    shift
    cmake --fresh -S "$sources" -B "$work/$name" -G Ninja -DCONSUMER_EXPECTATIONS="$sources/expectations.cmake" "$@"
}

# with_find_package PREFIX NAME ARGUMENT…
with_find_package() {
    local prefix="$1" name="$2"
    shift 2
    configure_consumer "$name" -DCMAKE_PREFIX_PATH="$prefix" "$@"
    cmake --build "$work/$name"
    "$work/$name/consumer"
}

# with_pkg_config PREFIX NAME FLAG…: what pkg-config prints is quoted for a shell.
with_pkg_config() {
    local prefix="$1" name="$2" flags file
    shift 2
    file="$(find "$prefix" -name seamflow.pc)"
    flags="$(PKG_CONFIG_PATH="$(dirname "$file")" pkg-config --cflags --libs "$@" seamflow)"
    mkdir -p "$work/$name"
    eval "${CXX:-c++} \"\$sources/main.cpp\" -o \"\$work/\$name/consumer\" $flags"
    LD_LIBRARY_PATH="$(dirname "$(dirname "$file")")" "$work/$name/consumer"
}

# check_headers PREFIX: what an installed header includes is installed, too, and under the prefix seamflow/. (That each
# compiles by itself is seen where its .cpp file includes it first.)
check_headers() {
    local include="$1/include" header missing=0
    [[ -f $include/seamflow/engine/mean_curvature_flow.h ]] || { echo "there are no headers in $include" >&2; return 1; }
    if grep -rnE '^#include "' "$include"; then
        echo "these includes do not begin with seamflow/" >&2
        return 1
    fi
    while read -r header; do
        [[ -f $include/$header ]] || { echo "$header is included by an installed header and not installed" >&2; missing=1; }
    done < <(grep -rhoE '^#include <seamflow/[^>]+>' "$include" | sed -E 's/.*<(.*)>/\1/' | sort -u)
    return "$missing"
}

# check_documents PREFIX: links of documents lead somewhere, and manual pages have nothing that groff warns of.
check_documents() {
    local documents="$1/share/doc/seamflow" page link missing=0
    if [[ ! -f $documents/README.md || ! -f $1/share/man/man1/smooth.1 ]]; then
        echo "there are no documents in $1" >&2
        return 1
    fi
    while IFS=: read -r page link; do
        link="${link#](}"
        link="${link%)}"
        if [[ ! -e $(dirname "$page")/${link%%#*} ]]; then
            echo "$page links to $link, which is not installed" >&2
            missing=1
        fi
    done < <(grep -roE --include='*.md' '\]\([^)#][^)]*\)' "$documents" | grep -vE '\]\(https?:')
    if command -v groff >/dev/null; then
        for page in "$1"/share/man/man1/*.1; do
            [[ -z $(groff -ww -man -Kutf8 -Tutf8 -z "$page" 2>&1 | tee /dev/stderr) ]] || missing=1
        done
    fi
    [[ -f $1/share/bash-completion/completions/smooth && -f $1/share/zsh/site-functions/_smooth ]] || missing=1
    return "$missing"
}

# check_programs FOLDER: they run where they were put.
check_programs() {
    (
        cd "$1"
        bin/generate quads mesh.obj --vertices 400
        bin/smooth mesh.obj smooth.obj --radius 5%
        bin/compare mesh.obj smooth.obj
        bin/inspect smooth.obj
        rm mesh.obj smooth.obj
    )
}

case "$way" in
headers)
    check_headers "$work/static"
    ;;
documents)
    check_documents "$work/static"
    ;;
package)
    rm -rf "$work/package"
    mkdir -p "$work/package/elsewhere"
    cpack --config "$(realpath "$build")/CPackConfig.cmake" -G TGZ -B "$work/package"
    tar -xzf "$work"/package/seamflow-*.tar.gz -C "$work/package/elsewhere" --strip-components=1
    check_programs "$work/package/elsewhere"
    check_documents "$work/package/elsewhere"
    with_find_package "$work/package/elsewhere" "of package" "$@"
    if command -v dpkg-deb >/dev/null && command -v dpkg-shlibdeps >/dev/null; then
        cpack --config "$(realpath "$build")/CPackConfig.cmake" -G DEB -B "$work/package"
        dpkg-deb -f "$work"/package/seamflow_*.deb Depends | grep -q libtbb
        dpkg-deb -x "$work"/package/seamflow_*.deb "$work/package/of deb"
        check_programs "$work/package/of deb/opt/seamflow"
        check_documents "$work/package/of deb/opt/seamflow"
    fi
    ;;
install)
    rm -rf "$work/static"
    cmake --install "$build" --prefix "$work/static"
    ;;
find_package)
    with_find_package "$work/static" "of static" "$@"
    ;;
pkg-config)
    with_pkg_config "$work/static" "by pkg-config" --static
    with_pkg_config "$work/static" "by pkg-config"
    ;;
destdir)
    # The same files, below DESTDIR and the prefix; none names a folder of the build.
    rm -rf "$work/dest dir"
    DESTDIR="$work/dest dir" cmake --install "$build" --prefix /opt/seamflow
    diff <(cd "$work/dest dir/opt/seamflow" && find . | sort) <(cd "$work/static" && find . | sort)
    if grep -rlF --include='*.cmake' --include='*.pc' --include='*.h' -e "$root" -e "$work" "$work/dest dir"; then
        echo "These files name folders of the build" >&2
        exit 1
    fi
    with_find_package "$work/dest dir/opt/seamflow" "of destdir" "$@"
    ;;
add_subdirectory)
    # Objects that are taken over have no dependencies: none is left from the time before.
    rm -rf "$work/with sources"
    mapfile -t unity < <(sed -n 's/^\(CMAKE_UNITY_BUILD[A-Z_]*:[A-Z]*=.*\)/-D\1/p' "$build/CMakeCache.txt")
    configure_consumer "with sources" -DSEAMFLOW_SOURCE="$root" "${unity[@]}" "$@" \
        -DCMAKE_CXX_FLAGS="-O0" -DCMAKE_CXX_COMPILER_LAUNCHER="$sources/reuse.sh;$(realpath "$build")"
    cmake --build "$work/with sources"
    "$work/with sources/consumer"
    # Who does not ask for it gets no rule to install anything.
    cmake --install "$work/with sources" --prefix "$work/nothing"
    [[ ! -e "$work/nothing" ]]
    ;;
shared)
    configure_consumer "with shared sources" -DSEAMFLOW_SOURCE="$root" -DBUILD_SHARED_LIBS=ON -DSEAMFLOW_INSTALL=ON \
        -DCMAKE_CXX_FLAGS="-O0 -w" "$@"
    cmake --build "$work/with shared sources"
    "$work/with shared sources/consumer"
    rm -rf "$work/shared"
    cmake --install "$work/with shared sources" --prefix "$work/shared"
    with_find_package "$work/shared" "of shared" "$@"
    with_pkg_config "$work/shared" "by pkg-config, shared"
    ;;
*)
    echo "unknown way: $way" >&2
    exit 2
    ;;
esac

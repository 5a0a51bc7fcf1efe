#!/usr/bin/env bash
# Whether a build is free of libraries under the GPL: none is linked, no symbol of one is in an object, and no header of
# one was read. Prints what it finds; exit status 1 then.
#
#     tests/licence.sh BUILD

set -euo pipefail
build="$1"
status=0

found() {
    echo "$1"
    status=1
}

# Whatever is linked has to be among these, whose licences are those of samples/building.md: a new library has to be
# judged first. Those of MPI come along with smooth-distributed alone.
known='linux-vdso|ld-linux-x86-64|libc|libm|libdl|libpthread|librt|libstdc\+\+|libgcc_s|libgomp|libamd|libcamd'
known+='|libsuitesparseconfig|libtbb|libfmt|libxxhash|libmetis|libz|libOpenMeshCore|libseamflow_[a-z]*'
known+='|libmpi|libopen-rte|libopen-pal|libhwloc|libevent[a-z_]*-[0-9.]*|libudev|libcap'

mapfile -t binaries < <(find "$build/bin" "$build/python" -maxdepth 2 -type f \( -perm -u+x -o -name '*.so' \) 2>/dev/null
    find "$build" -maxdepth 2 -name 'libseamflow_*.so')
((${#binaries[@]} > 0)) || found "there is nothing in $build/bin"
for binary in "${binaries[@]}"; do
    while read -r library; do
        found "$(basename "$binary") is linked with $library"
    done < <(ldd "$binary" | sed -nE 's/^\s*(\S+) .*/\1/p' | sed 's|.*/||' | grep -vE "^($known)\.so" || true)
done

mapfile -t archives < <(find "$build" -maxdepth 2 -name 'libseamflow_*.a')
((${#archives[@]} > 0 || ${#binaries[@]} > 0)) || found "there are no libraries in $build"
while read -r symbol; do
    found "symbol $symbol"
done < <(nm -A -P "${archives[@]}" "${binaries[@]}" 2>/dev/null | sed -E 's/.*\]?: //' |
    grep -oE '^(cholmod|umfpack|spqr|klu|__gmp)_[a-z_0-9]*' | sort -u || true)

# Of SuiteSparse those of AMD and CAMD alone; of Eigen what its own switch leaves.
headers="$(ninja -C "$build" -t deps | sed -nE 's|^ +(/.*)$|\1|p' | sort -u)"
[[ -n $headers ]] || found "no headers are known"
while read -r header; do
    found "$header is included"
done < <(grep -E '/suitesparse/|/CGAL/|/gmp|/mpfr' <<<"$headers" |
    grep -vE '/(amd|camd|SuiteSparse_config)\.h$' || true)
while read -r source; do
    found "$source may take of Eigen what is not under the MPL"
done < <(grep '"command":' "$build/compile_commands.json" | grep -v -e -DEIGEN_MPL2_ONLY |
    sed -E 's/.* -c ([^ "]*).*/\1/' || true)
exit "$status"

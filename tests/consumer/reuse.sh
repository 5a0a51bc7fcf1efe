#!/usr/bin/env bash
# A compiler launcher: takes an object that the project's own build folder has, and compiles what it has not.
#
#     tests/consumer/reuse.sh BUILD COMPILER ARGUMENT… -MF DEPENDENCIES -o seamflow/OBJECT -c SOURCE
#
# It is for what a project configures, links and runs that takes in the library by add_subdirectory; that the sources
# compile the build folder has shown, and their objects do not depend on where they are linked.

set -euo pipefail
build="$1"
shift
object='' dependencies='' previous=''
for argument in "$@"; do
    case "$previous" in
    -o) object="$argument" ;;
    -MF) dependencies="$argument" ;;
    esac
    previous="$argument"
done
if [[ $object == seamflow/* && -f $build/${object#seamflow/} ]]; then
    cp "$build/${object#seamflow/}" "$object"
    : >"$dependencies"
else
    exec "$@"
fi

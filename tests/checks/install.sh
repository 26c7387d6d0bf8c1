#!/usr/bin/env bash
# usage: install.sh SOURCE_DIR BUILD_DIR
# Installs the library and builds a program against it, as its users do.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cmake --install "$2" --prefix "$work/prefix" >/dev/null
cmake -S "$1/tests/package" -B "$work/build" -G Ninja -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_PREFIX_PATH="$work/prefix" >/dev/null
cmake --build "$work/build"
"$work/build/torus"
# The installed program finds the installed library.
"$work/prefix/bin/curveskel" --version

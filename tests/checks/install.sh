#!/usr/bin/env bash
# usage: install.sh SOURCE_DIR BUILD_DIR
# Installs the library and builds programs against it, as its users do: for any processor and for
# this one, whose wider registers would have Eigen allocate in another way.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cmake --install "$2" --prefix "$work/prefix" >/dev/null
for flags in "" -march=native; do
  cmake -S "$1/tests/package" -B "$work/build$flags" -G Ninja -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_PREFIX_PATH="$work/prefix" -DCMAKE_CXX_FLAGS="$flags" >/dev/null
  cmake --build "$work/build$flags"
  "$work/build$flags/torus"
done
# Who compiles for wider registers without the flags of the CMake target is told by the compiler,
# not by a crash.
if echo '#include <curveskel/surface.hpp>' | "${CXX:-c++}" -std=c++20 -fsyntax-only -x c++ - -mavx \
  -I"$work/prefix/include" $(pkg-config --cflags eigen3) 2>"$work/messages"; then
  echo "compiles without the allocation that the library was built with" >&2
  exit 1
fi
grep -q "EIGEN_MALLOC_ALREADY_ALIGNED=1" "$work/messages"
# The installed program finds the installed library.
"$work/prefix/bin/curveskel" --version

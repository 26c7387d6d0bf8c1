#!/usr/bin/env bash
# usage: install.sh SOURCE_DIR BUILD_DIR
# Installs the library and builds programs against it, as its users do, README.md's among them: for
# any processor and for this one, whose wider registers would have Eigen allocate in another way.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cmake --install "$2" --prefix "$work/prefix" >/dev/null
sed -n '/^```cpp$/,/^```$/{/^```/d;p}' "$1/README.md" >"$work/readme.cpp"
# A tube that is open at both ends: the example hands its rims over, as the program does.
awk 'BEGIN {
  print "OFF\n1000 980 0"
  for (i = 0; i < 50; ++i) for (j = 0; j < 20; ++j) print cos(j * .31416), sin(j * .31416), i / 5
  for (i = 0; i < 49; ++i) for (j = 0; j < 20; ++j) {
    k = (j + 1) % 20
    print 4, 20 * i + j, 20 * i + k, 20 * i + 20 + k, 20 * i + 20 + j
  }
}' >"$work/shape.off"
for flags in "" -march=native; do
  cmake -S "$1/tests/package" -B "$work/build$flags" -G Ninja -DCMAKE_BUILD_TYPE=Release \
    -DREADME_EXAMPLE="$work/readme.cpp" \
    -DCMAKE_PREFIX_PATH="$work/prefix" -DCMAKE_CXX_FLAGS="$flags" >/dev/null
  cmake --build "$work/build$flags"
  "$work/build$flags/torus"
  (cd "$work" && "build$flags/readme")
  "$work/prefix/bin/curveskel" extract "$work/shape.off" -o "$work/program.obj" -q
  cmp <(grep -v "^#" "$work/shape.obj") <(grep -v "^#" "$work/program.obj")
done
# Who compiles for wider registers without the flags of the CMake target is told by the compiler,
# not by a crash.
if echo '#include <curveskel/surface.hpp>' | "${CXX:-c++}" -std=c++20 -fsyntax-only -x c++ - -mavx \
  -I"$work/prefix/include" $(pkg-config --cflags eigen3) 2>"$work/messages"; then
  echo "compiles without the allocation that the library was built with" >&2
  exit 1
fi
grep -q "EIGEN_MALLOC_ALREADY_ALIGNED=1" "$work/messages"
# Documents lead to nothing that is not installed with them.
python3 -B "$1/tests/checks/links.py" "$work/prefix/share/doc/curveskel"
# The installed program finds the installed library.
"$work/prefix/bin/curveskel" --version

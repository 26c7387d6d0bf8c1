#!/usr/bin/env bash
# usage: tidy.sh SOURCE_DIR [bench]
# clang-tidy 14 over every C++ file that the build compiles, many files to a unit; or over the
# benchmarks, which are as much work again.
set -euo pipefail
cd "$1"
export only=${2:-}
cmake --preset tidy -DCURVESKEL_BUILD_BENCH="$([ "$only" = bench ] && echo ON || echo OFF)" \
  -DCURVESKEL_BUILD_PYTHON=ON >/dev/null 2>&1
ninja -C build/tidy kernels/sources.cpp skeleton/page/page.cpp viewer/shaders.cpp >/dev/null

# The largest first, so that no core ends up with a long one alone; a main of a few lines is left to
# the compiler, as its headers would take a minute.
units() {
  python3 - <<'PYTHON'
import json, os, re

def sources(unit):
    return re.findall(r'#include "(/.+\.cpp)"', open(unit).read()) or [unit]

def size(unit):
    return sum(map(os.path.getsize, sources(unit)))

def weight(unit):
    return any("#include <CGAL/" in open(source).read() for source in sources(unit)), size(unit)

entries = json.load(open("build/tidy/compile_commands.json"))
units = {entry["file"] for entry in entries}
if os.environ["only"]:
    units = {unit for unit in units if f"/{os.environ['only']}/" in unit}
units = [unit for unit in units if size(unit) > 600]
print("\n".join(sorted(units, key=weight, reverse=True)))
PYTHON
}

# The static analyser takes half of the time, so it looks at what is shipped only, and not at
# ViennaCL and CGAL, in whose headers it finds things.
tidy() {
  local checks=()
  [[ $1 == */build/tidy/tests/* || $1 == */build/tidy/bench/* || $1 == */contraction/solvers/viennacl/* ||
    $1 == */units/CGAL.cpp ]] &&
    checks=(--checks=-clang-analyzer-\*)
  clang-tidy-14 -quiet -p build/tidy "${checks[@]}" "$1" 2>/dev/null
}
export -f tidy
units | xargs -P "$(nproc)" -I {} bash -c 'tidy {}'

#!/usr/bin/env bash
# usage: tidy.sh SOURCE_DIR [bench]
# clang-tidy 14 over every C++ file that the build compiles, many files to a unit; or over the
# benchmarks, which are as much work again.
set -euo pipefail
cd "$1"
export only=${2:-}
cmake --preset tidy -DCURVESKEL_BUILD_BENCH="$([ "$only" = bench ] && echo ON || echo OFF)" \
  >/dev/null 2>&1
ninja -C build/tidy kernels/sources.cpp viewer/shaders.cpp >/dev/null

# The largest first, so that no core ends up with a long one alone. Files that the build compiles
# alone, as CGAL's headers take so much memory, share a unit here; a main of a few lines is left to
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

database = "build/tidy/compile_commands.json"
entries = json.load(open(database))
alone = [entry for entry in entries if "/surface/" in entry["file"] and entry["file"].endswith(".cpp")
         and "/build/" not in entry["file"]]
if alone:
    together = os.path.abspath("build/tidy/surface_alone.cxx")
    with open(together, "w") as unit:
        unit.writelines(f'#include "{entry["file"]}"\n' for entry in alone)
    first = alone[0]
    command = first["command"].replace(first["file"], together)
    entries = [entry for entry in entries if entry not in alone]
    entries.append({"directory": first["directory"], "command": command, "file": together})
    json.dump(entries, open(database, "w"), indent=1)

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
    $1 == */surface_alone.cxx ]] &&
    checks=(--checks=-clang-analyzer-\*)
  clang-tidy-14 -quiet -p build/tidy "${checks[@]}" "$1" 2>/dev/null
}
export -f tidy
units | xargs -P "$(nproc)" -I {} bash -c 'tidy {}'

#!/usr/bin/env bash
# usage: tidy.sh SOURCE_DIR BUILD_DIR
# clang-tidy 14 over every C++ file that the build compiles. A file that passed is not looked at
# again until it, a header of the project or the configuration changes.
set -uo pipefail
source_dir=$1
build_dir=$2
export build_dir
export stamps=$build_dir/tidy
mkdir -p "$stamps"
cd "$source_dir"

headers=$(find . -path ./build -prune -o -name "*.hpp" -print0 | sort -z | xargs -0 cat .clang-tidy | sha256sum)
export headers

tidy() {
  local stamp
  stamp=$stamps/$({ echo "$headers"; cat "$1"; } | sha256sum | cut -c 1-32)
  [ -e "$stamp" ] && return 0
  local said
  if said=$(clang-tidy-14 -quiet -p "$build_dir" --extra-arg=-Wno-unknown-warning-option "$1" 2>/dev/null); then
    touch "$stamp"
  else
    printf '%s\n' "$said"
    return 1
  fi
}
export -f tidy

python3 - "$source_dir" "$build_dir" <<'PYTHON' | xargs -P "$(nproc)" -I {} bash -c 'tidy {}'
import json, os, sys
source, build = (os.path.realpath(path) for path in sys.argv[1:])
files = {os.path.realpath(entry["file"]) for entry in json.load(open(build + "/compile_commands.json"))}
own = [os.path.relpath(f, source) for f in files if f.startswith(source + "/") and not f.startswith(build)]
# The largest first, so that no core ends up with a long one alone.
print("\n".join(sorted(own, key=lambda f: -os.path.getsize(os.path.join(source, f)))))
PYTHON

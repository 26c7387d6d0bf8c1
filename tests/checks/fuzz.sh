#!/usr/bin/env bash
# usage: fuzz.sh SOURCE_DIR INPUTS
# Builds the readers' fuzzers and feeds each with so many inputs, the same ones every time. Exits
# with 77 (skipped) where there is no clang 14 with libFuzzer.
set -euo pipefail
cd "$1"
inputs=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
echo 'extern "C" int LLVMFuzzerTestOneInput(const unsigned char*, unsigned long) { return 0; }' \
  >"$work/empty.cpp"
if ! clang++-14 -fsanitize=fuzzer,address "$work/empty.cpp" -o "$work/empty" 2>"$work/log"; then
  echo "skipped: clang++-14 with libFuzzer is missing (Debian packages clang-14, libclang-rt-14-dev)"
  head -3 "$work/log"
  exit 77
fi

fuzzers=(obj off ply stl om gltf vtp vtk 3mf dae fbx gz rig look_dae look_fbx look_obj look_ply
  skeleton_obj skeleton_ply skeleton_cgal skeleton_swc skeleton_vtp skeleton_graphml skeleton_json)
cmake --preset fuzz >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
ninja -C build/fuzz -j "$(packages/jobs)" "${fuzzers[@]/%/_fuzzer}"
export inputs work
# New inputs go to the first folder, seeds come from the second and from broken files at hand.
feed() {
  local format=${1#*_} found=$work/$1 seeds=$work/$1-seeds
  mkdir -p "$found" "$seeds"
  cp fuzz/corpus/"$1"/* "$seeds"
  [ "$format" != "$1" ] || find ../shared/meshes/defects -name "*.${format/gltf/gl[tb]*}" -size -64k \
    -exec cp -t "$seeds" {} + 2>/dev/null || true
  if ! build/fuzz/bin/"$1"_fuzzer -seed=1 -runs="$inputs" -max_len=4096 -timeout=20 \
    -rss_limit_mb=1500 -artifact_prefix="build/fuzz/$1-" -verbosity=0 "$found" "$seeds" \
    2>"$work/$1.log"; then
    cat "$work/$1.log"
    echo "$1: a fault, see above; the input is build/fuzz/$1-*"
    return 1
  fi
  echo "$1: $inputs inputs"
}
export -f feed
printf '%s\n' "${fuzzers[@]}" | xargs -P "$(nproc)" -I {} bash -c 'feed {}'

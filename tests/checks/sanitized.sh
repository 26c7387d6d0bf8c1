#!/usr/bin/env bash
# usage: sanitized.sh SOURCE_DIR PRESET [PROGRAM [NAME...]]
# Builds a test program with the sanitizers of the preset (dev: AddressSanitizer and checks for
# undefined behaviour, warnings as errors; threads: ThreadSanitizer) of the tests of these files, and
# runs them; without names all of them, without a program all programs.
set -euo pipefail
cd "$1"
preset=$2
shift 2
program=${1:-}
[ $# -eq 0 ] || shift
files=$(IFS=';'; echo "$*")
cmake --preset "$preset" -DCURVESKEL_TESTS="$files" >/dev/null
programs=${program:-surface contraction skeleton rig meshes viewer}
read -ra targets <<<"${programs// /_tests }_tests"
ninja -C "build/$preset" -j "$(packages/jobs)" "${targets[@]}"
export TSAN_OPTIONS="halt_on_error=1 suppressions=$PWD/tests/viewer/threads.supp"
export UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1
names=("$@")
if [ ${#names[@]} -eq 0 ]; then
  for layer in $programs; do
    while read -r file; do
      file=${file##*/}
      names+=("${file%_test.cpp}")
    done < <(find "tests/$layer" -name '*_test.cpp')
  done
fi
joined=$(IFS='|'; echo "${names[*]}")
ctest --test-dir "build/$preset" -j "$(nproc)" --output-on-failure -R "^($joined)(\.collection)?\$"

#!/usr/bin/env bash
# usage: sanitized.sh SOURCE_DIR PRESET TEST...
# Builds these test programs with the sanitizers of the preset (dev: AddressSanitizer,
# UndefinedBehaviorSanitizer, warnings as errors; threads: ThreadSanitizer) and runs them, one per
# core at a time: name the slowest first.
set -euo pipefail
cd "$1"
preset=$2
shift 2
cmake --preset "$preset" >/dev/null
ninja -C "build/$preset" -j "$(packages/jobs)" "${@/%/_test}"
export TSAN_OPTIONS=halt_on_error=1
export UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1
printf '%s\n' "$@" | xargs -P "$(nproc)" -I {} env "build/$preset/bin/{}_test" --gtest_brief=1

#!/usr/bin/env bash
# usage: sanitized.sh SOURCE_DIR TEST...
# Builds these test programs with AddressSanitizer, UndefinedBehaviorSanitizer and warnings as
# errors, and runs them, one per core at a time: name the slowest first.
set -euo pipefail
cd "$1"
shift
cmake --preset dev >/dev/null
ninja -C build/dev -j "$(packages/jobs)" "${@/%/_test}"
export UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1
printf '%s\n' "$@" | xargs -P "$(nproc)" -I {} env "build/dev/bin/{}_test" --gtest_brief=1

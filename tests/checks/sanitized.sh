#!/usr/bin/env bash
# usage: sanitized.sh SOURCE_DIR TEST...
# Builds these test programs with AddressSanitizer, UndefinedBehaviorSanitizer and warnings as
# errors, and runs them.
set -euo pipefail
cd "$1"
shift
cmake --preset dev >/dev/null
ninja -C build/dev -j "$(packages/jobs)" "${@/%/_test}"
for name in "$@"; do
  echo "== $name"
  UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1 "build/dev/bin/${name}_test" --gtest_brief=1
done

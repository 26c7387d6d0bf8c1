#!/usr/bin/env bash
# Every C++ file is as clang-format 14 writes it.
set -euo pipefail
cd "$1"
find . -path ./build -prune -o -path ./out -prune -o \( -name '*.cpp' -o -name '*.hpp' \) -print0 |
  xargs -0 -r clang-format-14 --dry-run --Werror

#!/usr/bin/env bash
# usage: completion_test.sh SOURCE_DIR PROGRAM
# The shell completes verbs, options, the names that an option takes, and files.
set -euo pipefail
source "$1/app/completion.bash"
cd "$1"

failed=0
# The words typed, the last one to be completed, then "=" and all words that are offered for it.
offers() {
  local expected=${1##*= }
  read -ra COMP_WORDS <<< "${1% = *}"
  [ "${COMP_WORDS[-1]}" = "..." ] && COMP_WORDS[-1]=""
  COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
  _curveskel "$2"
  if [ "${COMPREPLY[*]}" != "$expected" ]; then
    echo "for '${1% = *}' expected '$expected', got '${COMPREPLY[*]}'" >&2
    failed=1
  fi
}

offers "curveskel ex = extract" "$2"
offers "curveskel --v = --version" "$2"
offers "curveskel extract --su = --surgery" "$2"
offers "curveskel extract --surgery ... = own cgal" "$2"
offers "curveskel rig --names u = unreal unity" "$2"
offers "curveskel extract READ = README.md" "$2"
offers "curveskel extract --output READ = README.md" "$2"
offers "curveskel nonsense READ = README.md" "$2"
exit $failed

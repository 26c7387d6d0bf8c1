#!/bin/sh
# usage: extract_one.sh PROGRAM VERSION WORK SECONDS first|last ID PATH OPTIONS
# One surface to WORK/ID: branches.csv, report.json, messages. The file status comes last: the exit
# status, the time limit, and the stamp of everything else that the result depends on.
set -f  # options are words without quotes, as the schema has them, and no patterns
program=$1 version=$2 folder=$3/$6 limit=$4 try=$5 path=$7 options=$8
stamp="$version
$path
$options
$(stat -L -c '%.9Y %s' -- "$path" 2>/dev/null)."

# A result stays that has the same stamp and either the same limit, or a lower one that it kept.
stays() {
  [ -e "$folder/status" ] || return 1
  { read -r status; read -r before; kept=$(cat); } <"$folder/status"
  [ "$kept" = "$stamp" ] || return 1
  [ "$before" = "$limit" ] && return 0
  [ "$status" = 5 ] && grep -q 'the time limit of' "$folder/messages" && return 1
  awk "BEGIN { exit !($before < $limit) }"
}

stays && exit 0
rm -rf "$folder" && mkdir -p "$folder" || exit
"$program" extract "$path" -o "$folder/branches.csv" --report "$folder/report.json" --quiet \
  --threads 1 --time-limit "$limit" $options 2>"$folder/messages"
status=$?
case $status in
  # No program, or one that was interrupted, as when a job is ended: the surface has no result yet.
  126 | 127 | 129 | 130 | 143) exit $status ;;
  # Killed: most often for the memory that all surfaces of the job need together. Its last try is
  # alone; one that is killed then, as one that crashes, has that as its result.
  137) [ "$try" = last ] || exit 0 ;;
esac
printf '%s\n' "$status" "$limit" "$stamp" >"$folder/status.new" &&
  mv "$folder/status.new" "$folder/status"

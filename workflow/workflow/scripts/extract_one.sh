#!/bin/sh
# usage: extract_one.sh PROGRAM WORK SECONDS ID PATH OPTIONS
# One surface to WORK/ID.csv, .json and .err; WORK/ID.status comes last, with the exit status.
program=$1 work=$2 limit=$3 id=$4 path=$5
shift 5
[ -e "$work/$id.status" ] && exit 0
# Options are words without quotes, as the schema has them.
"$program" extract "$path" -o "$work/$id.csv" --report "$work/$id.json" --quiet --threads 1 \
  --time-limit "$limit" $* 2>"$work/$id.err"
status=$?
# A signal from outside, as when a job is killed: the surface has no result yet.
[ $status -lt 128 ] || exit $status
echo $status >"$work/$id.status.new" && mv "$work/$id.status.new" "$work/$id.status"

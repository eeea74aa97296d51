#!/usr/bin/env bash
# One shard of a study, made to last: shard.sh STUDY DIR I N [options of `study run`]
# Exit code 75 (stopped early) is run again, at most STRAINWAVE_RETRIES times (5); everything else is handed on: 2 and 3
# would come out the same again, 74 wants a disk or a permission to be mended first.
# STRAINWAVE names the program (default: strainwave, from the PATH).
set -u
study=$1 dir=$2 shard=$3 shards=$4
shift 4
tries=${STRAINWAVE_RETRIES:-5}
while :; do
  "${STRAINWAVE:-strainwave}" study run "$study" --out "$dir" --shard "$shard/$shards" "$@"
  code=$?
  { [ "$code" -eq 75 ] && [ "$tries" -gt 0 ]; } || exit "$code"
  tries=$((tries - 1))
done

#!/usr/bin/env bash
# A study in shards by GNU parallel: parallel.sh STUDY DIR SHARDS [JOBS]
# On several machines: give parallel their names, PARALLEL='--sshlogin host1,host2 --workdir .', and a DIR that all see.
# A shard that was killed is run again by the same command; finished ones cost a moment.
set -eu
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
study=$1 dir=$2 shards=$3 jobs=${4:-100%}
program=${STRAINWAVE:-strainwave}
"$program" study plan "$study" --out "$dir" >&2   # freezes the plan, says what it will cost
export STRAINWAVE=$program
seq 0 $((shards - 1)) |
  parallel --jobs "$jobs" --joblog "$dir/parallel.log" --halt soon,fail=1 \
    "$here/shard.sh" "$study" "$dir" {} "$shards" --threads 1 ">" "$dir/shard-{}.txt"
"$program" study merge "$dir"

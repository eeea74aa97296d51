#!/usr/bin/env bash
# tests/same_bits.sh [--fresh] OLD NEW [PART …]   do two programs of strainwave give the same numbers?
#
# Both run over the gallery on this machine, each with an empty cache of its own; then every value is compared: JSON and TOML
# by key, HDF5 by dataset and attribute, decks and outlines by line. What may differ stands, with its reason, in
# tests/same_bits.allowed. Exit code 0: the same; 1: differences, the first of them printed; 2: wrong use.
#
# OLD is a program of an earlier commit:
#     git worktree add ../before COMMIT && cmake -S ../before -B ../before/build -G Ninja && ninja -C ../before/build strainwave
#     tests/same_bits.sh ../before/build/app/strainwave build/app/strainwave
# A program in TREE/build/app reads TREE/studies/gallery, else this tree's gallery.
#
# PART is a pattern of case names: analyze, export, gradient, study, or as fine as study-seed_relief_only. No PART: all of them.
# What a program gave is kept in $SAME_BITS_KEEP (default /tmp/same_bits-USER), by the content of program and gallery, so
# that OLD runs once; --fresh runs both again. $SAME_BITS_SHOW: how many differences are printed (default 20).
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
# Debian's python is the one that has python3-h5py.
python=/usr/bin/python3
[ -x "$python" ] || python=python3
export OPENBLAS_NUM_THREADS=1 OMP_NUM_THREADS=1
keep=${SAME_BITS_KEEP:-/tmp/same_bits-$(id -un)}

fresh=false
if [ "${1:-}" = --fresh ]; then fresh=true; shift; fi
if [ $# -lt 2 ] || [ ! -x "$1" ] || [ ! -x "$2" ]; then
  sed -n '2,/^set /{/^set /d;s/^# \{0,1\}//p}' "${BASH_SOURCE[0]}" >&2
  exit 2
fi
old=$(realpath "$1") new=$(realpath "$2")
shift 2

# The seed gear with one key changed, so that every stage has a case: NAME KEY=VALUE …, keys as in seed.toml.
variants='
linear      fidelity="linear"
stepping    method="stepping"
linearised  disc_gap="linearised"
normal      force_direction="flank_normal"
one_lobe    lobes=1
window      window_deg=[-30.0,40.0]
phases      phases=3 direction="both"
rotation    torque_nm=[] rotation_rad=[0.001,0.002]
first_order shape="two_disc"
ellipse     shape="ellipse"
cosine      shape="cosine"
assembled   gaps="assembled" along_face=4 flank_points=3 face_slices=3 profile_shift@circular_spline=2.4132
wedge       disc_taper_um=5.0 flank_points=3 face_slices=3
relief      tip_relief_um=4.0 lead_crowning_um=3.0 flank_points=5 face_slices=3
fine        per_pitch=6 along_wall=20
'

gallery_of() { # PROGRAM
  local tree
  tree=$(cd "$(dirname "$1")/../.." && pwd)
  if [ -d "$tree/studies/gallery" ]; then echo "$tree/studies/gallery"; else echo "$here/../studies/gallery"; fi
}

variant() { # GALLERY KEY=VALUE … → gear file; KEY@SECTION where a key stands in several sections
  local gear text pair key value section=''
  text=$(cat "$1/seed.toml"); shift
  for pair in "$@"; do
    key=${pair%%=*} value=${pair#*=} section=''
    case $key in *@*) section=${key#*@} key=${key%@*} ;; esac
    text=$(awk -v key="$key" -v value="$value" -v section="$section" '
      /^\[/ { here = $0; sub(/^\[/, "", here); sub(/\].*/, "", here) }
      !done && $0 ~ "^" key " *=" && (section == "" || section == here) { print key " = " value; done = 1; next }
      { print }
      END { if (!done) exit 1 }' <<< "$text") || { echo "same_bits: seed.toml has no key $key" >&2; return 1; }
  done
  printf '%s\n' "$text"
}

# Case names: part-name.
cases=()
for file in "$here"/../studies/gallery/*.toml; do
  name=$(basename "$file" .toml)
  if grep -q '^kind *=' "$file"; then cases+=("study-$name"); else cases+=("analyze-$name" "export-$name"); fi
done
while read -r name _; do [ -z "$name" ] || cases+=("analyze-$name"); done <<< "$variants"
for name in seed_relief_only seed_optimize_one_point seed_optimize seed_optimize_coned; do cases+=("gradient-$name"); done

wanted() { # CASE PATTERN …
  local case_name=$1 pattern; shift
  [ $# -gt 0 ] || return 0
  for pattern in "$@"; do
    # shellcheck disable=SC2053
    [[ $case_name == $pattern || $case_name == $pattern-* ]] && return 0
  done
  return 1
}

# Runs PROGRAM in the present folder, which is empty but for gallery/; relative paths, so that results do not name the folder.
run_case() { # PROGRAM CASE
  local program=$1 part=${2%%-*} name=${2#*-} gear status=0
  export XDG_CACHE_HOME=$PWD/cache
  unset STRAINWAVE_CACHE
  gear=gallery/$name.toml
  if [ ! -e "$gear" ]; then
    local line
    line=$(grep "^$name " <<< "$variants")
    read -ra line <<< "$line"
    variant gallery "${line[@]:1}" > "$gear" || return 1
  fi
  case $part in
    analyze) "$program" analyze "$gear" --json -o result.h5 > result.json 2> stderr.txt || status=$? ;;
    export)
      "$program" export "$gear" --calculix tooth.inp --tooth 2 --height 0.75 --profile teeth.dxf --contact contact.h5 \
        --vtkhdf cup.vtkhdf --torque-nm 7 2> stderr.txt || status=$?
      "$program" export "$gear" --calculix forces.inp --contact-forces --torque-nm 7 --profile teeth.csv --zeta 0.5 \
        2>> stderr.txt || status=$? ;;
    gradient) "$program" check-gradient "$gear" --reduced --json > result.json 2> stderr.txt || status=$? ;;
    study) "$program" study run "$gear" --reduced --json --out out > result.json 2> stderr.txt || status=$? ;;
  esac
  echo "$status" > exit_code.txt
  rm -rf cache gallery out/shards
}

# → folder of what PROGRAM gives for CASE, run if it is not kept.
result_of() { # PROGRAM CASE [again]
  local program=$1 case_name=$2 gallery key folder
  gallery=$(gallery_of "$program")
  key=$({ sha256sum < "$program"; cat "$gallery"/*.toml; cat "${BASH_SOURCE[0]}"; } | sha256sum | cut -c1-16)${3:-}
  folder=$keep/$key/$case_name
  $fresh && rm -rf "$folder"
  if [ ! -d "$folder" ]; then
    mkdir -p "$keep/$key"
    local at
    at=$(mktemp -d "$keep/run.XXXXXX")
    cp -r "$gallery" "$at/gallery"
    (cd "$at" && run_case "$program" "$case_name") || { rm -rf "$at"; return 1; }
    # Another run of the same program may have been faster.
    mv -T "$at" "$folder" 2>/dev/null || rm -rf "$at"
  fi
  echo "$folder"
}

# A program against itself runs twice: does it give the same numbers every time?
again=''
cmp -s "$old" "$new" && [ "$(gallery_of "$old")" = "$(gallery_of "$new")" ] && again=-again
pairs=()
for case_name in "${cases[@]}"; do
  wanted "$case_name" "$@" || continue
  start=$SECONDS
  printf '%-36s' "$case_name" >&2
  pairs+=("$case_name" "$(result_of "$old" "$case_name")" "$(result_of "$new" "$case_name" $again)")
  printf ' %4d s\n' $((SECONDS - start)) >&2
done
[ ${#pairs[@]} -gt 0 ] || { echo "same_bits: no case is called ${*}; there are ${cases[*]}" >&2; exit 2; }
exec "$python" "$here/same_bits.py" --allowed "$here/same_bits.allowed" --show "${SAME_BITS_SHOW:-20}" "${pairs[@]}"

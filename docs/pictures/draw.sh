#!/usr/bin/env bash
# Draws the pictures of README and docs from the gallery's seed gear. From anywhere: docs/pictures/draw.sh
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$root/run" analyze "$root/studies/gallery/seed.toml" --plots "$folder" > /dev/null
cp "$folder/meshing-forces.svg" "$root/docs/pictures/seed-load-sharing.svg"
cp "$folder/initial-backlash.svg" "$root/docs/pictures/seed-initial-backlash.svg"
cp "$folder/assembled-shape.svg" "$root/docs/pictures/seed-assembled-shape.svg"
"$root/run" analyze "$root/studies/gallery/seed_coned.toml" --plots "$folder/coned" > /dev/null
cp "$folder/coned/force-map.svg" "$root/docs/pictures/seed-coned-force-map.svg"
cp "$folder/coned/backlash-map.svg" "$root/docs/pictures/seed-coned-backlash.svg"
STRAINWAVE_FIGURES="$folder" "$root/run" bench flank taper > /dev/null
cp "$folder/flank-convergence.svg" "$root/docs/pictures/seed-flank-convergence.svg"
cp "$folder/face-modifications.svg" "$root/docs/pictures/seed-face-modifications.svg"

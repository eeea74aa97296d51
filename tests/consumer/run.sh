#!/usr/bin/env bash
# tests/consumer/run.sh BUILD    installs a build into a folder that is removed again, and uses it from a project outside.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
build=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

fail() { echo "consumer: $*" >&2; exit 1; }

cmake --install "$build" --prefix "$folder/prefix" > "$folder/install.log" || { cat "$folder/install.log"; fail "installing failed"; }
package=$(dirname "$(find "$folder/prefix" -name strainwaveConfig.cmake)")

# What only our own build says does not reach others.
if grep -rnE -e '-march|-Werror|-Wall|strainwave_build|strainwave_precompiled' "$package"; then fail "flags of our build are exported"; fi
# Paths of this machine's source and build neither.
source=$(cd "$here/../.." && pwd)
if grep -rnF -e "$source" "$package" | grep -v '^[^:]*:[0-9]*:#'; then fail "paths of the source folder are exported"; fi
# Public headers only: those that CMakeLists.txt calls private are not there, all others are.
headers=$folder/prefix/include/strainwave
for room in common model optimize studies; do
  while read -r list; do
    private=$(tr '\n' ' ' < "$list" | sed -n 's/.*PRIVATE_HEADERS \([^A-Z)]*\).*/\1/p')
    at=${list#"$source"/} at=$(dirname "$at")
    for header in "$source/$at"/*.hpp; do
      [ -e "$header" ] || continue
      name=$(basename "$header")
      case " $private " in
        *" $name "*) [ ! -e "$headers/$at/$name" ] || fail "$at/$name is private and installed" ;;
        *) [ -e "$headers/$at/$name" ] || fail "$at/$name is public and not installed" ;;
      esac
    done
  done < <(find "$source/$room" -name CMakeLists.txt)
done

configure() { # FOLDER ARGUMENTS …
  local to=$1; shift
  cmake -S "$here" -B "$folder/$to" -G Ninja -DCMAKE_PREFIX_PATH="$folder/prefix" -DCMAKE_BUILD_TYPE=Release "$@" > "$folder/$to.log" 2>&1 ||
    { cat "$folder/$to.log"; fail "configuring failed: $*"; }
}
configure forward -DCMAKE_DISABLE_FIND_PACKAGE_CLI11=ON -DCMAKE_DISABLE_FIND_PACKAGE_NLopt=ON
cmake --build "$folder/forward" > "$folder/build.log" 2>&1 || { cat "$folder/build.log"; fail "building failed"; }
answer=$("$folder/forward/consumer" "$source/studies/gallery/seed.toml")
echo "$answer"
[ "$answer" = "strainwave $(sed -n 's/^project(strainwave VERSION \([0-9.]*\).*/\1/p' "$source/CMakeLists.txt"): least backlash 3.85 um, largest force 47.2 N" ] ||
  fail "that is not what the seed gear has"
# Every component at once is at least found, with all its targets.
configure all -DALL=ON

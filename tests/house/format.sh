#!/usr/bin/env bash
# Are all C++ sources formatted as .clang-format says? clang-format 14, the one of Debian 12: others differ in small things.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
tool=$(command -v clang-format-14 || command -v clang-format) || { echo "clang-format (package clang-format-14) is not installed"; exit 1; }
"$tool" --version | grep -q 'version 14\.' || { echo "wanted is clang-format 14, $tool is $("$tool" --version)"; exit 1; }
folders=()
for folder in common model optimize surrogates studies app bench examples tests; do [ ! -d $folder ] || folders+=($folder); done
find "${folders[@]}" \( -name '*.cpp' -o -name '*.hpp' \) -print0 |
  xargs -0 -n 40 -P "$(nproc)" "$tool" --dry-run -Werror
echo "formatted"

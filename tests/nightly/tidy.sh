#!/usr/bin/env bash
# tests/nightly/tidy.sh BUILD [PATTERN]    clang-tidy 14 over the sources whose path matches PATTERN (default: all but tests and bench).
# Configures BUILD/nightly/tidy without unity build and precompiled headers, which are g++'s.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
build=$1/nightly/tidy
pattern=${2:-^(common|model|optimize|surrogates|studies|app)/.*\.cpp$}
cmake -S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCCACHE=OFF -DSTRAINWAVE_UNITY=OFF -DSTRAINWAVE_PRECOMPILED=OFF \
  -DSTRAINWAVE_TESTS=OFF -DSTRAINWAVE_BENCH=OFF -DSTRAINWAVE_EXAMPLES=OFF -DSTRAINWAVE_ARCH=x86-64-v3
[ -z "${NIGHTLY_ONLY_CONFIGURE:-}" ] || exit 0
cd "$root"
tool=$(command -v clang-tidy-14 || command -v clang-tidy)
find common model optimize surrogates studies app -name '*.cpp' 2>/dev/null | grep -E "$pattern" |
  xargs -n 4 -P "$(nproc)" "$tool" --quiet --warnings-as-errors='*' -p "$build"
echo "tidy"

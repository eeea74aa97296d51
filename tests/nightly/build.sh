#!/usr/bin/env bash
# tests/nightly/build.sh PRESET BUILD [TARGET …] [-- CTEST ARGUMENTS …]    configures a preset of CMakePresets.json in
# BUILD/nightly/PRESET, builds the targets (default: all) and runs its tests. NIGHTLY_ONLY_CONFIGURE=1 stops after configuring.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
preset=$1 build=$2/nightly/$1
shift 2
targets=()
while [ $# -gt 0 ] && [ "$1" != -- ]; do targets+=("$1"); shift; done
[ $# -gt 0 ] && shift
[ ${#targets[@]} -gt 0 ] || targets=(all)
export OPENBLAS_NUM_THREADS=1 OMP_NUM_THREADS=1
# Debian's OpenBLAS, CHOLMOD and HDF5 are not built for the thread sanitizer; what happens inside them is theirs.
export TSAN_OPTIONS="suppressions=$root/tests/nightly/tsan.txt halt_on_error=1" ASAN_OPTIONS=detect_leaks=1
export LSAN_OPTIONS="suppressions=$root/tests/nightly/lsan.txt" UBSAN_OPTIONS=print_stacktrace=1

cmake -S "$root" --preset "$preset" -B "$build"
[ -z "${NIGHTLY_ONLY_CONFIGURE:-}" ] || exit 0
cmake --build "$build" --target "${targets[@]}"
ctest --test-dir "$build" --output-on-failure -j "$(nproc)" -LE 'nightly|house' "$@"
case $preset in
  no-precompiled) cmake --build "$build" --target all_verify_interface_header_sets ;;
  coverage)
    gcovr --root "$root" --exclude "$root/(tests|bench|examples)/" --gcov-ignore-parse-errors --print-summary --html-details \
      "$build/coverage.html" "$build" | tail -3 ;;
esac

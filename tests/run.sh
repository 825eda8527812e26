#!/usr/bin/env bash
# Installs what is missing, builds with warnings as errors and runs every test.
#   bash tests/run.sh              one GCC build, assertions alive
#   bash tests/run.sh --all        also: full counts of random cases, Clang, ASan and UBSan, clang-tidy,
#                                  clang-format, manual pages
#   bash tests/run.sh --coverage   line and branch coverage of lib/ and tools/
# TINWRIGHT_BUILD_DIR (default: build/ of the checkout) holds one folder a build.
# TINWRIGHT_CASES multiplies the counts of random cases (default 1; with --all 20).
set -euo pipefail

root=$(cd "$(dirname "$0")/.." && pwd)
cd "$root"
builds=${TINWRIGHT_BUILD_DIR:-$root/build}
jobs=$(nproc)
. .ci/require_packages.sh

mode=${1:-}
case "$mode" in
    "" | --all | --coverage) ;;
    -h | --help)
        sed -n '2,/^set /{/^set /d;s/^# \{0,1\}//;p}' "$0"
        exit 0
        ;;
    *)
        echo "run.sh: unknown option $mode; known: --all, --coverage, --help" >&2
        exit 2
        ;;
esac

say() { printf '\n== %s\n' "$*"; }

# test_preset PRESET [CMAKE-OPTION...]
test_preset() {
    local preset=$1
    shift
    say "$preset: configure and build in $builds/$preset"
    cmake --preset "$preset" -B "$builds/$preset" "$@" > "$builds/$preset.configure.log" ||
        { cat "$builds/$preset.configure.log"; exit 1; }
    cmake --build "$builds/$preset" --parallel "$jobs"
    say "$preset: tests"
    ctest --test-dir "$builds/$preset" --output-on-failure --no-tests=error --parallel "$jobs"
}

packages=(g++ cmake ninja-build libgdal-dev libproj-dev libgeographiclib-dev libtbb-dev libcli11-dev libjson-c-dev doctest-dev libboost-dev)
case "$mode" in
    --all) packages+=(clang clang-tidy clang-format pandoc) ;;
    --coverage) packages+=(gcovr) ;;
esac
require_packages "${packages[@]}"
mkdir -p "$builds"

case "$mode" in
    "")
        test_preset dev
        ;;
    --coverage)
        test_preset coverage
        say "coverage"
        gcovr --root "$root" --filter lib/ --filter tools/ --exclude-throw-branches --print-summary \
            --html-details "$builds/coverage/coverage.html" "$builds/coverage"
        echo "line by line: $builds/coverage/coverage.html"
        ;;
    --all)
        mapfile -t sources < <(git ls-files '*.cpp' '*.hpp')
        say "clang-format: ${#sources[@]} files"
        clang-format --dry-run --Werror "${sources[@]}"

        export TINWRIGHT_CASES=${TINWRIGHT_CASES:-20}
        test_preset dev -DTINWRIGHT_BUILD_DOCS=ON
        unset TINWRIGHT_CASES
        test_preset dev-clang
        export UBSAN_OPTIONS=print_stacktrace=1
        test_preset asan-ubsan

        say "clang-tidy"
        run-clang-tidy -quiet -p "$builds/dev-clang" -j "$jobs" "^$root/(lib|tools|samples)/" 2> /dev/null
        ;;
esac
say "all passed"

#!/usr/bin/env bash
# Builds the benchmarks, runs them and puts their tables in docs/benchmarks.md.
#   bash tests/benchmarks/run.sh [TABLE...]        tables: delaunay raster read job criteria
#                                                 criteria_growth criteria_worst noding constrained conforming (default: all)
# ROUNDS=k changes the number of interleaved runs of which the median is taken (default 5). SCALE=f takes that part
# of the points for a quick look. BUILD=folder holds the build.
# CGAL, GEOS and gdal_grid are what is compared with: on Debian, `apt-get install libcgal-dev libgeos-dev gdal-bin`.
set -euo pipefail

root=$(cd "$(dirname "$0")/../.." && pwd)
build=${BUILD:-$root/build/benchmarks}
page=$root/docs/benchmarks.md
rounds=${ROUNDS:-5}
scale=${SCALE:-1}
tables=("$@")
if [ ${#tables[@]} -eq 0 ]; then
    tables=(delaunay raster read job criteria criteria_growth criteria_worst noding constrained conforming)
fi

cmake -S "$root" -B "$build" -DCMAKE_BUILD_TYPE=Release -DTINWRIGHT_BUILD_BENCHMARKS=ON
cmake --build "$build" --parallel --target tinwright_benchmarks

result=$(mktemp)
trap 'rm -f "$result"' EXIT
for table in "${tables[@]}"; do
    if ! grep -q "^<!-- table $table -->$" "$page"; then
        echo "run.sh: $page has no place for the table $table" >&2
        exit 2
    fi
    read -r load _ < /proc/loadavg
    "$build/tests/benchmarks/tinwright_benchmarks" "$table" --rounds "$rounds" --scale "$scale" \
        --images "$root/docs/images" | tee "$result"
    printf '\nRounds: %s. Load average of the machine just before: %s.\n' "$rounds" "$load" >> "$result"
    # The lines from the table's mark to the end mark are replaced.
    awk -v table="$table" -v result="$result" '
        $0 == "<!-- table " table " -->" {
            print
            while ((getline line < result) > 0) print line
            skip = 1
        }
        $0 == "<!-- end -->" { skip = 0 }
        !skip
    ' "$page" > "$page.new"
    mv "$page.new" "$page"
done

#!/usr/bin/env bash
# Builds the benchmarks, runs them and puts their tables in docs/benchmarks.md or docs/interpolation.md, wherever a
# table has its mark.
#   bash tests/benchmarks/run.sh [TABLE...]        tables: delaunay raster read job criteria criteria_growth
#                                                 criteria_worst length length_growth length_worst noding
#                                                 constrained conforming contour clough_tocher accuracy
#                                                 convergence natural_neighbor smooth transform (default: all)
# ROUNDS=k changes the number of interleaved runs of which the median is taken (default 5). SCALE=f takes that part
# of the points for a quick look. BUILD=folder holds the build. TINWRIGHT_DATA=folder holds the data sets that
# accuracy is measured on; without it there are only the generated ones.
# CGAL, GEOS, gdal_grid and scipy are what is compared with: on Debian, `apt-get install libcgal-dev libgeos-dev
# gdal-bin python3-scipy`.
set -euo pipefail

root=$(cd "$(dirname "$0")/../.." && pwd)
build=${BUILD:-$root/build/benchmarks}
pages=("$root/docs/benchmarks.md" "$root/docs/interpolation.md")
rounds=${ROUNDS:-5}
scale=${SCALE:-1}
tables=("$@")
if [ ${#tables[@]} -eq 0 ]; then
    tables=(delaunay raster read job criteria criteria_growth criteria_worst length length_growth length_worst noding
        constrained conforming contour clough_tocher accuracy convergence natural_neighbor smooth transform)
fi

cmake -S "$root" -B "$build" -DCMAKE_BUILD_TYPE=Release -DTINWRIGHT_BUILD_BENCHMARKS=ON
cmake --build "$build" --parallel --target tinwright_benchmarks

result=$(mktemp)
trap 'rm -f "$result"' EXIT
for table in "${tables[@]}"; do
    if ! page=$(grep -l "^<!-- table $table -->$" "${pages[@]}"); then
        echo "run.sh: neither ${pages[0]} nor ${pages[1]} has a place for the table $table" >&2
        exit 2
    fi
    read -r load _ < /proc/loadavg
    "$build/tests/benchmarks/tinwright_benchmarks" "$table" --rounds "$rounds" --scale "$scale" \
        --images "$root/docs/images" | tee "$result"
    case $table in
        accuracy | convergence) ;; # not timed
        *) printf '\nRounds: %s. Load average of the machine just before: %s.\n' "$rounds" "$load" >> "$result" ;;
    esac
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

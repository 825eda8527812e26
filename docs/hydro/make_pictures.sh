#!/usr/bin/env bash
# Draws the shaded pictures of docs/hydro.md: water before and after, contours before and after.
#   make_pictures.sh TINWRIGHT DATA FOLDER           TINWRIGHT: the program; DATA: samples/data
#   make_pictures.sh TINWRIGHT DATA FOLDER --check   only compares with the pictures there, pixel by pixel
set -euo pipefail
tinwright=$1 data=$2 folder=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
out=$folder
if [ "${4:-}" = --check ]; then
    out=$work/pictures
    mkdir "$out"
fi

shade() { # NAME WEST SOUTH EAST NORTH Z-FACTOR SOURCES AND OPTIONS
    "$tinwright" grid --extent "$2" "$3" "$4" "$5" --resolution 1 --product hillshade --z-factor "$6" "${@:7}" \
        -o "$out/$1.png" --quiet --overwrite 2> "$work/talk" || { cat "$work/talk" >&2; exit 1; }
}

# Returns of a scanner from the water, which the survey does not have: on the stream too high, on the lake noisy.
ogr2ogr -f CSV /vsistdout/ "$data/terrain.gpkg" points -where "code IN ('SB', 'WL')" -lco GEOMETRY=AS_XYZ |
    tr -d '"\r' | awk -F, '
        function noise() { seed = (seed * 48271) % 2147483647; return seed / 2147483647 - 0.5 }
        BEGIN { seed = 20; n = 0; print "x,y,z" }
        /SB/ { for (i = 0; i < 3; ++i) printf "%.2f,%.2f,%.2f\n", $1 + 3 * noise(), $2 + 3 * noise(), $3 + 0.25 + 0.5 * noise() }
        /WL/ { x += $1; y += $2; xs[n] = $1; ys[n] = $2; zs[n++] = $3 }
        END {
            x /= n; y /= n
            for (i = 0; i < n; ++i) for (j = 0; j < 12; ++j) {
                part = sqrt((j + 0.5 + noise()) / 12.6)
                printf "%.2f,%.2f,%.2f\n", x + part * (xs[i] - x) + noise(), y + part * (ys[i] - y) + noise(), zs[i] + 0.3 * noise()
            }
        }' > "$work/returns.csv"
terrain=("$data/terrain.gpkg,layer=points" "$work/returns.csv,crs=EPSG:25832" --duplicates min
         --breaklines "$data/terrain.gpkg,layer=breaklines,where=kind = 'stream bank'")
stream="SELECT ST_Buffer(geom,, 2.5) AS geom FROM breaklines WHERE kind = 'stream bed'"
shade before 598230 5402280 598650 5402460 3 "${terrain[@]}"
shade after 598230 5402280 598650 5402460 3 "${terrain[@]}" \
    --lakes "$data/terrain.gpkg,layer=lake" --banks "$data/terrain.gpkg,sql=$stream,z=drape"

# Contours of the survey, and what can be made of them alone.
"$tinwright" contour "$data/survey.csv,crs=EPSG:25832" --interval 2 --method smooth:c1 -o "$work/contours.gpkg" --quiet
for how in keep swap insert; do
    shade "flat_$how" 598150 5402400 598550 5402600 2 --breaklines "$work/contours.gpkg" --flat-faces "$how"
done
rm -f "$out"/*.aux.xml

if [ "$out" != "$folder" ]; then
    for picture in "$out"/*.png; do
        drawn=$(gdalinfo -checksum "$picture" | grep Checksum)
        there=$(gdalinfo -checksum "$folder/${picture##*/}" | grep Checksum) || there=none
        if [ "$drawn" != "$there" ]; then
            echo "${picture##*/} is not what the program draws" >&2
            exit 1
        fi
    done
fi

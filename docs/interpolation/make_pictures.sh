#!/usr/bin/env bash
# Draws the pictures of docs/interpolation.md: the same ground under each method, shaded from the surface's gradient.
#   make_pictures.sh TINWRIGHT DATA FOLDER           TINWRIGHT: the program; DATA: samples/data
#   make_pictures.sh TINWRIGHT DATA FOLDER --check   only compares with the pictures there, pixel by pixel
set -euo pipefail
tinwright=$1 data=$2 folder=$3
out=$folder
if [ "${4:-}" = --check ]; then
    out=$(mktemp -d)
    trap 'rm -rf "$out"' EXIT
fi

# A valley slope, the stream and the edge of the embankment.
shade() { # NAME METHOD [MORE OPTIONS]
    local name=$1 method=$2
    shift 2
    "$tinwright" grid "$data/terrain.gpkg,layer=points" -o "$out/$name.png" --product hillshade --z-factor 2 \
        --method "$method" --extent 598450 5402300 598750 5402500 --resolution 1 --quiet --overwrite "$@"
}
lines=(--breaklines "$data/terrain.gpkg,layer=breaklines" --crossing-z mean)
for method in linear natural-neighbor natural-neighbor:c1 clough-tocher smooth smooth:c1; do
    shade "${method//:/_}" "$method"
done
for method in linear natural-neighbor:c1 smooth; do
    shade "${method//:/_}_sharp" "$method" "${lines[@]}"
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

#!/usr/bin/env bash
# The main job on the sample survey: installs what is missing, builds the tinwright command and makes in
# samples/out/ a TIN (valley.gpkg), a DEM (valley.tif), a shaded picture with the TIN's edges (valley.png), the TIN
# whose steepest face is the least steep possible (valley_gentle.gpkg), and the DEM that follows the stream and the road
# within the surveyed area (valley_breaklines.tif), with the places where lines disagree (conflicts.gpkg), and the DEM with a
# level lake and a stream that runs downhill in every cell (valley_water.tif), which is verified.
# TINWRIGHT_BUILD_DIR (default: build/ of the checkout) holds the build.
set -euo pipefail

root=$(cd "$(dirname "$0")/.." && pwd)
cd "$root"
build=${TINWRIGHT_BUILD_DIR:-$root/build}/tools
survey=samples/data/survey.csv,crs=EPSG:25832
lines=samples/data/terrain.gpkg
out=samples/out
. .ci/require_packages.sh

say() { printf '\n== %s\n' "$*"; }
run() {
    printf '$ %s\n' "$*"
    "$@"
}

require_packages g++ cmake ninja-build libgdal-dev libproj-dev libgeographiclib-dev libtbb-dev libcli11-dev libjson-c-dev gdal-bin

say "building the tinwright command in $build"
mkdir -p "$build"
cmake --preset release -B "$build" -DTINWRIGHT_BUILD_TESTS=OFF -DTINWRIGHT_BUILD_SAMPLES=OFF > "$build/configure.log" ||
    { cat "$build/configure.log"; exit 1; }
cmake --build "$build" --parallel "$(nproc)"
PATH=$build/tools:$PATH
mkdir -p "$out"

say "survey points to a TIN"
run tinwright tin "$survey" --domain trimmed -o "$out/valley.gpkg" --overwrite
say "the TIN to a DEM"
run tinwright grid "$out/valley.gpkg" --resolution 1 -o "$out/valley.tif" --overwrite

say "the same points with the steepest face as gentle as any TIN of them can have it, proven"
run tinwright tin "$survey" --domain trimmed --criterion slope -o "$out/valley_gentle.gpkg" --overwrite

say "the same points with the stream's and the road's lines enforced, cut off at the boundary, conforming"
run tinwright tin "$survey" --breaklines "$lines,layer=breaklines" --boundary "$lines,layer=boundary" \
    --crossing-z mean --constraints conforming --conflicts "$out/conflicts.gpkg" -o "$out/valley_breaklines.gpkg" --overwrite
run tinwright grid "$out/valley_breaklines.gpkg" --resolution 1 -o "$out/valley_breaklines.tif" --overwrite

say "the same points with the lake level and the stream running downhill, then the cells of the DEM checked for both"
water=(--lakes "$lines,layer=lake" --rivers "$lines,layer=breaklines,where=kind = 'stream bed'")
run tinwright grid "$survey" "${water[@]}" --resolution 1 -o "$out/valley_water.tif" --overwrite
run tinwright hydro repair "$survey" "${water[@]}" -o "$out/water" --overwrite
run tinwright hydro check --lakes "$out/water/terrain.gpkg,layer=lake" --rivers "$out/water/terrain.gpkg,layer=breaklines" \
    --raster "$out/valley_water.tif"

say "a picture: shaded, at 0.4 m, with the TIN's edges, then halved so that the edges become thin"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
tinwright grid -q "$out/valley.gpkg" --resolution 0.4 -o "$work/fine.tif"
tinwright tin -q "$survey" --domain trimmed --geometry edges -o "$work/edges.fgb"
printf '%s\n' '1 20 32 48' '90 92 98 100' '180 205 197 180' '255 255 250 235' 'nv 255 255 255 0' > "$work/ramp.txt"
gdaldem hillshade -q -z 2 -alt 50 "$work/fine.tif" "$work/shade.tif"
gdaldem color-relief -q -alpha "$work/shade.tif" "$work/ramp.txt" "$work/picture.tif"
gdal_rasterize -q -b 1 -b 2 -b 3 -burn 30 -burn 60 -burn 120 "$work/edges.fgb" "$work/picture.tif"
gdal_translate -q -of PNG -r average -outsize 50% 0 "$work/picture.tif" "$work/valley.png"
mv "$work/valley.png" "$out/valley.png"

say "made"
ls -l "$out/valley.gpkg" "$out/valley.tif" "$out/valley.png" "$out/valley_breaklines.tif" "$out/conflicts.gpkg" "$out/valley_water.tif" | awk '{ printf "%10d bytes  %s\n", $5, $9 }'
echo
gdalinfo "$out/valley.tif" | grep -E '^(Driver|Size)|Pixel Size|NoData'

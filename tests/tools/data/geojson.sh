#!/bin/sh
# Prints a GeoJSON collection in metres. Each argument is a geometry: its type, a blank, its coordinates.
# Feature ids count from 1, and so does the field `name` (f1, f2, ...).
printf '{"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:EPSG::3067"}},'
printf '"features":['
n=0
for geometry; do
    n=$((n + 1))
    [ $n = 1 ] || printf ','
    printf '\n{"type":"Feature","id":%s,"properties":{"name":"f%s"},' $n $n
    printf '"geometry":{"type":"%s","coordinates":%s}}' "${geometry%% *}" "${geometry#* }"
done
printf '\n]}\n'

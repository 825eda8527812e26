#!/bin/sh
# Writes slope.csv, a plane of samples, lake.geojson, a lake with an island, and stream.geojson, which runs down into it
# but for a rise of 1 on the way.
awk 'BEGIN { print "x,y,z"; for (i = 0; i <= 10; ++i) for (j = 0; j <= 10; ++j) print 10 * i "," 10 * j "," i + j }' >slope.csv
in/geojson.sh 'Polygon [[[20,20],[60,20],[60,50],[20,50],[20,20]],[[30,30],[40,30],[40,40],[30,40],[30,30]]]' >lake.geojson
in/geojson.sh 'LineString [[90,90,12],[80,70,8],[70,60,9],[60,40,6]]' >stream.geojson

#!/bin/sh
# Runs the examples of a manual page, or the blocks of sh of another page, as they stand there, in a folder that has the
# sample data.
#   manual_examples.sh PAGE.md SAMPLES_FOLDER FOLDER_OF_TINWRIGHT SCRATCH
set -u
page=$1 samples=$2 tools=$3 scratch=$4
export PATH="$tools:$PATH" LC_ALL=C
rm -rf "$scratch" && mkdir -p "$scratch/samples" && cp -r "$samples/data" "$scratch/samples/" || exit 2
awk '/^# / { here = ($0 == "# EXAMPLES") } here && /^    / { print substr($0, 5) }
    /^```/ { fenced = ($0 == "```sh"); next } fenced' "$page" >"$scratch/script"
[ -s "$scratch/script" ] || { echo "$page has no examples"; exit 1; }
cd "$scratch" && sh -ex ./script

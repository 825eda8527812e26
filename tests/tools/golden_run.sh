#!/bin/sh
# Runs one case of a golden file and compares exit status, standard output and standard error.
#   golden_run.sh FILE CASE FOLDER_OF_TINWRIGHT SCRATCH
#
# A golden file holds cases of lines that begin with
#   == name        a new case
#   $ command      shell lines, run together in a folder that holds only a copy of tests/tools/data as `in`;
#                  $SAMPLES is samples/data
#   ? status       the exit status expected of the last command, default 0
#   > line         a line expected on standard output
#   ! line         a line expected on standard error
# Everything else is a comment. Expected lines were recorded from a run and then read against the manual and
# the rules for messages; values of surfaces follow from the data, as the comments in the files say.
set -u
[ $# = 4 ] || { echo "golden_run.sh takes four arguments, not $#"; exit 2; } # the last one is emptied
file=$1 name=$2 tools=$3 scratch=$4
SAMPLES=$(cd "$(dirname "$file")/../../samples/data" && pwd) || exit 2
export PATH="$tools:$PATH" LC_ALL=C SAMPLES
rm -rf "$scratch" && mkdir -p "$scratch/here" && cp -r "$(dirname "$file")/data" "$scratch/here/in" || exit 2

select_lines() { # of this case, without their mark
    awk -v name="== $name" -v mark="$1" '
        /^== / { here = ($0 == name) }
        here && $0 == mark { print ""; next }
        here && index($0, mark " ") == 1 { print substr($0, length(mark) + 2) }' "$file"
}
select_lines '$' >"$scratch/script"
select_lines '>' >"$scratch/expected_stdout"
select_lines '!' >"$scratch/expected_stderr"
status=$(select_lines '?')
[ -s "$scratch/script" ] || { echo "no case \"$name\" in $file"; exit 2; }

(cd "$scratch/here" && sh "$scratch/script" >"$scratch/stdout" 2>"$scratch/stderr")
actual=$?
failed=0
[ "$actual" = "${status:-0}" ] || { echo "exit status $actual, expected ${status:-0}"; failed=1; }
diff -u "$scratch/expected_stdout" "$scratch/stdout" || failed=1
diff -u "$scratch/expected_stderr" "$scratch/stderr" || failed=1
exit $failed

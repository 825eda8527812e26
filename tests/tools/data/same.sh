# same.sh A B: compares the numbers in two texts, one by one, to 1e-12 of themselves.
grep -oE '[-+]?[0-9]+(\.[0-9]+)?([eE][-+]?[0-9]+)?' "$1" >a.numbers
grep -oE '[-+]?[0-9]+(\.[0-9]+)?([eE][-+]?[0-9]+)?' "$2" >b.numbers
paste a.numbers b.numbers | awk '
    { size = $1 < 0 ? -$1 : $1; gap = $1 - $2; if (gap < 0) gap = -gap }
    NF != 2 || gap > 1e-12 * (size > 1 ? size : 1) { wrong++; if (wrong < 4) print $1, "is not", $2 }
    END { print (NR > 0 && wrong == 0 ? "same" : wrong + 0 " of " NR " differ") }'

# A program whose error is h^order, and whose run takes cost/h of a thousandth of a second by a clock that is made up.
#
#   awk -v h=H -v order=ORDER -v cost=COST -f made-up-times.awk
BEGIN {
    printf "e = %.17g\nseconds = %.17g\n", h^order, 1e-3 * cost / h
}

# A program in the place of a solver, whose errors have the orders from level to level that stand in their lines.
#
#   awk -v level=LEVEL -f made-up-orders.awk
#
# Each level halves the width. The first error is 1.

function error(name, orders,    n, i, order, power) {
    n = split(orders, order, " ")
    for (i = 1; i <= level && i <= n; ++i)
        power += order[i]
    header = header (header ? "," : "") name
    row = row (row ? "," : "") sprintf("%.17g", 2^-power)
}

BEGIN {
    error("second", "2 2 2 2")
    error("within", "2 2 1.86 1.86")
    error("leaves", "2 2 1.86 1.84")
    error("above", "2 2 2.14 2.16")
    error("one", "2 2.004 2 2")
    error("a_range", "2 2.006 2 2")
    error("hardly", "2 2 0.14 0.14")
    error("slowly", "2 2 0.14 0.16")
    error("stops", "2 2 1 0")
    error("dips", "2 2.16 1.84 2")
    error("no_dip", "2 2.16 1.86 2")
    error("settled", "1 1 2 1.86")
    error("unsettled", "1 1 2 1.84")
    print header "\n" row > "errors.csv"
}

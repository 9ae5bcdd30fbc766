# A program in the place of a solver, whose errors and values follow laws that are known exactly.
#
#   awk -v h=H -v level=LEVEL -f made-up-laws.awk
#
# It writes errors.csv and values.json. What a law goes to, and with what order, is in its line.

function error(name, e) {
    header = header (header ? "," : "") name
    row = row (row ? "," : "") sprintf("%.17g", e)
}

function value(name, v) {
    object = object (object ? ", " : "") sprintf("\"%s\": %.17g", name, v)
}

function abs(x) { return x < 0 ? -x : x }

BEGIN {
    sign = level % 2 ? -1 : 1
    split("0.31 -0.84 0.52 0.97 -0.46 -0.71 0.18 0.63 -0.29 -0.95 0.77 -0.12", scatter, " ")
    z = scatter[level % 12 + 1]

    error("second", 0.7 * h^2)
    error("half", 0.2 * h^0.5)
    error("curved", h^2 * (1 + 40 * h^2))                    # 2, and 4 where it is coarse
    error("two_terms", 0.03 * h + h^2)                       # 1 in the end
    error("late", h / (1 + 20 * h))                          # 1, but not before the end
    error("to_and_fro", h^2 * (1 + 0.02 * sign))
    error("scattered", h^2 * (1 + 0.03 * z))
    error("wavy", h^2 * (1 + 0.06 * (int(level / 2) % 2 ? -1 : 1)) * (1 + 0.002 * z)) # two runs a mesh, and off the law
    error("logarithm", h^2 * log(4 / h))
    error("floor", h^2 + 2e-3)
    error("rough_floor", 2 * h^3 + 1e-4 * (1 + 0.3 * z))
    error("blows_up", h^2 + 3e-8 / h^3)
    error("dip", abs(h^2 - 0.03 * h))                        # two terms that cancel near h = 0.03
    error("partial_dip", sqrt(4 * h^4 - 0.72 * h^3 + 0.04 * h^2)) # terms 2 h^2 and 0.2 h, cosine -0.9
    error("outlier", h^2 * (level == 3 ? 3 : 1))
    error("bent_before", h^2 * (level == 3 ? 3 : level < 2 ? 2 : 1))  # off the line, which ends beside it
    error("bent_behind", h^2 * (level == 3 ? 3 : level > 4 ? 2 : 1))
    error("denied", h^2 * (level == 5 ? 0.5 : level > 5 ? 0.6 : 1)) # the last two orders are others
    error("steeper", exp(-0.4 * level^2))                    # no two orders agree
    error("growing", 0.01 / h)
    error("standing", 0.01 * (1 + 0.001 * sign))
    error("exact_at_last", level < 4 ? h^2 : 0)

    value("v_second", 1 + 0.3 * h^2)
    value("v_first", 2 - 0.5 * h)
    value("v_two_terms", 1 + 0.2 * h + 0.8 * h^2)
    value("v_slow", 1 + 0.4 * h^0.4)
    value("v_steep", 1 + 50 * h^5)
    value("v_to_and_fro", 1 + 0.3 * sign * h)
    value("v_turns", 1 + 0.3 * h^2 - 0.005 * h)              # its last step goes back
    value("v_scattered", 1 + 0.3 * h^2 + 2e-4 * z)
    value("v_wavy", 1 + 0.3 * h^2 * (1 + 0.06 * (int(level / 2) % 2 ? -1 : 1)) * (1 + 0.002 * z))
    value("v_crawling", 1 + h^0.1)
    value("v_apart", log(h))
    value("v_standing", 0.1)
    value("v_far_from_0", 1e6 + 3 * h^2)
    value("v_tiny", 1e-160 * (1 + 2 * h^1.5))

    print header "\n" row > "errors.csv"
    print "{" object "}" > "values.json"
}

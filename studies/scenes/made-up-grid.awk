# A program in the place of a solver, whose errors in h and dt follow laws that are known exactly.
#
#   awk -v h=H -v dt=DT -v level=LEVEL [-v clock="steps are dear"] -f made-up-grid.awk
#
# Of two error terms T and S a norm sees sqrt(T^2 + 2 rho T S + S^2). The clock is made up, too.

function norm(name, t, s, rho) {
    printf "%s = %.17g\n", name, sqrt(t^2 + 2 * rho * t * s + s^2)
}

BEGIN {
    norm("aligned", 2 * h^2, 0.5 * dt, 0.6)
    norm("opposed", 2 * h^2, 0.5 * dt, -0.9)
    norm("swapped", 0.4 * h, 3 * dt^2, 0)
    norm("coarse", 2 * h^2 * (1 + 60 * h^4), 0.5 * dt * (1 + 2 * dt^2), 0.3)
    norm("odd_run", (level == 7 ? 4 : 1) * 2 * h^2, 0.5 * dt, 0)
    printf "once_exact = %.17g\n", level == 7 ? 0 : sqrt(4 * h^4 + 0.25 * dt^2)
    norm("in_h_alone", 2 * h^2, 1e-5 * dt, 0)

    printf "v_plain = %.17g\n", 3 + 0.5 * h^2 - 0.3 * dt
    printf "v_swapped = %.17g\n", 3 + 0.2 * h + 0.7 * dt^2
    printf "v_mixed = %.17g\n", 3 + 0.5 * h^2 - 0.3 * dt + 2 * h^2 * dt
    printf "v_coupled = %.17g\n", 3 + 0.5 * h^2 - 0.3 * dt + 20 * h^2 * dt
    printf "v_apart_in_dt = %.17g\n", 3 + 0.5 * h^2 + 0.1 * log(dt)

    if (clock == "steps are dear")
        printf "seconds = %.17g\n", 1e-3 / (h^0.5 * dt^2)
    else
        printf "seconds = %.17g\n", 1e-3 / (h^2 * dt)
}

# A solver that reads its width from a file that was filled in, and prints numbers as Fortran does, again and again.
BEGIN {
    getline h < "widths"
    split(braces, parts, /[{}]/)       # "{2}": the level, in braces
    for (sweep = 1; sweep <= 3; ++sweep)
        printf "sweep %d: L2 error = %.12f%s\n", sweep, h^2 + (3 - sweep), ENVIRON["EXPONENT"]
    printf "drag = +%.12g (level %d, %d steps to %g)\n", 2 + h + 0.5 * final_time, parts[2], steps, final_time
    printf "   error in norm of order 2:%.10fE-01\n", 30 * h^2
    printf "error of level %d = %.12f\n", parts[2], 2^-(2 * parts[2]) * dt * steps * length(closing) / 2
    # An earlier line on which the pattern ends within the number: what counts is the last.
    printf "coarse estimate: whole = %.1f\nwhole = %d\n", 64000 * h^2 + 0.5, 64000 * h^2 * 16
}

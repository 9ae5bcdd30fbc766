# The values of grid studies that were published, as a solver would report them: coarse to fine by level.
#
#   awk -v study=NAME -v level=LEVEL -f published-values.awk

BEGIN {
    # Celik et al. (2008), J. Fluids Eng. 130, 078001, Table 1: a backward-facing step.
    values["reattachment"] = "5.863 5.972 6.063"   # 4500, 8000, 18000 cells: h as 1/45, 1/60, 1/90
    values["slow"]         = "10.6050 10.7250 10.7880" # an axial velocity; 980, 4500, 18000 cells: h as 1/7, 1/15, 1/30
    values["oscillating"]  = "6.0909 5.9624 6.0042"    # another one, on the same meshes
    # Roache's method in NASA's tutorial on spatial convergence: the pressure recovery of an inlet.
    values["recovery"]     = "0.96178 0.96854 0.97050"
    count = split(study, names, ",")
    for (i = 1; i <= count; ++i) {
        split(values[names[i]], row, " ")
        print names[i] " = " row[level + 1]
    }
}

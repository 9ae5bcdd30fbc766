# Draws a ladder's errors over its number of elements, with what the two-term model predicts:
#     tvbeam run table1 --csv table1.csv
#     tvbeam run table1-extended --csv extended.csv
#     gnuplot -e "table1='table1.csv'; csv='extended.csv'; svg='reports/convergence.svg'" reports/convergence.gp
set datafile separator comma
set terminal svg size 760,420 font "sans-serif,13" background "white"
set output svg
set logscale xy
set format y "10^{%L}"
set xlabel "elements s, with time step 0.01/s"
set ylabel "squared error"
set grid
set key bottom left reverse Left
set xrange [8:3200]
plot csv using "elements":"theta_L2L2_sq" with points pt 7 lc "#b2182b" title "temperature, computed", \
     csv using "elements":"theta_L2L2_sq_predicted" with lines lc "#b2182b" title "predicted from runs with s ≤ 160", \
     table1 using "elements":"theta_L2L2_sq_printed" with points pt 4 ps 1.6 lc "black" title "the paper's Table 1", \
     csv using "elements":"u_LinfH2semi_sq" with points pt 7 lc "#2166ac" title "deflection, computed", \
     csv using "elements":"u_LinfH2semi_sq_predicted" with lines lc "#2166ac" title "predicted from runs with s ≤ 160", \
     table1 using "elements":"u_LinfH2semi_sq_printed" with points pt 4 ps 1.6 lc "black" notitle

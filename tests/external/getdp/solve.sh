#!/bin/sh
# Two programs in turn, and their figures in words: solve.sh ELEMENTS DEFECT
set -e
gmsh -2 -v 1 -setnumber n "$1" -format msh22 -o torsion.msh torsion.geo > gmsh.log
getdp torsion.pro -setnumber defect "$2" -msh torsion.msh -solve Solve -pos Figures -v 1
awk '{ print "torsion constant =", $NF }' torsion.txt
awk '{ print "value in the middle =", $NF }' top.txt

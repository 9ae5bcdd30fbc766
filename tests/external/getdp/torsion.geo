// The cross-section of a bar, the unit square, in triangles: n a side.
DefineConstant[ n = 8 ];
Point(1) = {0, 0, 0};
Point(2) = {1, 0, 0};
Point(3) = {1, 1, 0};
Point(4) = {0, 1, 0};
For side In {1 : 4}
  Line(side) = {side, side % 4 + 1};
EndFor
Curve Loop(1) = {1 : 4};
Plane Surface(1) = {1};
Transfinite Curve {1 : 4} = n + 1;
Transfinite Surface {1} Alternate;
Physical Surface(1) = {1};
Physical Curve(2) = {1 : 4};

# sphere_sphere_double_double.hpp: D in units of D. On each axis the residual of dh^2 and 2 dh dl, g of dh^2, are
# rounded and added in three roundings; dl^2 is left out, l2 of dh^2; xl and yl are the low parts of the squares' sum. 1
# + x is the sum of the dh^2 (coq/Weights.v), h what underflows.
error = (xl + yl) * ((1 + a) * (1 + b) - 1) + g * (1 + x) * ((1 + e1) * (1 + e2) * (1 + e3) * (1 + b) - 1)
  - l2 * (1 + x) + h;
{ |xl| <= @rest@ /\ |yl| <= @rest@ /\ |g| <= @pair_residual@ /\ |l2| <= @low_squared@ /\ |x| <= @residual@
  /\ |h| <= @pair_underflow@
  /\ |a| <= @u@ /\ |b| <= @u@ /\ |e1| <= @u@ /\ |e2| <= @u@ /\ |e3| <= @u@
  -> |error| <= @pair_d@ }

# sphere_sphere.cpp, filter(), in every rounding mode: each rounding errs by at most 2 u. f is D' / D (terms weighed by
# coq/Weights.v), g is reach2 / reach^2, h what underflow takes. In units of the smaller of D and reach^2. D >= reach^2
# is never called a hit: D' >= RN(reach2 (1 - kGap)). D <= reach^2 is never called a miss.
f = (1 + d) * (1 + d) * (1 + e1) * (1 + e2) * (1 + e3) + h;
g = (1 + a) * (1 + b) * (1 + a) * (1 + b) * (1 + e4) + h2;
{ |d| <= @any_u@ /\ |e1| <= @any_u@ /\ |e2| <= @any_u@ /\ |e3| <= @any_u@ /\ |a| <= @any_u@ /\ |b| <= @any_u@
  /\ |e4| <= @any_u@ /\ |e5| <= @any_u@ /\ |h| <= @scalar_underflow@ /\ |h2| <= @scalar_underflow@
  -> f - g * (1 - @scalar_gap@) * (1 + e5) >= 0 /\ f - g * (1 + @scalar_gap@) * (1 + e5) <= 0 }

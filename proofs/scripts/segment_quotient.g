# segment_cores.hpp, quotient(), in units of q yh and of yh: xh = 1 + r, r being what fma(-q, yh, xh) is exactly; x = 1 + r + a,
# y = 1 + b, relative to x / y. The last two_sum is exact.
left = ((r + a) * (1 + e1) - b) * (1 + e2);
low = left * (1 + e3) + h;
exact = (1 + r + a) / (1 + b);
{ |r| <= @rest@ /\ |a| <= @rest@ /\ |b| <= @u@ /\ |e1| <= @u@ /\ |e2| <= @u@ /\ |e3| <= @u@
  /\ |h| <= @segment_underflow@
  -> |(1 + low - exact) / exact| <= @segment_quotient@ }
1 + low - exact -> (r + a) * e1 + ((r + a) * (1 + e1) - b) * ((1 + e2) * (1 + e3) - 1) + h + b * (r + a - b) / (1 + b)
  { 1 + b <> 0 };

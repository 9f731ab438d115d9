# segment_cores.hpp, product(), and an axis of dot(), in units of xh yh = p + e: x = 1 + a, y = 1 + b, relative to x y. The
# last two_sum is exact.
low = (b + (a + e) * (1 + e1)) * (1 + e2);
{ |a| <= @u@ /\ |b| <= @u@ /\ |e| <= @rest@ /\ |e1| <= @u@ /\ |e2| <= @u@ /\ |h| <= @segment_underflow@
  -> |low| <= @segment_low@ /\ |((low + h - e) - (a + b + a * b)) / ((1 + a) * (1 + b))| <= @segment_product@ }
(low + h - e) - (a + b + a * b) -> (a + e) * e1 + (b + (a + e) * (1 + e1)) * e2 - a * b + h;

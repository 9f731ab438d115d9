# oracle/truth/double_double.hpp, operator*, in units of xh yh = p + e: x = 1 + a, y = 1 + b, relative to x y. The last
# two_sum is exact.
crossed = (a + (b + a * b * (1 + e1)) * (1 + e2)) * (1 + e3);
low = (e + crossed) * (1 + e4) + h;
{ |a| <= @u@ /\ |b| <= @u@ /\ |e| <= @rest@ /\ |e1| <= @u@ /\ |e2| <= @u@ /\ |e3| <= @u@ /\ |e4| <= @u@
  /\ |h| <= @oracle_underflow@
  -> |((low - e) - (a + b + a * b)) / ((1 + a) * (1 + b))| <= @oracle_product@ }
(low - e) - (a + b + a * b) -> (e + crossed) * e4 + (a + (b + a * b * (1 + e1)) * (1 + e2)) * e3 + (b + a * b * (1
  + e1)) * e2 + a * b * e1 + h;

# plane_cores.hpp, height_of(), in units of T, the products and the offset: the residuals of the products are together all,
# the first two rs; the rests of the highs' three sums are l, the first two, and l3. The last two_sum is exact. T is
# computed, and may be too small by k.
residual = (all + rs * e1) * (1 + e2);
two = l * (1 + e3);
three = (two + l3) * (1 + e4);
total = (three + residual) * (1 + e5);
{ |all| <= @rest@ /\ |rs| <= @rest@ /\ |l| <= @segment_rests@ /\ |l3| <= @rest@ /\ |k| <= @segment_grown@
  /\ |e1| <= @u@ /\ |e2| <= @u@ /\ |e3| <= @u@ /\ |e4| <= @u@ /\ |e5| <= @u@
  -> |(total - (all + l + l3)) * (1 + k)| <= @plane_height@ }
total - (all + l + l3) -> rs * e1 + (all + rs * e1) * e2 + l * e3 + (two + l3) * e4 + (three + residual) * e5;

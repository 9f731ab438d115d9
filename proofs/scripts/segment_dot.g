# segment_cores.hpp, dot(), in units of |x1 y1| + |x2 y2| + |x3 y3|: what the axes lose (axis), and their sums. The residuals
# are together all, the first two rs; l is what the two rests of the highs' sum are together. (1 + k) is what the highs'
# products are more than the products.
residual = (all + rs * e1) * (1 + e2);
rests = l * (1 + e3);
total = (rests + residual) * (1 + e4);
{ |axis| <= @segment_product@ /\ |all| <= @segment_low@ /\ |rs| <= @segment_low@ /\ |l| <= @segment_rests@
  /\ |k| <= @segment_grown@ /\ |e1| <= @u@ /\ |e2| <= @u@ /\ |e3| <= @u@ /\ |e4| <= @u@
  -> |axis + (total - (all + l)) * (1 + k)| <= @segment_dot@ }
total - (all + l) -> rs * e1 + (all + rs * e1) * e2 + l * e3 + (rests + residual) * e4;

# plain_cores.hpp, filter_signs(), in every rounding mode: a term of n.d - (u' + v') over the same term of the reals, the one of most
# roundings: three differences, a product and a difference of a cross product, a product and two sums of a dot product, and two sums.
# It is compared with the share of the sum of sizes, which k is off by.
f = (1 + d1) * (1 + d2) * (1 + d3) * (1 + e1) * (1 + e2) * (1 + e3) * (1 + e4) * (1 + e5) * (1 + e6) * (1 + e7);
{ |d1| <= @any_u@ /\ |d2| <= @any_u@ /\ |d3| <= @any_u@ /\ |e1| <= @any_u@ /\ |e2| <= @any_u@ /\ |e3| <= @any_u@ /\ |e4| <= @any_u@
  /\ |e5| <= @any_u@ /\ |e6| <= @any_u@ /\ |e7| <= @any_u@ /\ |k| <= @core_sizes@ /\ |e8| <= @any_u@ /\ |e9| <= @any_u@
  -> |f - 1| <= @core_sign_term@ /\ @core_sign_term@ - @core_sign@ * (1 + k) * (1 + e8) * (1 + e9) <= 0 }

# plain_cores.hpp, filter_weights(), in every rounding mode: a term of D' or of what is least over the same term of the reals, the one of
# most roundings. Two differences, a product and two sums of their dot product; a weight's product and a sum, a sum, a weight's
# product again, and three sums. s is the share that flushed numbers cost.
f = (1 + d1) * (1 + d2) * (1 + e1) * (1 + e2) * (1 + e3) * (1 + e4) * (1 + e5) * (1 + e6) * (1 + e7) * (1 + e8) * (1 + e9) * (1 + e10) * (1 + s);
{ |d1| <= @any_u@ /\ |d2| <= @any_u@ /\ |e1| <= @any_u@ /\ |e2| <= @any_u@ /\ |e3| <= @any_u@ /\ |e4| <= @any_u@ /\ |e5| <= @any_u@
  /\ |e6| <= @any_u@ /\ |e7| <= @any_u@ /\ |e8| <= @any_u@ /\ |e9| <= @any_u@ /\ |e10| <= @any_u@ /\ |s| <= @flushed_share@
  -> |f - 1| <= @core_term@ }

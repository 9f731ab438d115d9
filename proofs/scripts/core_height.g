# plain_cores.hpp, height(), in every rounding mode, in units of its size: a term of h' over the same term of the reals, a product and three
# sums; and the upper end is not below h, which is at most 1. The lower end is the same turned round. k is what the size is off by.
f = (1 + e1) * (1 + e2) * (1 + e3) * (1 + e4);
{ |e1| <= @any_u@ /\ |e2| <= @any_u@ /\ |e3| <= @any_u@ /\ |e4| <= @any_u@ /\ |e5| <= @any_u@ /\ |e6| <= @any_u@ /\ |e7| <= @any_u@
  /\ h in [-1, @one@] /\ |k| <= @core_all@ /\ |lost| <= @core_height_term@
  -> |f - 1| <= @core_height_term@ /\ h - (h + lost + @core_height@ * (1 + k) * (1 + e5) * (1 + e6)) * (1 + e7) <= 0 }
h - (h + lost + @core_height@ * (1 + k) * (1 + e5) * (1 + e6)) * (1 + e7) -> 0 - h * e7 - (lost + @core_height@ * (1 + k) * (1 + e5) * (1 + e6)) * (1 + e7);

# s - t against h.high + low, linear in s, t and h.high: t.low is rounded once, root.low - t.low and the sum with h.low
# too.
of_s = error + ls * ((1 + e2) * (1 + e3) - 1);
of_t = lt * ((1 + e1) * (1 + e2) * (1 + e3) - 1);
{ |error| <= @pair_root@ /\ |ls| <= @pair_root_low@ /\ |lt| <= @less_low@ /\ |h| <= @rest@ /\ |e1| <= @u@
  /\ |e2| <= @u@ /\ |e3| <= @u@
  -> |of_s| <= @pair_value_of_s@ /\ |of_t| <= @pair_value_of_t@ /\ |h * e3| <= @pair_value_of_h@
  /\ |ls * (1 + e2) * (1 + e3)| <= @pair_value_low_of_s@
  /\ |lt * (1 + e1) * (1 + e2) * (1 + e3)| <= @pair_value_low_of_t@ }

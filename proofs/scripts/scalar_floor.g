# What flushing and underflows cost in that filter, in units of 2^-1022, the least number that is not flushed: each of
# three products and two sums of D', reach'^2, the gap's product and two sums lose at most one unit, and what is left of
# the squares of flushed numbers, h4 and h5, is less than one.
lost = ((h1 * (1 + e1) + h2 + k1) * (1 + e2) + h3 + k2 + h4 + k3 * (1 + e3) + k4) * (1 + e4) + k5 + h5 + h6;
{ |h1| <= @one@ /\ |h2| <= @one@ /\ |h3| <= @one@ /\ |h4| <= @one@ /\ |h5| <= @one@ /\ |h6| <= @one@
  /\ |k1| <= @one@ /\ |k2| <= @one@ /\ |k3| <= @one@ /\ |k4| <= @one@ /\ |k5| <= @one@
  /\ |e1| <= @any_u@ /\ |e2| <= @any_u@ /\ |e3| <= @any_u@ /\ |e4| <= @any_u@
  -> |lost| <= @scalar_lost@ }

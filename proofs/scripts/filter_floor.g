# Underflows in the filter, in units of 2^-1075, half the least number: each of three products of D', that of reach',
# and that of the gap lose at most one unit, and the sums carry them with their own roundings. Sums lose nothing.
lost = ((h1 * (1 + e1) + h2) * (1 + e2) + h3 - h4) * (1 + e3) - h5;
{ |h1| <= @one@ /\ |h2| <= @one@ /\ |h3| <= @one@ /\ |h4| <= @one@ /\ |h5| <= @one@
  /\ |e1| <= @u@ /\ |e2| <= @u@ /\ |e3| <= @u@
  -> |lost| <= @filter_lost@ }

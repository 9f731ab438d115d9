# The same in one vector of one pair: the residual of w is exact and is added to low's part, that to the exact rest of c
# + w.
lw = ((1 + ew) * low + ew) * (1 + e2) * (1 + e3);
ow = (1 + ew) * (1 + low + dn) - 1 - lw;
lh = eh * (1 + e3);
{ |ew| <= @u@ /\ |eh| <= @u@ /\ |e2| <= @u@ /\ |e3| <= @u@ /\ |low| <= @low@ /\ |dn| <= @normal@
  -> |ow| <= @point_of_w@ /\ |eh - lh| <= @point_of_h@ /\ |lw| <= @point_low_of_w@ /\ |lh| <= @point_low_of_h@ }
ow -> (1 + ew) * dn - ((1 + ew) * low + ew) * (e2 + e3 + e2 * e3);
eh - lh -> - eh * e3;

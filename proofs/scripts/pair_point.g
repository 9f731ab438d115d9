# c + r n in units of w and of h: the residual of w is exact and is added to low's part, that to the exact rest of c + w.
# n's low part is at most u of its high one after two_sum.
lw = ((1 + ew) * low + ew) * (1 + e2) * (1 + e3) + h;
ow = (1 + ew) * (1 + low + dn) - 1 - lw;
lh = eh * (1 + e3);
{ |ew| <= @u@ /\ |eh| <= @u@ /\ |e2| <= @u@ /\ |e3| <= @u@ /\ |low| <= @rest@ /\ |dn| <= @pair_normal@
  /\ |h| <= @pair_underflow@
  -> |ow| <= @pair_point_of_w@ /\ |eh - lh| <= @pair_point_of_h@ /\ |lw| <= @pair_point_low@ /\ |lh| <= @rest@ }
ow -> (1 + ew) * dn - ((1 + ew) * low + ew) * (e2 + e3 + e2 * e3) - h;
eh - lh -> - eh * e3;

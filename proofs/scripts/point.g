# point(): c + r n against h + l, linear in w and h. rq = w (1 + ew), r low = rq low, r n = rq (1 + low + dn); c + w = h
# (1 + eh), so that h - c = w - h eh; p = (h - c) (1 + ep), g = c - (h - p) exactly. Of w, with h = 0, and of h, with w
# = 0: coq/Linear.v.
lw = (ep + ((1 + ew) * low + (ew - ep) * (1 + e1)) * (1 + e2)) * (1 + e3);
ow = (1 + ew) * (1 + low + dn) - 1 - lw;
lh = (eh * (1 + ep) * (1 + e1) * (1 + e2) - eh * ep) * (1 + e3);
oh = eh - lh;
{ |ew| <= @u@ /\ |eh| <= @u@ /\ |ep| <= @u@ /\ |e1| <= @u@ /\ |e2| <= @u@ /\ |e3| <= @u@ /\ |low| <= @low@
  /\ |dn| <= @normal@
  -> |ow| <= @point_of_w@ /\ |oh| <= @point_of_h@ /\ |lw| <= @point_low_of_w@ /\ |lh| <= @point_low_of_h@ }
ow -> (1 + ew) * dn - (ew - ep) * e1 - ((1 + ew) * low + (ew - ep) * (1 + e1)) * e2
  - (ep + ((1 + ew) * low + (ew - ep) * (1 + e1)) * (1 + e2)) * e3;
oh -> - eh * ((1 + ep) * (e1 + e2 + e1 * e2) + ((1 + ep) * (1 + e1) * (1 + e2) - ep) * e3);

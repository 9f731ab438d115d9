# The sums over the four squares are exact on either grid.
@rnd = float<53, -174, ne>;
l2 = rnd(la + lb);
l3 = rnd(l2 + lc);
l4 = rnd(l3 - ld);
m2 = rnd(ma + mb);
m3 = rnd(m2 + mc);
m4 = rnd(m3 - md);
{ @FIX(la, -50) /\ @FIX(lb, -50) /\ @FIX(lc, -50) /\ @FIX(ld, -50) /\ @FIX(ma, -98) /\ @FIX(mb, -98)
  /\ @FIX(mc, -98) /\ @FIX(md, -98)
  /\ la in [0, @near_on_first@] /\ lb in [0, @near_on_first@] /\ lc in [0, @near_on_first@]
  /\ ld in [0, @near_on_first@]
  /\ |ma| <= @near_on_second@ /\ |mb| <= @near_on_second@ /\ |mc| <= @near_on_second@ /\ |md| <= @near_on_second@
  -> l2 - (la + lb) in [0, 0] /\ l3 - (l2 + lc) in [0, 0] /\ l4 - (l3 - ld) in [0, 0]
  /\ m2 - (ma + mb) in [0, 0] /\ m3 - (m2 + mc) in [0, 0] /\ m4 - (m3 - md) in [0, 0] }

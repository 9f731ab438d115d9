# q = RN(dh y), dh = RN(d): what d y has more than q, over q, exactly. q + e is d y, and e is computed in one rounding.
es = 1 / ((1 + e1) * (1 + e2)) - 1;
{ |e1| <= @u@ /\ |e2| <= @u@
  -> |es| <= @residual@ }

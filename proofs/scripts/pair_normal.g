# n_i in units of q = RN(dh / r), r = 1: dh = 1 + m without error, dl = l, s = 1 + ls + es; low is what is added to q.
low = ((m + l) * (1 + e1) - ls) * (1 + e2) * (1 + e3) + h;
exact = (1 + m + l) / (1 + ls + es);
{ |m| <= @rest@ /\ |l| <= @rest@ /\ |ls| <= @pair_root_low@ /\ |es| <= @pair_root@ /\ |e1| <= @u@ /\ |e2| <= @u@
  /\ |e3| <= @u@ /\ |h| <= @pair_underflow@
  -> |low| <= @pair_normal_low@ /\ |1 + low - exact| <= @pair_normal@ }
1 + low - exact -> (m + l) * e1 + ((m + l) * (1 + e1) - ls) * (e2 + e3 + e2 * e3) + h + es
  + (ls + es) * (m + l - ls - es) / (1 + ls + es) { 1 + ls + es <> 0 };

# E's own error over s + T against `spread`, which is twice kNearError over S in three roundings; s + T = S (1 + x).
{ |x| <= @near_sum_low@ /\ |e1| <= @u@ /\ |e2| <= @u@ /\ |e3| <= @u@
  -> @near_error@ / (2 * (1 + x) * (1 + e1) * (1 + e2) * (1 + e3)) <= @near_spread@ }

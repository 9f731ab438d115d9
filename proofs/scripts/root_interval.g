# Its interval test, in units of s and of l, the low part: |A| <= l (1 + y) + the middle of s and of A, so that A is at
# most (l (1 + y) + m_s) / (1 - m_a). Two roundings of l (its own, and l -+ error) and those of the error itself.
{ |y| <= @u@ /\ |ma| <= @exact_reach_middle_of_a@ /\ |ms| <= @exact_reach_middle_of_s@
  /\ |a| <= @exact_reach_of_a@ /\ |s| <= @exact_reach_of_s@
  /\ |e1| <= @u@ /\ |e2| <= @u@ /\ |sh| <= @tau@ /\ |k| <= @root_interval@ /\ |kl| <= @low_interval@
  -> (s + a * ms / (1 - ma) + k * y) / ((1 + sh) * (1 + e1)) <= @root_interval@
  /\ (a * (1 + y) / (1 - ma) + 2 * y + kl * y) / ((1 + e1) * (1 + e2)) <= @low_interval@ }

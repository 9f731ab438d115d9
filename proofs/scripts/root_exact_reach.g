# other_value(): T exactly, in units of s. A = second.high; second.low is at most u |A|, and less.tail at most u (|A| +
# u |A| + s), since what a rounded sum loses is at most either term (coq/Rounding.v, lost_by_a_sum_is_less_than_first).
# Linear in s and A: of s, of A. The last sum's rounding, u of the low part, is of_low.
of_s = error + tail * e1 + (ls + tail * (1 + e1)) * e2;
of_a = (second + tail * (1 + w)) * e1 + (second + tail * (1 + w)) * (1 + e1) * e2;
m_s = (ls + tail * (1 + e1)) * (1 + e2);
m_a = (second + tail * (1 + w)) * (1 + e1) * (1 + e2);
{ |error| <= @root@ /\ |ls| <= @root_low_of_s@ /\ |second| <= @u@ /\ |tail| <= @residual@ /\ |w| <= @u@
  /\ |e1| <= @u@ /\ |e2| <= @u@
  -> |of_s| <= @exact_reach_of_s@ /\ |of_a| <= @exact_reach_of_a@ /\ |m_s| <= @exact_reach_middle_of_s@
  /\ |m_a| <= @exact_reach_middle_of_a@ }

# The quick value, sum.high + sum_low, against s - T: its error is linear in s and T. Of s, with T = 0, and of T, with s
# = 0: the root's error, the roundings of less.low + radii.low, of root.low minus that, and of the last sum with h,
# which sum.high leaves.
of_s = error + ls * ((1 + e2) * (1 + e3) - 1) + h * (1 + x) * e3;
of_t = lt * ((1 + e1) * (1 + e2) * (1 + e3) - 1) + h * (1 + x) * e3;
low = ((ls - lt * (1 + e1)) * (1 + e2) + h * (1 + x)) * (1 + e3);
{ |error| <= @root@ /\ |ls| <= @root_low_of_s@ /\ |lt| <= @less_low@ /\ |h| <= @u@ /\ |x| <= @residual@
  /\ |e1| <= @u@ /\ |e2| <= @u@ /\ |e3| <= @u@
  -> |of_s| <= @value_of_s@ /\ |of_t| <= @value_of_t@ /\ |low| <= @value_low@ }

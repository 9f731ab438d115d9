# What the interval test of a point needs: the error, what rounding l -+ error adds, what underflows, and its own
# roundings.
{ |w| <= @point_of_w@ /\ |h| <= @point_of_h@ /\ |lw| <= @point_low_of_w@ /\ |lh| <= @point_low_of_h@
  /\ |k| <= @point_interval@ /\ |kh| <= @point_sum_interval@
  /\ |e| <= @u@ /\ |e1| <= @u@ /\ |e2| <= @u@ /\ |slack| <= @point_underflow@
  -> (w + slack + (lw + k) * e) / ((1 + e1) * (1 + e2)) <= @point_interval@
  /\ (h + slack + (lh + kh) * e) / ((1 + e1) * (1 + e2)) <= @point_sum_interval@ }

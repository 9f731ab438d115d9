# Its root, in units of root.high = r: D = 1 + m + l + d, m = D.high - r^2 without error, l = D.low. (1 + x)^(1/2) = 1 +
# x / 2 - t, x = m + l + d: coq/Roots.v.
low = (m + l) * (1 + e1) / 2 * (1 + e2) + h;
error = low - ((m + l + d) / 2 - t);
{ |m| <= @root_residual@ /\ |l| <= @rest@ /\ |d| <= @pair_d@ /\ |t| <= @pair_root_rest@ /\ |e1| <= @u@
  /\ |e2| <= @u@ /\ |h| <= @pair_underflow@
  -> |low| <= @pair_root_low@ /\ |error| <= @pair_root@ }
error -> (m + l) / 2 * (e1 + e2 + e1 * e2) - d / 2 + t + h;

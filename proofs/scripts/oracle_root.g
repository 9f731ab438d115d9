# root(), in units of s = RN(sqrt(xh)): x = 1 + m + l, m without error. (1 + m + l)^(1/2) = 1 + (m + l) / 2 - t:
# coq/Roots.v.
low = (m + l) * (1 + e1) / 2 * (1 + e2);
error = low - ((m + l) / 2 - t);
{ |m| <= @root_residual@ /\ |l| <= @rest@ /\ |t| <= @pair_root_rest@ /\ |e1| <= @u@ /\ |e2| <= @u@
  -> |error / (1 + (m + l) / 2 - t)| <= @oracle_root@ }
error -> (m + l) / 2 * (e1 + e2 + e1 * e2) + t;

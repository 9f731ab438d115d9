# plain_decision.hpp, in every rounding mode: each rounding errs by at most 2 u. One term of D' over the same term of D,
# with or without the product's rounding, and reach'^2 over reach^2; s is the share that numbers cost which are flushed to
# zero before they are squared: 2 |x f| <= s x^2 + f^2 / s.
f = (1 + d) * (1 + d) * (1 + e1) * (1 + e2) * (1 + e3) * (1 + s1);
g = (1 + a) * (1 + b) * (1 + a) * (1 + b) * (1 + e) * (1 + s2);
{ |d| <= @any_u@ /\ |e1| <= @any_u@ /\ |e2| <= @any_u@ /\ |e3| <= @any_u@ /\ |a| <= @any_u@ /\ |b| <= @any_u@
  /\ |e| <= @any_u@ /\ |s1| <= @flushed_share@ /\ |s2| <= @flushed_share@
  -> |f - 1| <= @scalar_d@ /\ |g - 1| <= @scalar_d@ }

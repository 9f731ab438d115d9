# plain_decision.hpp, filter(), in every rounding mode, in units of D + reach^2: m = D - reach^2 <= 0 is a hit or touching,
# and the filter must not say "miss". w is what plain arithmetic adds to D' - reach'^2, v what it adds to their sum
# (coq/Weights.v). By symmetry a miss is never called a hit. The floor only widens the gap: scalar_floor.g.
difference = (m + w) * (1 + e1);
sum = (1 + v) * (1 + e2);
{ m in [-@one@, 0] /\ |w| <= @scalar_d@ /\ |v| <= @scalar_d@
  /\ |e1| <= @any_u@ /\ |e2| <= @any_u@ /\ |e3| <= @any_u@ /\ |e4| <= @any_u@
  -> difference - sum * @scalar_gap@ * (1 + e3) * (1 + e4) <= 0 }

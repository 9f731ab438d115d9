# batch_arithmetic-inl.h, filter(), in units of D + reach^2: m = D - reach^2 <= 0 is a hit or touching, and the filter
# must not say "miss". w is what plain arithmetic adds to D' - reach'^2, v what it adds to their sum (coq/Weights.v). By
# symmetry a miss is never called a hit. The floor only widens the gap; underflows: filter_floor.g. `slack` is an
# underflow of a scaled reach.
difference = (m + w + slack) * (1 + e1);
sum = (1 + v) * (1 + e2);
{ m in [-@one@, 0] /\ |w| <= @plain_d@ /\ |v| <= @plain_d@ /\ |slack| <= @scaled_underflow@
  /\ |e1| <= @u@ /\ |e2| <= @u@ /\ |e3| <= @u@ /\ |e4| <= @u@
  -> difference - sum * @filter_gap@ * (1 + e3) * (1 + e4) <= 0 }

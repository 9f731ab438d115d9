# plain_cores.hpp, filter_squares(), in every rounding mode, in units of |w|^2 + |u|^2 + |v|^2 + reach^2: where D is not less than reach^2 = r,
# reach'^2 - D' > gap all + floor must not hold. lost is what D' is off by, g is reach'^2 over reach^2, and k what the sum of
# squares is. With what is least it is the same turned round. The floor only widens the gap.
{ r in [0, @one@] /\ |g - 1| <= @scalar_d@ /\ |lost| <= @core_lost@ /\ |k| <= @core_all@
  /\ |e1| <= @any_u@ /\ |e2| <= @any_u@ /\ |e3| <= @any_u@
  -> (r * g - (r + lost)) * (1 + e3) - @core_gap@ * (1 + k) * (1 + e1) * (1 + e2) <= 0 }
r * g - (r + lost) -> r * (g - 1) - lost;

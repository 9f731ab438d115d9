# plain_decision.hpp, filter(), in every rounding mode: where D >= reach^2, a miss or touching, it must not say "hit", which
# is less + (gap more + floor) < more with D' as less and reach'^2 as more. f is D' over D, g is reach'^2 over reach^2, and
# all is in units of reach^2; a larger D only makes the left side larger. By symmetry a hit is never called a miss. The
# floor only widens the gap: scalar_floor.g.
{ |f - 1| <= @scalar_d@ /\ |g - 1| <= @scalar_d@
  /\ |e1| <= @any_u@ /\ |e2| <= @any_u@ /\ |e3| <= @any_u@
  -> g - (f + g * @scalar_gap@ * (1 + e1) * (1 + e2)) * (1 + e3) <= 0 }

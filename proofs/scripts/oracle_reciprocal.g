# reciprocal(), in units of 1 / xh: x = 1 + a, t = 1 - rest, rest without error; epsilon = 1 - x t. Relative to 1 / x =
# t / (1 - epsilon).
epsilon = rest - a * (1 - rest);
low = epsilon * (1 + e1) * (1 + e2);
{ |a| <= @u@ /\ |rest| <= @rest@ /\ |e1| <= @u@ /\ |e2| <= @u@
  -> |(1 + low) * (1 - epsilon) - 1| <= @oracle_reciprocal@ }
(1 + low) * (1 - epsilon) - 1 -> epsilon * (e1 + e2 + e1 * e2) * (1 - epsilon) - epsilon * epsilon;

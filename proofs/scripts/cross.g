# q.e in three roundings, of an e that carries one: k times each q_i es_i, and |q_i es_i| <= |g| q_i^2; h is what
# underflows. The terms are weighed by coq/Weights.v; |q|^2 is 1 + Q1.
lost = ((1 + e1) * (1 + e2) * (1 + e3) * (1 + e4) - 1) * g * (1 + Q1) + h;
whole = g * (1 + Q1);
{ |e1| <= @u@ /\ |e2| <= @u@ /\ |e3| <= @u@ /\ |e4| <= @u@ /\ |g| <= @residual@ /\ |Q1| <= @length_q@
  /\ |h| <= @cross_underflow@
  -> |lost| <= @cross_error@ /\ |whole| <= @cross@ }

# One term of D' = dx'^2 + dy'^2 + dz'^2 in plain arithmetic, over the same term of D: the difference is rounded (d,
# squared), then the product and two sums, or the product inside a fused operation. The terms are weighed by
# coq/Weights.v.
f = (1 + d) * (1 + d) * (1 + e1) * (1 + e2) * (1 + e3);
{ |d| <= @u@ /\ |e1| <= @u@ /\ |e2| <= @u@ /\ |e3| <= @u@
  -> |f - 1| <= @plain_d@ }

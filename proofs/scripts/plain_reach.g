# reach' = RN(RN(r1 + r2) + alarm), squared, over reach^2: two sums of numbers >= 0, and without a fused operation the
# product. (The sum r1 + r2 is part of the next one, and its error is at most as large a share of that.)
g = (1 + a) * (1 + b) * (1 + a) * (1 + b) * (1 + e);
{ |a| <= @u@ /\ |b| <= @u@ /\ |e| <= @u@
  -> |g - 1| <= @plain_reach@ }

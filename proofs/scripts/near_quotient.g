# NearTouching::value: E / (s + T) against q + low, in units of q: S = sum.high, s + T = S (1 + x), E = Eh (1 + y) but
# for its absolute error, which spread doubles; rec = RN(1 / S), q = RN(Eh rec), rem = RN(Eh - q S), low = RN(RN(rem +
# RN(El - q sum_low)) rec). In units of q and S: 1 / S is 1, rec (1 + r), Eh = 1 / ((1 + r) (1 + eq)).
eh = 1 / ((1 + r) * (1 + eq));
rem = (eh - 1) * (1 + e1);
low = (rem + (y - x) * (1 + e2)) * (1 + e3) * (1 + r) * (1 + e4);
exact = (eh + y + dy) / (1 + x + dx);
{ |r| <= @u@ /\ |eq| <= @u@ /\ |e1| <= @u@ /\ |e2| <= @u@ /\ |e3| <= @u@ /\ |e4| <= @u@
  /\ |x| <= @near_sum_low@ /\ |dx| <= @near_sum_error@ /\ |y| <= @near_difference_low@
  /\ |dy| <= @near_difference_error@
  -> |low| <= @near_quotient_low@ /\ |1 + low - exact| <= @near_quotient@ }
1 + low - exact -> (eh - 1) * e1 + (y - x) * e2 + (rem + (y - x) * (1 + e2)) * ((1 + e3) * (1 + r) * (1 + e4) - 1)
  + (dx - dy + (x + dx) * (eh - 1 + y + dy - x - dx) / (1 + x + dx)) { 1 + x + dx <> 0, 1 + r <> 0, 1 + eq <> 0 };

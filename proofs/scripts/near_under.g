# What is below the grids of one square: the remainders a, b and c of the square, its residual and 2 high low, and
# low^2. The differences that give a and b are exact; the residual may lack an underflow, h.
@rnd = float<53, -174, ne>;
inner rnd= c;
low2 rnd= low * low + inner;
remainders rnd= a + b;
under rnd= remainders + low2;
{ |a| <= @near_left_second@ /\ |b| <= @near_left_second@ /\ |c| <= @near_left_second@ /\ |low| <= @near_low@
  /\ |h| <= @near_underflow@
  -> |under| <= @near_under@ /\ |under - (a + b + c + low * low + h)| <= @near_under_error@ }
under - (a + b + c + low * low + h) -> (under - (remainders + low2)) + (remainders - (a + b)) + (low2 - (low * low
  + inner)) + (inner - c) - h;

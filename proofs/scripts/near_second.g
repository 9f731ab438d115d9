# The second grid: what is left of the square, the residual or the product 2 high low, on whole numbers of 2^-98.
@rnd = float<53, -174, ne>;
second = 3b-47;
on = rnd(x + second) - second;
{ |x| <= @near_left_first@
  -> rnd(on) - on in [0, 0] /\ @FIX(on, -98) /\ |on| <= @near_on_grid@ /\ |on - x| <= @near_left_second@ }
on - x -> rnd(x + second) - (x + second);

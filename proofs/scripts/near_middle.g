# Sums of numbers on the second grid are exact: the three of one square, and the four of these.
@rnd = float<53, -174, ne>;
two = rnd(a + b);
three = rnd(two + c);
{ @FIX(a, -98) /\ @FIX(b, -98) /\ @FIX(c, -98) /\ |a| <= @near_on_grid@ /\ |b| <= @near_on_grid@
  /\ |c| <= @near_on_grid@
  -> two - (a + b) in [0, 0] /\ three - (two + c) in [0, 0] /\ @FIX(three, -98) /\ |three| <= @near_on_second@ }
three -> (three - (two + c)) + ((two - (a + b)) + (a + b + c));

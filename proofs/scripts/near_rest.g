# The sum of what is below the grids, and 2 Th Ttail; what 2 Tl Ttail + Ttail^2 would add is left out. e is what each
# lacks.
@rnd = float<53, -174, ne>;
r2 rnd= a + b;
r3 rnd= r2 + c;
r4 rnd= r3 - d;
r5 rnd= r4 - 2 * high * tail;
exact = a + b + c - d - 2 * high * tail - (2 * low * tail + tail * tail);
{ |a| <= @near_under@ /\ |b| <= @near_under@ /\ |c| <= @near_under@ /\ |d| <= @near_under@
  /\ |high| <= @near_high@ /\ |low| <= @near_low@ /\ |tail| <= @near_tail@
  /\ |ea| <= @near_under_error@ /\ |eb| <= @near_under_error@ /\ |ec| <= @near_under_error@
  /\ |ed| <= @near_under_error@
  -> |r5| <= @near_rest@ /\ |r5 - exact + (ea + eb + ec - ed)| <= @near_error@ }
r5 - exact -> (r5 - (r4 - 2 * high * tail)) + (r4 - (r3 - d)) + (r3 - (r2 + c)) + (r2 - (a + b)) + (2 * low * tail
  + tail * tail);

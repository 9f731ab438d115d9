# sum_low of s + T, in units of s + T: root.high + Th is S and a rest of at most u; then root.low + Tl, and the last
# sum. Ttail, which is left out, is at most u of Tl. What is in units of s and of T has about half of its weight here.
ls = share * ls0;
lt = share * lt0;
error = share * error0;
low = (rest + (ls + lt) * (1 + e1)) * (1 + e2);
{ share in [0, @near_share@] /\ |rest| <= @rest@ /\ |ls0| <= @root_low_of_s@ /\ |lt0| <= @less_low@ /\ |e1| <= @u@
  /\ |e2| <= @u@
  /\ |tail| <= @near_tail_of_t@ /\ |error0| <= @root@
  -> |low| <= @near_sum_low@ /\ |low - (rest + ls + lt) - tail - error| <= @near_sum_error@ }
low - (rest + ls + lt) - tail - error -> (ls + lt) * e1 + (rest + (ls + lt) * (1 + e1)) * e2 - tail - error;

# difference.low = RN(upper.low + sum.low), over difference.high = sum.high = RN(upper.high + rest): either is at most u
# of its high part, and upper.high is at most 2 sum.high where upper.low is not 0: coq/Near.v, upper_beside_the_sum.
{ |a| <= @u@ /\ |b| <= @u@ /\ |k| <= @two@ /\ |e| <= @u@
  -> |a * k + b| <= @near_difference_low@ /\ |(a * k + b) * e| <= @near_difference_error@ }

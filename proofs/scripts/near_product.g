# What comes to the second grid beside the square's remainder: the residual of the square and 2 high low are smaller
# than that.
{ |high| <= @near_high@ /\ |low| <= @near_low@ -> |2 * high * low| <= @near_left_first@ }

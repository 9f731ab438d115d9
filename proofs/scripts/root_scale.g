# The root's error and its low part in units of s: sh is s / (1 + low - x).
{ |low| <= @root_low@ /\ |x| <= @root_over_high@
  -> @root_over_high@ / (1 + low - x) <= @root@ /\ |low / (1 + low - x)| <= @root_low_of_s@ }

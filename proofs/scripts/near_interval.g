# What the interval test of a quotient needs beside E's own error: what rounding low -+ error adds, and the error's
# roundings.
{ |q| <= @near_quotient@ /\ |low| <= @near_quotient_low@ /\ |k| <= @near_quotient_interval@ /\ |e| <= @u@ /\ |e1| <= @u@
  -> (q + (low + k) * e) / (1 + e1) <= @near_quotient_interval@ }

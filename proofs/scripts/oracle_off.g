# round_to_nearest(): off = RN(RN(radius k) + |low| 2^-52) is more than the radius by more than the rounding of low -+
# off, u (|low| + off), takes off it. Linear in radius and |low|: of the radius and, in units of 2^-52, of |low|.
{ |e1| <= @u@ /\ |e2| <= @u@
  -> @off_rounding@ * (1 + e1) * (1 + e2) * (1 - @u@) >= 1 /\ (1 + e2) * (1 - @u@) - 1 / 2 >= 0 }

# NearTouching::near: |RN(D' - Th^2)| <= RN(D' kNear) is asked, with D' = D (1 + d) and Th = T (1 + t); near is what is
# left of D' by that test, exactly, and x what T^2 / D has more or less than 1 - near.
x = (1 - near * (1 + e1) / (1 + e2)) * (1 + d) / ((1 + t) * (1 + t)) - (1 - near);
{ |near| <= @near@ /\ |d| <= @plain_d@ /\ |t| <= @u@ /\ |e1| <= @u@ /\ |e2| <= @u@
  -> |x| <= @near_test@ }
x -> near * (1 - (1 + e1) / (1 + e2)) + (1 - near * (1 + e1) / (1 + e2)) * ((1 + d) / ((1 + t) * (1 + t)) - 1)
  { 1 + e2 <> 0, 1 + t <> 0 };

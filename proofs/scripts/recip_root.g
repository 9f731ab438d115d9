# y = RN(1 / RN(sqrt D')), times sqrt D'.
z = (1 + e2) / (1 + e1);
{ |e1| <= @u@ /\ |e2| <= @u@
  -> |z - 1| <= @recip_root@ }

# rho = 1 - D y^2 = 1 - (y sqrt D')^2 D / D'.
rho = 1 - z * z / f;
{ |z - 1| <= @recip_root@ /\ |f - 1| <= @plain_d@
  -> |rho| <= @rho@ }

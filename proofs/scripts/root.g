# s = sqrt D against sh + sl, in units of sh: s / sh = (1 - rho)^(1/2) / (1 - tau), (1 - rho)^(1/2) = 1 - rho2 - r, rho2
# = rho / 2.
sl = (tau * (1 + e1) - (rho2 + dr)) * (1 + e2) * (1 + e3) + h;
exact = (1 - rho2 - r) / (1 - tau);
{ |tau| <= @tau@ /\ |2 * rho2| <= @rho@ /\ |dr| <= @half_rho_error@ /\ |r| <= @root_rest@ /\ |rho2 + dr| <= @half_rho@
  /\ |e1| <= @u@ /\ |e2| <= @u@ /\ |e3| <= @u@ /\ |h| <= @normal_underflow@
  -> |sl| <= @root_low@ /\ |1 + sl - exact| <= @root_over_high@ }
1 + sl - exact -> tau * e1 - dr + (tau * (1 + e1) - (rho2 + dr)) * (e2 + e3 + e2 * e3) + h
  + (r - tau * tau + tau * (2 * rho2) / 2 + tau * (r - tau * tau + tau * (2 * rho2) / 2) / (1 - tau)) { 1 - tau <> 0 };

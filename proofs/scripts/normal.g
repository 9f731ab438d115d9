# n_i = (1 + es) (1 - rho)^(-1/2) against 1 + low, in units of q_i: low = RN(q_i half + e). (1 - rho)^(-1/2) = 1 + rho2
# + r, rho2 = rho / 2.
e = es * (1 + ee);
low = (rho2 + dr + e) * (1 + el) + h;
exact = (1 + es) * (1 + rho2 + r);
{ |es| <= @residual@ /\ |ee| <= @u@ /\ |el| <= @u@ /\ |2 * rho2| <= @rho@ /\ |dr| <= @half_rho_error@
  /\ |r| <= @inverse_root_rest@
  /\ |rho2 + dr| <= @half_rho@ /\ |h| <= @normal_underflow@
  -> |low| <= @low@ /\ |1 + low - exact| <= @normal@ }
low -> ((rho2 + dr) + e) * (1 + el) + h;
1 + low - exact -> dr + es * ee + ((rho2 + dr) + e) * el - r - es * r - es * (2 * rho2) / 2 + h;

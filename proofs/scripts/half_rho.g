# rho / 2 as it is computed, from the residuals and q.e: rho = -(rx + ry + rz) - 2 q.e - |e|^2. rx, ry, rz and dc are
# real numbers: each residual is one fused operation, and rx + ry + rz is |q|^2 - 1. Subnormal numbers are in `rnd`.
@rnd = float<ieee_64, ne>;
sum rnd= rnd(rnd(rx) + rnd(ry)) + rnd(rz);
half = - rnd(sum / 2 + (c + dc));
exact = - (rx + ry + rz) / 2 - c - g * g * (1 + Q1) / 2;
{ |rx| <= @rx@ /\ |ry| <= @ry@ /\ |rz| <= @rz@ /\ |rx + ry + rz| <= @length_q@ /\ |2 * exact| <= @rho@
  /\ |c| <= @cross@ /\ |dc| <= @cross_error@ /\ |g| <= @residual@ /\ |Q1| <= @length_q@
  -> |half - exact| <= @half_rho_error@ }
half - exact -> (- (rnd(sum / 2 + (c + dc)) - (sum / 2 + (c + dc)))) - dc - (sum - (rx + ry + rz)) / 2 + g * g * (1
  + Q1) / 2;
sum - (rx + ry + rz) -> (sum - (rnd(rnd(rx) + rnd(ry)) + rnd(rz))) + (rnd(rnd(rx) + rnd(ry)) - (rnd(rx) + rnd(ry)))
  + (rnd(rx) - rx) + (rnd(ry) - ry) + (rnd(rz) - rz);
rnd(rnd(rx) + rnd(ry)) + rnd(rz) -> (rx + ry + rz) + (rnd(rnd(rx) + rnd(ry)) - (rnd(rx) + rnd(ry))) + (rnd(rx)
  - rx) + (rnd(ry) - ry) + (rnd(rz) - rz);
sum / 2 + (c + dc) -> - (2 * exact) / 2 + dc + (sum - (rx + ry + rz)) / 2 - g * g * (1 + Q1) / 2;

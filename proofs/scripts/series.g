# What is left of (1 - rho)^(-1/2) and (1 - rho)^(1/2) beyond the first order: coq/Roots.v.
{ |rho| <= @rho@ -> @inverse_root_factor@ * (rho * rho) <= @inverse_root_rest@
  /\ @root_factor@ * (rho * rho) <= @root_rest@ }

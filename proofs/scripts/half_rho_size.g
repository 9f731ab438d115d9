{ |rho| <= @rho@ /\ |dr| <= @half_rho_error@ -> |rho / 2 + dr| <= @half_rho@ }

{ |m| <= @root_residual@ /\ |l| <= @rest@
  /\ |d| <= @pair_d@ -> @root_factor@ * ((m + l + d) * (m + l + d)) <= @pair_root_rest@ }

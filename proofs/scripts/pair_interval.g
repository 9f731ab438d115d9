# What Approximation::rounded() needs of each error: low -+ error is rounded, and the error itself in three roundings at
# most.
up = (1 + @u@) / (1 - 4 * @u@);
{ |e| <= @u@
  -> (@pair_normal@ + @rest@ * e) * up <= @pair_normal_needed@
  /\ (@pair_point_of_w@ + @pair_point_low@ * e) * up <= @pair_point_needed@
  /\ (@pair_value_of_s@ + @pair_value_low_of_s@ * e) * up <= @pair_value_root_needed@
  /\ (@pair_value_of_t@ + @pair_value_low_of_t@ * e) * up <= @pair_value_less_needed@
  /\ (@pair_value_of_h@ + @rest@ * (1 + e) * e) * up <= @pair_last_sum_needed@ }

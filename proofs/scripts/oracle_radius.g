# kRadiusRounding: what fifteen roundings to nearest take off a radius. It is computed in at most nine.
{ |e| <= @u@ -> @radius_rounding@ * ((1 + e) * (1 + e) * (1 + e)) * ((1 + e) * (1 + e) * (1 + e) * (1 + e))
  * ((1 + e) * (1 + e) * (1 + e) * (1 + e)) * ((1 + e) * (1 + e) * (1 + e) * (1 + e)) >= 1 }

# x - r^2 in units of r^2, r = RN(sqrt x).
{ |e| <= @u@ -> |1 / ((1 + e) * (1 + e)) - 1| <= @root_residual@ }

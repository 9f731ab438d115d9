# tau = 1 - y sh exactly, sh = RN(y D'): y^2 D' is z^2.
{ |z - 1| <= @recip_root@ /\ |e| <= @u@ -> |1 - z * z * (1 + e)| <= @tau@ }

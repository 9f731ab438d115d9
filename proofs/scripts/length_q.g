# |q|^2 - 1: |d y|^2 = 1 - rho, and the squares of q are those times k (weighed by coq/Weights.v).
k = (1 + e1) * (1 + e2) * (1 + e1) * (1 + e2);
{ |rho| <= @rho@ /\ |e1| <= @u@ /\ |e2| <= @u@
  -> |(1 - rho) * k - 1| <= @length_q@ }

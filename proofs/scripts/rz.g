# What is left of |q|^2 - 1 for the third residual: all of it but the first two.
rz = length - rx - ry;
{ |length| <= @length_q@ /\ |rx| <= @rx@ /\ |ry| <= @ry@
  -> |rz| <= @rz@ }

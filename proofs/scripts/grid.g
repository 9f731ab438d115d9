# a1 = RN(1 + qx^2) and a2 = RN(a1 + qy^2): the differences that follow are exact, and what is left over is small.
@rnd = float<ieee_64, ne>;
a1 = rnd(qx * qx + 1);
a2 = rnd(qy * qy + a1);
{ |qx| <= @q_most@ /\ |qy| <= @q_most@ /\ qx * qx + qy * qy - 1 <= @length_q@
  -> |qx * qx + 1 - a1| <= @rx@ /\ |qy * qy + a1 - a2| <= @ry@
  /\ rnd(a1 - 1) - (a1 - 1) in [0, 0] /\ rnd(a2 - a1) - (a2 - a1) in [0, 0] /\ rnd(2 - a2) - (2 - a2) in [0, 0] }
qy * qy + a1 -> (qx * qx + qy * qy - 1) + 2 + (a1 - (qx * qx + 1));

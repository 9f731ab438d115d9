# The same from an estimate y0 = (1 + x) / sqrt D' by the series of (1 - h)^(-1/2) (AVX-512). z is y sqrt D', h what is
# computed of h0 = 1 - D' y0^2, whose own error is dh.
c3 = 5 / 16;
c4 = 35 / 128;
h0 = 1 - (1 + x) * (1 + x);
dh = (1 - (1 + x) * (1 + x) * (1 + e1)) * (1 + e2) - h0;
h = h0 + dh;
p1 = (h * c4 + c3) * (1 + e3);
p2 = (p1 * h + 3 / 8) * (1 + e4);
p3 = (p2 * h + 1 / 2) * (1 + e5);
exact0 = 1 / 2 + h0 * (3 / 8 + h0 * (c3 + h0 * c4));
exact = 1 / 2 + h * (3 / 8 + h * (c3 + h * c4));
z = (1 + x) * (1 + h * (1 + e6) * p3) * (1 + e7);
{ |x| <= @estimate@ /\ |e1| <= @u@ /\ |e2| <= @u@ /\ |e3| <= @u@ /\ |e4| <= @u@ /\ |e5| <= @u@ /\ |e6| <= @u@
  /\ |e7| <= @u@
  -> |z - 1| <= @root_series@ }
z - 1 -> ((1 + x) * (1 + h0 * exact0) - 1) + (1 + x) * ((h * exact - h0 * exact0) + h * (p3 - exact) + h * e6 * p3)
  + (1 + x) * (1 + h * (1 + e6) * p3) * e7;
(1 + x) * (1 + h0 * exact0) - 1 -> x * x * x * x * x * (1008 + x * (1680 + x * (1080 + x * (315 + x * (35))))) / 128;
dh -> (1 - (1 + x) * (1 + x)) * e2 - (1 + x) * (1 + x) * e1 * (1 + e2);
h * exact - h0 * exact0 -> dh * (1 / 2 + 3 / 8 * (h + h0) + c3 * (h * h + h * h0 + h0 * h0) + c4 * (h * h * h
  + h * h * h0 + h * h0 * h0 + h0 * h0 * h0));
p3 - exact -> (p2 * h + 1 / 2) * e5 + h * ((p1 * h + 3 / 8) * e4 + h * ((h * c4 + c3) * e3));

# segment_cores.hpp, sum(), in units of |x| + |y|: r is the rest of the highs' sum, l what the two low parts are together.
# The last two_sum is exact.
total = (r + l * (1 + e1)) * (1 + e2);
{ |r| <= @rest@ /\ |l| <= @rest@ /\ |e1| <= @u@ /\ |e2| <= @u@ -> |total - (r + l)| <= @segment_sum@ }
total - (r + l) -> l * e1 + (r + l * (1 + e1)) * e2;

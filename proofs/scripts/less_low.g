# T.low = less.low + radii.low over T: each is at most u of a rounded sum of numbers >= 0.
{ |a| <= @u@ /\ |b| <= @u@ /\ |c| <= @u@ /\ |d| <= @u@ -> |a * (1 + c) * (1 + d) + b * (1 + d)| <= @less_low@ }

# s and T as shares of s + T where T^2 is within kNear of D; x is what plain arithmetic adds to that test.
t = sqrt(1 + near + x);
{ |near| <= @near@ /\ |x| <= @near_test@ -> 1 / (1 + t) <= @near_share@ /\ 1 - 1 / (1 + t) <= @near_share@ }

# Grids::add_square for k = 0, D' in [1, 2): the square on whole numbers of 2^-50. What is left is exact:
# coq/ErrorFree.v, grid_remainder. Numbers are whole multiples of 2^-174 in these scripts: k >= -900, and 2^-1074 is the
# least number.
@rnd = float<53, -174, ne>;
on_first = rnd(square + 6) - 6;
{ square in [0, @near_square@]
  -> rnd(on_first) - on_first in [0, 0] /\ @FIX(on_first, -50) /\ on_first in [0, @near_on_first@]
  /\ |on_first - square| <= @near_left_first@ }
on_first - square -> rnd(square + 6) - (square + 6);

(* The sums without error of the kernels: Knuth's two_sum and two_difference, and the remainder of a grid. *)
From Coq Require Import Reals Lra Lia.
From Flocq Require Import Core Plus_error Sterbenz Pff2Flocq.
Require Import Rounding.

Open Scope R_scope.

Lemma ties_are_symmetric : forall n : Z, negb (Z.even n) = negb (negb (Z.even (- (n + 1)))).
Proof. intros n. rewrite Z.even_opp, Z.even_add. now destruct (Z.even n). Qed.

(* two_sum: what `high` lacks of a + b. *)
Lemma two_sum : forall a b, double a -> double b ->
  let high := RN (a + b) in
  let part := RN (high - a) in
  high + RN (RN (a - RN (high - part)) + RN (b - part)) = a + b.
Proof.
  intros a b Fa Fb. cbv zeta.
  exact (TwoSum_correct emin prec (fun n => negb (Z.even n)) ltac:(reflexivity) ltac:(discriminate) ties_are_symmetric a b Fa Fb).
Qed.

(* two_difference: the same of b - a, as the vectors write it. *)
Lemma two_difference : forall b a, double b -> double a ->
  let high := RN (b - a) in
  let part := RN (high - b) in
  high + RN (RN (b - RN (high - part)) - RN (a + part)) = b - a.
Proof.
  intros b a Fb Fa. cbv zeta. assert (H := two_sum b (- a) Fb (double_opposite a Fa)). cbv zeta in H.
  change (b + - a) with (b - a) in H.
  replace (- a - RN (RN (b - a) - b)) with (- (a + RN (RN (b - a) - b))) in H by ring.
  rewrite RN_opposite in H. exact H.
Qed.

(* The grids: C is at least |x|, s = RN(x + C); s - C and x - (s - C) come out without error. *)
Lemma grid_remainder : forall C x, double C -> double x -> Rabs x <= Rabs C ->
  let s := RN (C + x) in
  let on := RN (s - C) in
  s + RN (x - on) = C + x.
Proof.
  intros C x FC Fx H. cbv zeta.
  assert (E := Fast2Sum_correct emin prec (fun n => negb (Z.even n)) ltac:(reflexivity) ltac:(discriminate) ties_are_symmetric C x FC Fx H).
  change (round radix2 (FLT_exp emin prec) (Znearest (fun n => negb (Z.even n)))) with RN in E.
  replace (RN (x - RN (RN (C + x) - C))) with (RN (x + RN (C - RN (C + x)))); [exact E|].
  f_equal. replace (C - RN (C + x)) with (- (RN (C + x) - C)) by ring. rewrite RN_opposite. ring.
Qed.

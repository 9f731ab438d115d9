(* A component of delta that is 0: nothing is rounded, and its normal and points are exact. *)
From Coq Require Import Reals Lra.
From Flocq Require Import Core.
Require Import Rounding.

Open Scope R_scope.

Lemma RN_zero : RN 0 = 0.
Proof. apply RN_double. apply generic_format_0. Qed.

(* Direction: q, e and low of a component whose high and low parts are 0, whatever y and rho are. *)
Lemma zero_component : forall y half,
  let q := RN (0 * y) in
  let e := RN (0 * y + RN (0 * y - q)) in
  q = 0 /\ e = 0 /\ RN (q * half + e) = 0.
Proof.
  intros y half. cbv zeta. rewrite !Rmult_0_l, RN_zero, Rminus_0_r, RN_zero, Rplus_0_l, RN_zero.
  rewrite Rmult_0_l, Rplus_0_l, RN_zero. now repeat split.
Qed.

(* point() there: the centre, with nothing below it. *)
Lemma point_of_a_zero_component : forall c r, double c ->
  let w := RN (r * 0) in
  let h := RN (c + w) in
  let p := RN (h - c) in
  let g := RN (c - RN (h - p)) in
  h = c /\ RN (g + RN (r * 0 + RN (r * 0 - p))) = 0.
Proof.
  intros c r Fc. cbv zeta. rewrite !Rmult_0_r, RN_zero, Rplus_0_r, (RN_double c Fc).
  replace (c - c) with 0 by ring. rewrite RN_zero, !Rminus_0_r, (RN_double c Fc).
  replace (c - c) with 0 by ring. rewrite RN_zero, !Rplus_0_l, !RN_zero. now split.
Qed.

(* A sum of two doubles is rounded to 0 only where it is 0: E = 0, once everything lies on the grids. *)
Lemma zero_sum : forall x y, double x -> double y -> RN (x + y) = 0 -> x + y = 0.
Proof.
  intros x y Fx Fy H. destruct (one_rounding_of_a_sum x y Fx Fy) as [e [He E]].
  rewrite H in E. apply Rabs_le_inv in He. assert (u < 1) by (unfold u; simpl; lra). nra.
Qed.

(* Grids::holds_square: where no remainder is left, the square is what was put on the grids, residual and product exact. *)
Lemma square_on_the_grids : forall high square on_first below residual of_residual on_second,
  residual = high * high - square -> square - on_first - below = 0 -> residual - of_residual = 0 ->
  on_second = below + of_residual -> high * high = on_first + on_second.
Proof. intros. lra. Qed.

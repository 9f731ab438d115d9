(* Boxes: low <= high + alarm is decided by the rounded sum, and by its error where low is that sum. No constant stands in it. *)
From Coq Require Import Reals Lra.
From Flocq Require Import Core.
Require Import Rounding ErrorFree.

Open Scope R_scope.

(* The difference of two doubles is rounded to a number of its own sign: 0 where it is 0. *)
Lemma sign_of_a_difference : forall x y, double x -> double y -> (RN (x - y) < 0 <-> x < y) /\ (RN (x - y) = 0 <-> x = y).
Proof.
  intros x y Fx Fy.
  destruct (one_rounding_of_a_sum x (- y) Fx (double_opposite y Fy)) as [e [He E]].
  change (x + - y) with (x - y) in E. rewrite E.
  assert (u < 1) by (unfold u; simpl; lra). apply Rabs_le_inv in He.
  assert (P : 0 < 1 + e) by lra. split; split; intros H0.
  - apply Rmult_lt_reg_r with (1 + e); [exact P|]. lra.
  - nra.
  - apply Rmult_integral in H0. lra.
  - replace (x - y) with 0 by lra. ring.
Qed.

(* batch_cube_cube.cpp, room() and within(). *)
Theorem box_decision : forall low high alarm, double low -> double high -> double alarm ->
  let sum := RN (high + alarm) in
  let part := RN (sum - high) in
  let error := RN (RN (high - RN (sum - part)) + RN (alarm - part)) in
  (low <= high + alarm <-> low < sum \/ (low = sum /\ 0 <= error)).
Proof.
  intros low high alarm Fl Fh Fa. cbv zeta.
  assert (E := two_sum high alarm Fh Fa). cbv zeta in E.
  set (sum := RN (high + alarm)) in *.
  set (error := RN (RN (high - RN (sum - RN (sum - high))) + RN (alarm - RN (sum - high)))) in *.
  destruct (Rtotal_order low sum) as [L | [L | L]].
  - split; [now left|]. intros _. apply Rnot_lt_le. intros C. apply Rlt_le in C.
    assert (M := RN_monotone _ _ C). fold sum in M. rewrite (RN_double low Fl) in M. lra.
  - split; intros H; [right; lra | lra].
  - split; intros H; [|lra].
    assert (M := RN_monotone _ _ H). fold sum in M. rewrite (RN_double low Fl) in M. lra.
Qed.

(* plain_decision.hpp, filter_boxes(): the sign of what is left of a rounded sum, rounded again in any mode. *)
Theorem room_in_any_mode : forall (rounding : R -> R) low high alarm,
  (forall x y, x <= y -> rounding x <= rounding y) -> (forall x, double x -> rounding x = x) -> double low -> double 0 ->
  (0 < rounding (rounding (high + alarm) - low) -> low <= high + alarm) /\
  (rounding (rounding (high + alarm) - low) < 0 -> ~ low <= high + alarm).
Proof.
  intros rounding low high alarm monotone keeps Fl F0. split.
  - intros L. apply Rnot_lt_le. intros C. apply Rlt_le in C. apply monotone in C. rewrite (keeps low Fl) in C.
    assert (P : rounding (high + alarm) - low <= 0) by lra. apply monotone in P. rewrite (keeps 0 F0) in P. lra.
  - intros L C. apply monotone in C. rewrite (keeps low Fl) in C.
    assert (P : 0 <= rounding (high + alarm) - low) by lra. apply monotone in P. rewrite (keeps 0 F0) in P. lra.
Qed.

(* cube_cube.cpp, where any rounding mode may be on: what any monotone rounding that keeps doubles says is right. *)
Theorem box_decision_in_any_mode : forall (rounding : R -> R) low high alarm,
  (forall x y, x <= y -> rounding x <= rounding y) -> (forall x, double x -> rounding x = x) -> double low ->
  (low < rounding (high + alarm) -> low <= high + alarm) /\ (low > rounding (high + alarm) -> ~ low <= high + alarm).
Proof.
  intros rounding low high alarm monotone keeps Fl. split.
  - intros L. apply Rnot_lt_le. intros C. apply Rlt_le in C. apply monotone in C. rewrite (keeps low Fl) in C. lra.
  - intros L C. apply monotone in C. rewrite (keeps low Fl) in C. lra.
Qed.

(* One rounding to nearest, ties to even, of binary64 numbers of unbounded size: the model (1 + e) of the scripts, and what is exact. *)
From Coq Require Import Reals Lra Lia.
From Flocq Require Import Core Relative Plus_error Mult_error Sterbenz.

Open Scope R_scope.

Definition prec := 53%Z.
Definition emin := (-1074)%Z.
Definition fexp := FLT_exp emin prec.
Definition RN := round radix2 fexp ZnearestE.
Definition double := generic_format radix2 fexp.
Definition u := bpow radix2 (-53).

#[global] Instance prec_gt_0_ : Prec_gt_0 prec. Proof. reflexivity. Qed.
#[global] Instance valid_fexp_ : Valid_exp fexp. Proof. apply FLT_exp_valid. reflexivity. Qed.
#[global] Instance monotone_fexp_ : Monotone_exp fexp. Proof. apply FLT_exp_monotone. Qed.

Lemma double_RN : forall x, double (RN x).
Proof. intros x. apply generic_format_round; auto with typeclass_instances. Qed.

Lemma RN_double : forall x, double x -> RN x = x.
Proof. intros x Fx. apply round_generic; auto with typeclass_instances. Qed.

Lemma RN_monotone : forall x y, x <= y -> RN x <= RN y.
Proof. intros x y H. apply round_le; auto with typeclass_instances. Qed.

Lemma double_opposite : forall x, double x -> double (- x).
Proof. intros x. apply generic_format_opp. Qed.

Lemma RN_opposite : forall x, RN (- x) = - RN x.
Proof. intros x. apply round_NE_opp. Qed.

Lemma half_unit : / 2 * bpow radix2 (- prec + 1) = u.
Proof. unfold u, prec. simpl. lra. Qed.

(* |e| <= u: the scripts' e, of a number that is not below the normal range. *)
Lemma one_rounding : forall x, bpow radix2 (-1022) <= Rabs x -> exists e, Rabs e <= u /\ RN x = x * (1 + e).
Proof.
  intros x Hx. destruct (relative_error_N_FLT_ex radix2 emin prec prec_gt_0_ (fun n => negb (Z.even n)) x) as [e [He E]].
  - exact Hx.
  - exists e. rewrite half_unit in He. split; assumption.
Qed.

(* Any number: e, and h where it is below the normal range, of at most 2^-1075; one of them is 0. *)
Lemma one_rounding_with_underflow : forall x,
  exists e h, Rabs e <= u /\ Rabs h <= bpow radix2 (-1075) /\ e * h = 0 /\ RN x = x * (1 + e) + h.
Proof.
  intros x. destruct (error_N_FLT radix2 emin prec prec_gt_0_ (fun n => negb (Z.even n)) x) as [e [h [He [Hh [Heh E]]]]].
  exists e, h. rewrite half_unit in He. repeat split; try assumption.
  replace (bpow radix2 (-1075)) with (/ 2 * bpow radix2 emin); [assumption|].
  change (/ 2) with (bpow radix2 (-1)). rewrite <- bpow_plus. reflexivity.
Qed.

(* Sums and differences never underflow. *)
Lemma one_rounding_of_a_sum : forall x y, double x -> double y -> exists e, Rabs e <= u /\ RN (x + y) = (x + y) * (1 + e).
Proof.
  intros x y Fx Fy.
  destruct (FLT_plus_error_N_ex radix2 emin prec (fun n => negb (Z.even n)) x y Fx Fy) as [e [He E]].
  exists e. split; [|exact E].
  apply Rle_trans with (1 := He). unfold u_ro. rewrite half_unit.
  assert (0 < u) by apply bpow_gt_0.
  apply Rmult_le_reg_r with (1 + u); [lra|]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l by lra. nra.
Qed.

(* Half a unit of the result: |RN(x) - x| is at most u of RN(x) too. *)
Lemma one_rounding_of_the_result : forall x, bpow radix2 (-1022) <= Rabs x -> Rabs (RN x - x) <= u * Rabs (RN x).
Proof.
  intros x Hx. rewrite <- half_unit. apply relative_error_N_FLT_round; [reflexivity | exact Hx].
Qed.

Lemma one_rounding_of_a_sum_of_the_result : forall x y, double x -> double y ->
  Rabs (RN (x + y) - (x + y)) <= u * Rabs (RN (x + y)).
Proof.
  intros x y Fx Fy. destruct (Rle_or_lt (bpow radix2 (-1022)) (Rabs (x + y))) as [H | H].
  - now apply one_rounding_of_the_result.
  - rewrite RN_double.
    + unfold Rminus. rewrite Rplus_opp_r, Rabs_R0. apply Rmult_le_pos; [apply bpow_ge_0 | apply Rabs_pos].
    + apply (FLT_format_plus_small radix2 emin prec); [exact Fx | exact Fy |].
      apply Rlt_le. apply Rlt_le_trans with (1 := H). apply bpow_le. unfold prec, emin. lia.
Qed.

(* What a rounded sum loses is a double, and at most either term. *)
Lemma lost_by_a_sum_is_double : forall x y, double x -> double y -> double (RN (x + y) - (x + y)).
Proof. intros x y Fx Fy. apply plus_error; auto with typeclass_instances. Qed.

Lemma lost_by_a_sum_is_less_than_first : forall x y, double x -> double y -> Rabs (RN (x + y) - (x + y)) <= Rabs x.
Proof.
  intros x y Fx Fy. destruct (round_N_pt radix2 fexp (fun n => negb (Z.even n)) (x + y)) as [_ N].
  specialize (N y Fy). replace (y - (x + y)) with (- x) in N by ring. rewrite Rabs_Ropp in N. exact N.
Qed.

Lemma lost_by_a_sum_is_less_than_second : forall x y, double x -> double y -> Rabs (RN (x + y) - (x + y)) <= Rabs y.
Proof. intros x y Fx Fy. rewrite Rplus_comm. apply lost_by_a_sum_is_less_than_first; assumption. Qed.

(* The residual of a product is a double, and a fused operation gives it exactly, where the product is 0 or at least 2^-969. *)
Lemma residual_of_a_product : forall x y, double x -> double y -> (x * y <> 0 -> bpow radix2 (-969) <= Rabs (x * y)) ->
  RN (x * y - RN (x * y)) = x * y - RN (x * y).
Proof.
  intros x y Fx Fy H. apply RN_double. rewrite <- Ropp_minus_distr. apply double_opposite.
  apply mult_error_FLT; auto with typeclass_instances.
Qed.

(* y - x is exact where y / 2 <= x <= 2 y. *)
Lemma near_difference : forall x y, double x -> double y -> y / 2 <= x <= 2 * y -> RN (x - y) = x - y.
Proof. intros x y Fx Fy H. apply RN_double. apply sterbenz; auto with typeclass_instances. Qed.

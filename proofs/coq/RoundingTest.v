(* The tests that accept a rounded number. *)
From Coq Require Import Reals Lra Lia.
From Flocq Require Import Core.
Require Import Rounding.

Open Scope R_scope.

(* What lies between two numbers that round to one number rounds to it. *)
Lemma between : forall a b x y, RN a = y -> RN b = y -> Rmin a b <= x <= Rmax a b -> RN x = y.
Proof.
  intros a b x y Ha Hb [L H].
  assert (M1 := RN_monotone _ _ L). assert (M2 := RN_monotone _ _ H).
  unfold Rmin, Rmax in *. destruct (Rle_dec a b); lra.
Qed.

(* The interval test: RN(high + RN(low - error)) = RN(high + RN(low + error)), where `error` is more than the real number's distance
   by what the roundings of low -+ error can take off it. *)
Theorem interval_test : forall high low error distance x e1 e2,
  RN (low - error) = (low - error) * (1 + e1) -> RN (low + error) = (low + error) * (1 + e2) -> Rabs e1 <= u -> Rabs e2 <= u ->
  0 <= error -> Rabs (x - (high + low)) <= distance -> distance + u * (Rabs low + error) <= error ->
  RN (high + RN (low - error)) = RN (high + RN (low + error)) -> RN x = RN (high + RN (low + error)).
Proof.
  intros high low error distance x e1 e2 E1 E2 H1 H2 P D H T.
  assert (B1 : Rabs ((low - error) * e1) <= u * (Rabs low + error)).
  { rewrite Rabs_mult, Rmult_comm. apply Rmult_le_compat; try apply Rabs_pos; [exact H1|].
    apply Rle_trans with (1 := Rabs_triang _ _). rewrite Rabs_Ropp, (Rabs_pos_eq error P). lra. }
  assert (B2 : Rabs ((low + error) * e2) <= u * (Rabs low + error)).
  { rewrite Rabs_mult, Rmult_comm. apply Rmult_le_compat; try apply Rabs_pos; [exact H2|].
    apply Rle_trans with (1 := Rabs_triang _ _). rewrite (Rabs_pos_eq error P). lra. }
  apply Rabs_le_inv in B1. apply Rabs_le_inv in B2. apply Rabs_le_inv in D.
  apply between with (high + RN (low - error)) (high + RN (low + error)); [exact T | reflexivity |].
  rewrite E1, E2. split.
  - apply Rle_trans with (1 := Rmin_l _ _). lra.
  - apply Rle_trans with (2 := Rmax_r _ _). lra.
Qed.

(* No boundary is nearer to a double than 2^-54 of it (half a unit below a power of two): what is nearer rounds to it. *)
Lemma beside_a_positive_double : forall high x, double high -> 0 < high ->
  Rabs (x - high) < bpow radix2 (-54) * high -> RN x = high.
Proof.
  intros high x F P H. apply Rabs_lt_inv in H.
  assert (B : bpow radix2 (-54) = bpow radix2 (-53) / 2) by (simpl; lra).
  apply Rle_antisym.
  - apply (round_N_le_midp radix2 fexp (fun n => negb (Z.even n)) high x F).
    rewrite succ_eq_pos by lra.
    assert (U := ulp_FLT_gt radix2 emin prec high). rewrite (Rabs_pos_eq high) in U by lra.
    change (bpow radix2 (- prec)) with (bpow radix2 (-53)) in U.
    change (FLT_exp emin prec) with fexp in U. nra.
  - apply (round_N_ge_midp radix2 fexp (fun n => negb (Z.even n)) high x F).
    rewrite pred_eq_pos by lra. unfold pred_pos. case Req_bool_spec; intros E.
    + assert (L : bpow radix2 (-53) * high <= bpow radix2 (fexp (mag radix2 high - 1))).
      { rewrite E at 1. rewrite <- bpow_plus. apply bpow_le. unfold fexp, FLT_exp, prec. lia. }
      nra.
    + assert (U := ulp_FLT_gt radix2 emin prec high). rewrite (Rabs_pos_eq high) in U by lra.
      change (bpow radix2 (- prec)) with (bpow radix2 (-53)) in U.
      change (FLT_exp emin prec) with fexp in U. nra.
Qed.

Lemma beside_a_double : forall high x, double high -> Rabs (x - high) < bpow radix2 (-54) * Rabs high -> RN x = high.
Proof.
  intros high x F H. destruct (Rtotal_order high 0) as [N | [Z | P]].
  - rewrite (Rabs_left high) in H by exact N.
    assert (E := beside_a_positive_double (- high) (- x) (double_opposite high F)).
    rewrite RN_opposite in E. rewrite <- (Ropp_involutive (RN x)), E, Ropp_involutive; try lra.
    replace (- x - - high) with (- (x - high)) by ring. rewrite Rabs_Ropp. exact H.
  - rewrite Z, Rabs_R0, Rmult_0_r in H. assert (0 <= Rabs (x - 0)) by apply Rabs_pos. lra.
  - rewrite (Rabs_pos_eq high) in H by lra. now apply beside_a_positive_double.
Qed.

(* The quick test: RN(high + low (1 + eta)) = RN(high + low (1 - eta)). *)
Theorem quick_test : forall high low eta x, double high -> 0 <= eta <= / 4 ->
  Rabs (x - (high + low)) <= eta * bpow radix2 (-55) * Rabs high ->
  RN (low * (1 + eta) + high) = RN (low * (1 - eta) + high) -> RN x = RN (low * (1 + eta) + high).
Proof.
  intros high low eta x F Heta D T.
  assert (B : bpow radix2 (-54) = 2 * bpow radix2 (-55)) by (simpl; lra).
  assert (P : 0 < bpow radix2 (-55)) by apply bpow_gt_0.
  set (t := bpow radix2 (-55)) in *.
  assert (A := Rabs_pos high).
  destruct (Rlt_or_le (Rabs low) (t * Rabs high)) as [S | S].
  - assert (W : 0 < Rabs high).
    { destruct A as [A | A]; [exact A|]. rewrite <- A, Rmult_0_r in S. assert (N := Rabs_pos low). lra. }
    assert (TH : 0 < t * Rabs high) by now apply Rmult_lt_0_compat.
    assert (R1 : RN x = high).
    { apply beside_a_double; [exact F|]. rewrite B.
      replace (x - high) with ((x - (high + low)) + low) by ring.
      apply Rle_lt_trans with (1 := Rabs_triang _ _). nra. }
    assert (R2 : RN (low * (1 + eta) + high) = high).
    { apply beside_a_double; [exact F|]. rewrite B.
      replace (low * (1 + eta) + high - high) with (low * (1 + eta)) by ring.
      rewrite Rabs_mult, (Rabs_pos_eq (1 + eta)) by lra. assert (N := Rabs_pos low). nra. }
    now rewrite R1, R2.
  - apply between with (low * (1 + eta) + high) (low * (1 - eta) + high); [reflexivity | now symmetry |].
    assert (D' : Rabs (x - (high + low)) <= eta * Rabs low) by nra.
    apply Rabs_le_inv in D'. unfold Rabs in D'.
    unfold Rmin, Rmax. destruct (Rcase_abs low); destruct (Rle_dec (low * (1 + eta) + high) (low * (1 - eta) + high)); split; nra.
Qed.

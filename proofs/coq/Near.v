(* Near touching: the sign of E, and how large upper.high is beside the sum. E' = L + M + rest is what was summed, L + M a whole number
   of 2^-98, upper = two_sum(L, M) and |rest| <= 2^-94, D' in [1, 2). *)
From Coq Require Import Reals Lra Lia ZArith.
From Flocq Require Import Core.
Require Import Rounding.

Open Scope R_scope.

(* Where upper.high is not exact, |L + M| is at least 2^-46, and rest is nothing beside it. *)
Lemma upper_is_exact_or_large : forall LM (m : Z), LM = IZR m * bpow radix2 (-98) -> RN LM = LM \/ bpow radix2 (-46) <= Rabs LM.
Proof.
  intros LM m E. destruct (Rle_or_lt (bpow radix2 (-46)) (Rabs LM)) as [H | H]; [now right | left].
  apply RN_double. rewrite E. replace (IZR m * bpow radix2 (-98)) with (F2R (Float radix2 m (-98))) by reflexivity.
  apply generic_format_F2R. intros Z. simpl. rewrite E in H. clear E.
  assert (M : (mag radix2 (F2R (Float radix2 m (-98))) <= -46)%Z).
  { apply mag_le_bpow; [|exact H]. intros C. apply Z. now apply eq_0_F2R with radix2 (-98)%Z. }
  unfold cexp, fexp, FLT_exp, prec, emin. lia.
Qed.

(* The sum that is tested: S = RN(upper + rest). Beyond twice the error the sign of S is that of E, which is within `error` of L + M + rest. *)
Theorem sign_of_a_difference_of_squares : forall LM (m : Z) rest E error, LM = IZR m * bpow radix2 (-98) ->
  Rabs rest <= bpow radix2 (-94) -> Rabs (E - (LM + rest)) <= error -> 0 < error -> double (2 * error) -> double (- (2 * error)) ->
  error <= bpow radix2 (-94) ->
  (2 * error < RN (RN LM + rest) -> 0 < E) /\ (RN (RN LM + rest) < - (2 * error) -> E < 0).
Proof.
  intros LM m rest E error HLM Hrest HE P Fe Fe' Small. apply Rabs_le_inv in Hrest. apply Rabs_le_inv in HE.
  destruct (upper_is_exact_or_large LM m HLM) as [X | X].
  - rewrite X. split; intros H.
    + assert (2 * error < LM + rest); [|lra]. apply Rnot_le_lt. intros C. apply RN_monotone in C. rewrite (RN_double _ Fe) in C. lra.
    + assert (LM + rest < - (2 * error)); [|lra]. apply Rnot_le_lt. intros C. apply RN_monotone in C. rewrite (RN_double _ Fe') in C. lra.
  - destruct (one_rounding LM) as [e [He Ee]].
    { apply Rle_trans with (2 := X). apply bpow_le. lia. }
    rewrite Ee. apply Rabs_le_inv in He.
    assert (U : 0 < u < / 4) by (unfold u; simpl; lra).
    assert (B : bpow radix2 (-46) = 281474976710656 * bpow radix2 (-94)) by (simpl; lra).
    assert (Q : 0 < bpow radix2 (-94)) by apply bpow_gt_0.
    set (t := bpow radix2 (-94)) in *. rewrite B in X.
    destruct (Rle_or_lt 0 LM) as [G | G].
    + rewrite Rabs_pos_eq in X by exact G. split; intros H; [nra|]. exfalso.
      assert (C : 0 <= LM * (1 + e) + rest) by nra. apply RN_monotone in C.
      assert (Z : RN 0 = 0) by (apply RN_double; apply generic_format_0). lra.
    + rewrite Rabs_left in X by exact G. split; intros H; [|nra]. exfalso.
      assert (C : LM * (1 + e) + rest <= 0) by nra. apply RN_monotone in C.
      assert (Z : RN 0 = 0) by (apply RN_double; apply generic_format_0). lra.
Qed.

(* near_difference.g: where upper.low is not 0, upper.high is at most twice the sum. *)
Lemma upper_beside_the_sum : forall LM (m : Z) rest, LM = IZR m * bpow radix2 (-98) -> Rabs rest <= bpow radix2 (-94) ->
  RN LM <> LM -> Rabs (RN LM) <= 2 * Rabs (RN (RN LM + rest)).
Proof.
  intros LM m rest HLM Hrest N. destruct (upper_is_exact_or_large LM m HLM) as [X | X]; [contradiction|].
  assert (B : bpow radix2 (-46) = 281474976710656 * bpow radix2 (-94)) by (simpl; lra).
  assert (Q : 0 < bpow radix2 (-94)) by apply bpow_gt_0.
  assert (U : 0 < u < / 4) by (unfold u; simpl; lra).
  destruct (one_rounding LM) as [e [He Ee]].
  { apply Rle_trans with (2 := X). apply bpow_le. lia. }
  assert (L : bpow radix2 (-46) / 2 <= Rabs (RN LM)).
  { rewrite Ee, Rabs_mult. assert (P : 1 - Rabs e <= Rabs (1 + e)).
    { apply Rabs_le_inv in He. rewrite (Rabs_pos_eq (1 + e)) by lra. unfold Rabs. destruct (Rcase_abs e); lra. }
    assert (0 <= Rabs e) by apply Rabs_pos. nra. }
  assert (S : 3 / 4 * Rabs (RN LM) <= Rabs (RN LM + rest)).
  { assert (T := Rabs_triang_inv (RN LM) (- rest)). rewrite Rabs_Ropp in T. replace (RN LM - - rest) with (RN LM + rest) in T by ring. lra. }
  destruct (one_rounding (RN LM + rest)) as [d [Hd Ed]].
  { apply Rle_trans with (bpow radix2 (-94)); [apply bpow_le; lia|]. lra. }
  rewrite Ed, Rabs_mult. assert (P : 1 - Rabs d <= Rabs (1 + d)).
  { apply Rabs_le_inv in Hd. rewrite (Rabs_pos_eq (1 + d)) by lra. unfold Rabs. destruct (Rcase_abs d); lra. }
  assert (0 <= Rabs d) by apply Rabs_pos. assert (0 <= Rabs (RN LM + rest)) by apply Rabs_pos. nra.
Qed.

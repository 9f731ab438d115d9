(* point(): with h = RN(c + w) and p = RN(h - c), the differences h - p and c - (h - p) are exact. *)
From Coq Require Import Reals Lra Lia.
From Flocq Require Import Core Plus_error Sterbenz Mult_error.
Require Import Rounding.

Open Scope R_scope.

Lemma double_twice : forall x, double x -> double (2 * x).
Proof.
  intros x F. replace (2 * x) with (x * bpow radix2 1) by (change (bpow radix2 1) with 2; ring).
  apply mult_bpow_pos_exact_FLT; [exact F | lia].
Qed.

Lemma double_half : forall x, double x -> bpow radix2 (prec + emin) < x -> double (x / 2).
Proof.
  intros x F H. replace (x / 2) with (x * bpow radix2 (-1)) by (change (bpow radix2 (-1)) with (/ 2); field).
  apply mult_bpow_exact_FLT; [exact F|].
  assert (M : (prec + emin < mag radix2 x)%Z).
  { apply mag_gt_bpow. rewrite Rabs_pos_eq; [now apply Rlt_le|]. apply Rle_trans with (2 := Rlt_le _ _ H). apply bpow_ge_0. }
  unfold prec, emin in *. lia.
Qed.

(* A sum is exact where it is small, or where a term takes half of the other away. *)
Lemma small_sum : forall x y, double x -> double y -> 0 <= x + y <= bpow radix2 (prec + emin) -> RN (x + y) = x + y.
Proof.
  intros x y Fx Fy H. apply RN_double. apply (FLT_format_plus_small radix2 emin prec); [exact Fx | exact Fy |].
  rewrite Rabs_pos_eq; lra.
Qed.

Lemma cancelling_sum : forall x y, double x -> double y -> 0 <= x -> - x <= y <= - (x / 2) -> RN (x + y) = x + y.
Proof.
  intros x y Fx Fy P H. replace (x + y) with (x - - y) by ring. apply near_difference; [exact Fx | now apply double_opposite | lra].
Qed.

Lemma difference_from_the_larger_positive : forall x y, double x -> double y -> Rabs y <= x -> double (RN (x + y) - x).
Proof.
  intros x y Fx Fy H. assert (N := Rabs_pos y). apply Rabs_le_inv in H.
  destruct (Rle_or_lt 0 y) as [P | Q].
  - apply sterbenz; auto with typeclass_instances; [apply double_RN|]. split.
    + apply Rle_trans with x; [lra|]. rewrite <- (RN_double x Fx) at 1. apply RN_monotone. lra.
    + rewrite <- (RN_double (2 * x) (double_twice x Fx)). apply RN_monotone. lra.
  - destruct (Rle_or_lt (x + y) (bpow radix2 (prec + emin))) as [S | S].
    { rewrite small_sum; try assumption; [now replace (x + y - x) with y by ring | lra]. }
    destruct (Rle_or_lt y (- (x / 2))) as [C | C].
    { rewrite cancelling_sum; try assumption; try lra. now replace (x + y - x) with y by ring. }
    apply sterbenz; auto with typeclass_instances; [apply double_RN|]. split.
    + rewrite <- (RN_double (x / 2)); [apply RN_monotone; lra|]. apply double_half; [exact Fx | lra].
    + apply Rle_trans with x; [|lra]. rewrite <- (RN_double x Fx) at 2. apply RN_monotone. lra.
Qed.

Lemma difference_from_the_larger : forall x y, double x -> double y -> Rabs y <= Rabs x -> double (RN (x + y) - x).
Proof.
  intros x y Fx Fy H. destruct (Rle_or_lt 0 x) as [P | N].
  - rewrite (Rabs_pos_eq x P) in H. now apply difference_from_the_larger_positive.
  - rewrite (Rabs_left x N) in H.
    replace (RN (x + y) - x) with (- (RN (- x + - y) - - x)).
    + apply double_opposite. apply difference_from_the_larger_positive; try now apply double_opposite.
      now rewrite Rabs_Ropp.
    + replace (- x + - y) with (- (x + y)) by ring. rewrite RN_opposite. ring.
Qed.

Lemma part_of_the_smaller_positive : forall c w, double c -> double w -> Rabs c < w ->
  let h := RN (c + w) in let p := RN (h - c) in double (h - p).
Proof.
  intros c w Fc Fw H. cbv zeta. apply Rabs_lt_inv in H.
  assert (X : RN (c + w) = c + w -> double (RN (c + w) - RN (RN (c + w) - c))).
  { intros E. rewrite E. replace (c + w - c) with w by ring. rewrite (RN_double w Fw). now replace (c + w - w) with c by ring. }
  destruct (Rle_or_lt (c + w) (bpow radix2 (prec + emin))) as [S | S].
  { apply X. apply small_sum; try assumption. lra. }
  destruct (Rle_or_lt c (- (w / 2))) as [C | C].
  { apply X. rewrite Rplus_comm. rewrite cancelling_sum; try assumption; lra. }
  assert (Fh : double (RN (c + w))) by apply double_RN.
  set (h := RN (c + w)) in *.
  assert (B : bpow radix2 (prec + emin) <= h).
  { unfold h. rewrite <- (RN_double (bpow radix2 (prec + emin))).
    - apply RN_monotone. lra.
    - apply generic_format_bpow. unfold fexp, FLT_exp, prec, emin. simpl. lia. }
  assert (Z : 0 < bpow radix2 (prec + emin)) by apply bpow_gt_0.
  apply sterbenz; auto with typeclass_instances; [apply double_RN|].
  destruct (Rle_or_lt 0 c) as [P | N].
  - (* c >= 0: h >= 2 c, so that h - c is at least h / 2 *)
    assert (T : 2 * c <= h).
    { unfold h. rewrite <- (RN_double (2 * c) (double_twice c Fc)). apply RN_monotone. lra. }
    split.
    + apply Rle_trans with h; [|lra]. assert (RN (h - c) <= h); [|lra].
      rewrite <- (RN_double h Fh) at 2. apply RN_monotone. lra.
    + destruct (Rle_lt_or_eq_dec _ _ B) as [B' | B'].
      * assert (h / 2 <= RN (h - c)); [|lra].
        rewrite <- (RN_double (h / 2)); [apply RN_monotone; lra | now apply double_half].
      * assert (h / 2 <= RN (h - c)); [|lra].
        rewrite <- (RN_double (h / 2)); [apply RN_monotone; lra|].
        rewrite <- B'. replace (bpow radix2 (prec + emin) / 2) with (bpow radix2 (prec + emin - 1)).
        -- apply generic_format_bpow. unfold fexp, FLT_exp, prec, emin. simpl. lia.
        -- unfold Zminus. rewrite bpow_plus. change (bpow radix2 (- (1))) with (/ 2). field.
  - (* c < 0: h >= -c, so that h - c is at most 2 h *)
    assert (T : - c <= h).
    { unfold h. rewrite <- (RN_double (- c) (double_opposite c Fc)). apply RN_monotone. lra. }
    split.
    + assert (RN (h - c) <= 2 * h); [|lra].
      rewrite <- (RN_double (2 * h) (double_twice h Fh)). apply RN_monotone. lra.
    + assert (h <= RN (h - c)); [|lra].
      rewrite <- (RN_double h Fh) at 1. apply RN_monotone. lra.
Qed.

Theorem part_of_a_sum : forall c w, double c -> double w ->
  let h := RN (c + w) in let p := RN (h - c) in
  RN (h - p) = h - p /\ RN (c - (h - p)) = c - (h - p).
Proof.
  intros c w Fc Fw. cbv zeta. split; apply RN_double.
  - destruct (Rle_or_lt (Rabs w) (Rabs c)) as [L | L].
    + assert (D := difference_from_the_larger c w Fc Fw L).
      rewrite (RN_double _ D). now replace (RN (c + w) - (RN (c + w) - c)) with c by ring.
    + destruct (Rle_or_lt 0 w) as [P | N].
      * rewrite (Rabs_pos_eq w P) in L. now apply part_of_the_smaller_positive.
      * rewrite (Rabs_left w N) in L.
        assert (D := part_of_the_smaller_positive (- c) (- w) (double_opposite c Fc) (double_opposite w Fw)).
        rewrite Rabs_Ropp in D. specialize (D L). cbv zeta in D.
        replace (- c + - w) with (- (c + w)) in D by ring. rewrite RN_opposite in D.
        replace (- RN (c + w) - - c) with (- (RN (c + w) - c)) in D by ring. rewrite RN_opposite in D.
        apply double_opposite in D.
        now replace (- (- RN (c + w) - - RN (RN (c + w) - c))) with (RN (c + w) - RN (RN (c + w) - c)) in D by ring.
  - (* what RN(h - c) loses *)
    replace (c - (RN (c + w) - RN (RN (c + w) - c))) with (RN (RN (c + w) + - c) - (RN (c + w) + - c)) by (unfold Rminus; ring).
    apply lost_by_a_sum_is_double; [apply double_RN | now apply double_opposite].
Qed.

(* The decision filter of the vectors as a whole, operation by operation, underflows and components that are 0 included: what it says of a
   pair is so. (Coarser numbers than filter.g's, put together by Coq.) *)
From Coq Require Import Reals Lra Lia.
From Flocq Require Import Core.
Require Import Rounding.

Open Scope R_scope.

Definition h := bpow radix2 (-1075).

(* y is x within a u of it, and t beside that. *)
Definition within a t x y := Rabs (y - x) <= a * u * x + t.

Lemma u_is : u = / 9007199254740992.
Proof. unfold u. simpl. lra. Qed.

Lemma h_positive : 0 < h.
Proof. apply bpow_gt_0. Qed.

Lemma within_plus : forall a t s x y x' y', within a t x y -> within a s x' y' -> within a (t + s) (x + x') (y + y').
Proof.
  unfold within. intros a t s x y x' y' H H'. apply Rabs_le_inv in H. apply Rabs_le_inv in H'. apply Rabs_le. lra.
Qed.

Lemma within_more : forall a b t s x y, 0 <= x -> a <= b -> t <= s -> within a t x y -> within b s x y.
Proof.
  unfold within. intros a b t s x y X A T H. apply Rle_trans with (1 := H).
  assert (0 <= u * x) by (rewrite u_is; lra). replace (a * u * x) with (a * (u * x)) by ring.
  replace (b * u * x) with (b * (u * x)) by ring. nra.
Qed.

Lemma one_step : forall a t x y e d, 0 <= x -> 0 <= a <= 16 -> 0 <= t -> 0 <= d -> Rabs e <= u -> within a t x y ->
  within (a + 1001 / 1000) (2 * t + d) x (y * (1 + e)) /\ forall k, Rabs k <= d -> within (a + 1001 / 1000) (2 * t + d) x (y * (1 + e) + k).
Proof.
  unfold within. intros a t x y e d X A T P E H.
  assert (V : 0 <= u * x) by (rewrite u_is; lra).
  assert (W : a * u * x <= 16 * (u * x)) by nra.
  assert (B : Rabs y <= x + 16 * (u * x) + t).
  { replace y with ((y - x) + x) by ring. apply Rle_trans with (1 := Rabs_triang _ _). rewrite (Rabs_pos_eq x X). lra. }
  assert (C : Rabs (y * e) <= u * (x + 16 * (u * x) + t)).
  { rewrite Rabs_mult, Rmult_comm. apply Rmult_le_compat; try apply Rabs_pos; assumption. }
  assert (G : forall k, Rabs k <= d -> Rabs (y * (1 + e) + k - x) <= (a + 1001 / 1000) * u * x + (2 * t + d)).
  { intros k K. replace (y * (1 + e) + k - x) with ((y - x) + y * e + k) by ring.
    apply Rle_trans with (1 := Rabs_triang _ _). apply Rle_trans with (Rabs (y - x) + Rabs (y * e) + Rabs k).
    - apply Rplus_le_compat_r. apply Rabs_triang.
    - replace ((a + 1001 / 1000) * u * x) with (a * u * x + 1001 / 1000 * (u * x)) by ring.
      assert (u * (16 * (u * x)) <= / 1000 * (u * x)) by (rewrite u_is in *; lra).
      assert (u * t <= t) by (rewrite u_is; lra).
      replace (u * (x + 16 * (u * x) + t)) with (u * x + u * (16 * (u * x)) + u * t) in C by ring. lra. }
  split; [|exact G]. replace (y * (1 + e)) with (y * (1 + e) + 0) by ring. apply G. now rewrite Rabs_R0.
Qed.

Lemma within_RN : forall a t x y, 0 <= x -> 0 <= a <= 16 -> 0 <= t -> within a t x y -> within (a + 1001 / 1000) (2 * t + h) x (RN y).
Proof.
  intros a t x y X A T H. destruct (one_rounding_with_underflow y) as [e [k [E [K [_ R]]]]]. rewrite R.
  apply (one_step a t x y e h); try assumption. apply Rlt_le, h_positive.
Qed.

Lemma within_RN_of_a_sum : forall a x p q, double p -> double q -> 0 <= x -> 0 <= a <= 16 -> within a 0 x (p + q) ->
  within (a + 1001 / 1000) 0 x (RN (p + q)).
Proof.
  intros a x p q Fp Fq X A H. destruct (one_rounding_of_a_sum p q Fp Fq) as [e [E R]]. rewrite R.
  destruct (one_step a 0 x (p + q) e 0) as [G _]; try assumption; try lra.
  replace (2 * 0 + 0) with 0 in G by ring. exact G.
Qed.

Lemma within_square : forall a x y, 0 <= x -> 0 <= a <= 4 -> within a 0 x y -> within (2 * a + / 1000) 0 (x * x) (y * y).
Proof.
  unfold within. intros a x y X A H. rewrite Rplus_0_r in *.
  replace (y * y - x * x) with ((y - x) * ((y - x) + 2 * x)) by ring. rewrite Rabs_mult.
  apply Rle_trans with (a * u * x * (a * u * x + 2 * x)).
  - apply Rmult_le_compat; try apply Rabs_pos; [exact H|].
    apply Rle_trans with (1 := Rabs_triang _ _). rewrite (Rabs_pos_eq (2 * x)) by lra. lra.
  - replace (a * u * x * (a * u * x + 2 * x)) with ((2 * a + a * a * u) * u * (x * x)) by ring.
    apply Rmult_le_compat_r; [nra|]. rewrite u_is. nra.
Qed.

(* The square of a rounded difference. *)
Lemma within_difference_squared : forall a b, double a -> double b ->
  within (2001 / 1000) 0 ((b - a) * (b - a)) (RN (b - a) * RN (b - a)).
Proof.
  intros a b Fa Fb. destruct (one_rounding_of_a_sum b (- a) Fb (double_opposite a Fa)) as [e [E R]].
  change (b + - a) with (b - a) in R. rewrite R.
  assert (W : within 1 0 (Rabs (b - a)) (Rabs (b - a) * (1 + e))).
  { unfold within. replace (Rabs (b - a) * (1 + e) - Rabs (b - a)) with (Rabs (b - a) * e) by ring.
    rewrite Rabs_mult, Rabs_Rabsolu. assert (P := Rabs_pos (b - a)). nra. }
  apply within_square in W; [|apply Rabs_pos | lra].
  replace (2001 / 1000) with (2 * 1 + / 1000) by lra.
  replace ((b - a) * (b - a)) with (Rabs (b - a) * Rabs (b - a)).
  - replace ((b - a) * (1 + e) * ((b - a) * (1 + e))) with (Rabs (b - a) * (1 + e) * (Rabs (b - a) * (1 + e))); [exact W|].
    replace ((b - a) * (1 + e) * ((b - a) * (1 + e))) with ((b - a) * (b - a) * ((1 + e) * (1 + e))) by ring.
    rewrite <- (Rabs_pos_eq ((b - a) * (b - a))) by exact (Rle_0_sqr (b - a)). rewrite Rabs_mult. ring.
  - rewrite <- Rabs_mult. apply Rabs_pos_eq. exact (Rle_0_sqr (b - a)).
Qed.

Section Pair.

Variables ax ay az bx by_ bz r1 r2 alarm : R.
Let D := (bx - ax) * (bx - ax) + (by_ - ay) * (by_ - ay) + (bz - az) * (bz - az).
Let S := (r1 + r2 + alarm) * (r1 + r2 + alarm).
Let dx := RN (bx - ax).
Let dy := RN (by_ - ay).
Let dz := RN (bz - az).
Let D' := RN (dz * dz + RN (dy * dy + RN (dx * dx))).
Let reach := RN (RN (r1 + r2) + alarm).
Let sum := RN (reach * reach + D').
Let difference := RN (D' - reach * reach).
Let gap := RN (sum * (16 * u) + bpow radix2 (-950)).

Definition doubles := double ax /\ double ay /\ double az /\ double bx /\ double by_ /\ double bz /\ double r1 /\ double r2 /\ double alarm.

Lemma plain_length : doubles -> within (5006 / 1000) (7 * h) D D'.
Proof.
  intros (Fax & Fay & Faz & Fbx & Fby & Fbz & _). assert (H := h_positive).
  assert (X := Rle_0_sqr (bx - ax)). assert (Y := Rle_0_sqr (by_ - ay)). assert (Z := Rle_0_sqr (bz - az)). unfold Rsqr in X, Y, Z.
  assert (W1 := within_difference_squared ax bx Fax Fbx). apply within_RN in W1; try lra.
  assert (W2 := within_difference_squared ay by_ Fay Fby).
  apply (within_more _ (2001 / 1000 + 1001 / 1000) 0 0) in W2; try lra.
  assert (W3 := within_plus _ _ _ _ _ _ _ W2 W1).
  apply within_RN in W3; try lra.
  assert (W4 := within_difference_squared az bz Faz Fbz).
  apply (within_more _ (2001 / 1000 + 1001 / 1000 + 1001 / 1000) 0 0) in W4; try lra.
  assert (W5 := within_plus _ _ _ _ _ _ _ W4 W3).
  apply within_RN in W5; try lra.
  replace D with ((bz - az) * (bz - az) + ((by_ - ay) * (by_ - ay) + (bx - ax) * (bx - ax))) by (unfold D; ring).
  apply within_more with (4 := W5); lra.
Qed.

Lemma plain_reach_squared : doubles -> 0 <= r1 -> 0 <= r2 -> 0 <= alarm -> within (4006 / 1000) 0 S (reach * reach).
Proof.
  intros (_ & _ & _ & _ & _ & _ & F1 & F2 & Fa) P1 P2 Pa.
  assert (W0 : within 0 0 (r1 + r2) (r1 + r2)) by (unfold within, Rminus; rewrite Rplus_opp_r, Rabs_R0; lra).
  apply within_RN_of_a_sum in W0; try assumption; try lra.
  assert (W1 : within (0 + 1001 / 1000) 0 alarm alarm).
  { unfold within, Rminus. rewrite Rplus_opp_r, Rabs_R0, u_is. lra. }
  assert (W2 := within_plus _ _ _ _ _ _ _ W0 W1). rewrite Rplus_0_r in W2 at 1.
  apply within_RN_of_a_sum in W2; try assumption; try apply double_RN; try lra.
  apply within_square in W2; try lra. apply within_more with (4 := W2); try lra. exact (Rle_0_sqr (r1 + r2 + alarm)).
Qed.

Theorem filter_is_right : doubles -> 0 <= r1 -> 0 <= r2 -> 0 <= alarm ->
  (gap < difference -> S < D) /\ (difference < - gap -> D < S).
Proof.
  intros F P1 P2 Pa. assert (WD := plain_length F). assert (WS := plain_reach_squared F P1 P2 Pa).
  assert (H := h_positive).
  assert (X := Rle_0_sqr (bx - ax)). assert (Y := Rle_0_sqr (by_ - ay)). assert (Z := Rle_0_sqr (bz - az)). unfold Rsqr in X, Y, Z.
  assert (PD : 0 <= D) by (unfold D; lra). assert (PS : 0 <= S) by exact (Rle_0_sqr (r1 + r2 + alarm)). clear X Y Z.
  assert (WS' := WS). apply (within_more _ (5006 / 1000) 0 0) in WS'; try lra.
  assert (Wsum := within_plus _ _ _ _ _ _ _ WS' WD).
  apply within_RN in Wsum; try lra. fold sum in Wsum.
  unfold within in WD, WS, Wsum. apply Rabs_le_inv in WD. apply Rabs_le_inv in WS. apply Rabs_le_inv in Wsum.
  assert (G : (16 * u * ((D + S) * (1 - 7 * u) - 16 * h) + bpow radix2 (-950)) * (1 - u) - h <= gap).
  { unfold gap. destruct (one_rounding_with_underflow (sum * (16 * u) + bpow radix2 (-950))) as [e [k [E [K [_ R]]]]]. rewrite R.
    apply Rabs_le_inv in E. apply Rabs_le_inv in K. fold h in K.
    assert (B : bpow radix2 (-950) = 42535295865117307932921825928971026432 * h).
    { unfold h. replace (-950)%Z with (125 + -1075)%Z by lia. rewrite bpow_plus. apply Rmult_eq_compat_r. simpl. lra. }
    rewrite B in *.
    assert (L : 16 * u * ((D + S) * (1 - 7 * u) - 16 * h) <= sum * (16 * u)).
    { rewrite u_is in *. lra. }
    assert (N : 0 <= sum * (16 * u) + 42535295865117307932921825928971026432 * h).
    { rewrite u_is in *. lra. }
    assert (U : 0 < u < / 4) by (rewrite u_is; lra).
    nra. }
  assert (M : RN (5007 / 1000 * u * (D + S) + 8 * h) <= gap).
  { destruct (one_rounding_with_underflow (5007 / 1000 * u * (D + S) + 8 * h)) as [e [k [E [K [_ R]]]]]. rewrite R.
    apply Rabs_le_inv in E. apply Rabs_le_inv in K. fold h in K.
    assert (B : bpow radix2 (-950) = 42535295865117307932921825928971026432 * h).
    { unfold h. replace (-950)%Z with (125 + -1075)%Z by lia. rewrite bpow_plus. apply Rmult_eq_compat_r. simpl. lra. }
    rewrite B in G.
    assert (N : 0 <= 5007 / 1000 * u * (D + S) + 8 * h) by (rewrite u_is; lra).
    apply Rle_trans with ((5007 / 1000 * u * (D + S) + 8 * h) * (1 + u) + h); [nra|].
    apply Rle_trans with (2 := G). rewrite u_is. lra. }
  split; intros C.
  - apply Rnot_le_lt. intros X.
    assert (difference <= RN (5007 / 1000 * u * (D + S) + 8 * h)); [|lra].
    apply RN_monotone. rewrite u_is in *. lra.
  - apply Rnot_le_lt. intros X.
    assert (- RN (5007 / 1000 * u * (D + S) + 8 * h) <= difference); [|lra].
    rewrite <- RN_opposite. apply RN_monotone. rewrite u_is in *. lra.
Qed.

End Pair.

(* Sums of terms with errors of their own: three squares, none negative, some of them 0. *)
From Coq Require Import Reals Lra.
From Flocq Require Import Core.

Open Scope R_scope.

(* D' against D: each term within c of itself. *)
Lemma weighed_sum : forall c a b d a' b' d', 0 <= a -> 0 <= b -> 0 <= d ->
  Rabs (a' - a) <= c * a -> Rabs (b' - b) <= c * b -> Rabs (d' - d) <= c * d ->
  Rabs ((a' + b' + d') - (a + b + d)) <= c * (a + b + d).
Proof.
  intros c a b d a' b' d' _ _ _ Ha Hb Hd. apply Rabs_le.
  apply Rabs_le_inv in Ha. apply Rabs_le_inv in Hb. apply Rabs_le_inv in Hd. lra.
Qed.

(* D' - reach'^2 against D - reach^2, and their sums: in units of D + reach^2. *)
Lemma weighed_difference : forall c D S D' S', 0 <= D -> 0 <= S -> Rabs (D' - D) <= c * D -> Rabs (S' - S) <= c * S ->
  Rabs ((D' - S') - (D - S)) <= c * (D + S) /\ Rabs ((D' + S') - (D + S)) <= c * (D + S).
Proof.
  intros c D S D' S' _ _ HD HS. apply Rabs_le_inv in HD. apply Rabs_le_inv in HS. split; apply Rabs_le; lra.
Qed.

(* q.e: each |e_i| at most c |q_i|. *)
Lemma weighed_product : forall c qx qy qz ex ey ez, 0 <= c ->
  Rabs ex <= c * Rabs qx -> Rabs ey <= c * Rabs qy -> Rabs ez <= c * Rabs qz ->
  Rabs (qx * ex + qy * ey + qz * ez) <= c * (qx * qx + qy * qy + qz * qz).
Proof.
  intros c qx qy qz ex ey ez Hc Hx Hy Hz.
  assert (P : forall q e, Rabs e <= c * Rabs q -> Rabs (q * e) <= c * (q * q)).
  { intros q e H. rewrite Rabs_mult. replace (c * (q * q)) with (Rabs q * (c * Rabs q)).
    - apply Rmult_le_compat_l; [apply Rabs_pos | exact H].
    - rewrite <- (Rabs_pos_eq (q * q)) by nra. rewrite Rabs_mult. ring. }
  apply P in Hx. apply P in Hy. apply P in Hz.
  apply Rabs_le. apply Rabs_le_inv in Hx. apply Rabs_le_inv in Hy. apply Rabs_le_inv in Hz. lra.
Qed.

(* |e|^2 the same way. *)
Lemma weighed_squares : forall c qx qy qz ex ey ez, 0 <= c ->
  Rabs ex <= c * Rabs qx -> Rabs ey <= c * Rabs qy -> Rabs ez <= c * Rabs qz ->
  0 <= ex * ex + ey * ey + ez * ez <= c * c * (qx * qx + qy * qy + qz * qz).
Proof.
  intros c qx qy qz ex ey ez Hc Hx Hy Hz.
  assert (P : forall q e, Rabs e <= c * Rabs q -> e * e <= c * c * (q * q)).
  { intros q e H. rewrite <- (Rabs_pos_eq (e * e)), <- (Rabs_pos_eq (q * q)) by nra. rewrite !Rabs_mult.
    assert (0 <= Rabs e) by apply Rabs_pos. assert (0 <= Rabs q) by apply Rabs_pos. nra. }
  apply P in Hx. apply P in Hy. apply P in Hz. split; nra.
Qed.

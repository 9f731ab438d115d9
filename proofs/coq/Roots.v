(* The series of (1 - r)^(-1/2) and (1 - r)^(1/2) as far as they are used. *)
From Coq Require Import Reals Lra.
From Flocq Require Import Core.

Open Scope R_scope.

(* a^2 P <= 1 or >= 1, P = s^2, says on which side of 1 / s the positive a is. *)
Lemma above_inverse_root : forall a s, 0 < a -> 0 < s -> 1 <= a * a * (s * s) -> / s <= a.
Proof.
  intros a s Ha Hs H. apply Rmult_le_reg_r with s; [exact Hs|]. rewrite Rinv_l by lra.
  assert (0 < a * s) by now apply Rmult_lt_0_compat. nra.
Qed.

Lemma below_inverse_root : forall a s, 0 < a -> 0 < s -> a * a * (s * s) <= 1 -> a <= / s.
Proof.
  intros a s Ha Hs H. apply Rmult_le_reg_r with s; [exact Hs|]. rewrite Rinv_l by lra.
  assert (0 < a * s) by now apply Rmult_lt_0_compat. nra.
Qed.

Lemma inverse_root_series : forall r, Rabs r <= / 1048576 ->
  Rabs (/ sqrt (1 - r) - (1 + r / 2)) <= 3751 / 10000 * (r * r).
Proof.
  intros r H. apply Rabs_le_inv in H.
  assert (S : 0 < sqrt (1 - r)) by (apply sqrt_lt_R0; lra).
  assert (Q : sqrt (1 - r) * sqrt (1 - r) = 1 - r) by (apply sqrt_sqrt; lra).
  assert (B : 0 <= r * r) by nra.
  assert (B' : r * r <= / 1048576) by nra.
  assert (U : / sqrt (1 - r) <= 1 + r / 2 + 3751 / 10000 * (r * r)).
  { apply above_inverse_root; [nra | exact S |]. rewrite Q.
    set (k := 3751 / 10000).
    replace ((1 + r / 2 + k * (r * r)) * (1 + r / 2 + k * (r * r)) * (1 - r))
      with (1 + r * r * ((2 * k - 3 / 4) + r * (- k - / 4) + r * r * (k * k - k) - k * k * (r * (r * r)))) by field.
    assert (0 <= (2 * k - 3 / 4) + r * (- k - / 4) + r * r * (k * k - k) - k * k * (r * (r * r))).
    { unfold k. assert (- / 1048576 <= r * (r * r) <= / 1048576) by nra. lra. }
    nra. }
  assert (L : 1 + r / 2 - 3751 / 10000 * (r * r) <= / sqrt (1 - r)).
  { apply below_inverse_root; [nra | exact S |]. rewrite Q.
    set (k := 3751 / 10000).
    replace ((1 + r / 2 - k * (r * r)) * (1 + r / 2 - k * (r * r)) * (1 - r))
      with (1 + r * r * ((- 2 * k - 3 / 4) + r * (k - / 4) + r * r * (k * k + k) - k * k * (r * (r * r)))) by field.
    assert ((- 2 * k - 3 / 4) + r * (k - / 4) + r * r * (k * k + k) - k * k * (r * (r * r)) <= 0).
    { unfold k. assert (- / 1048576 <= r * (r * r) <= / 1048576) by nra. lra. }
    nra. }
  apply Rabs_le. lra.
Qed.

Lemma root_series : forall r, Rabs r <= / 1048576 ->
  0 <= (1 - r / 2) - sqrt (1 - r) <= 1251 / 10000 * (r * r).
Proof.
  intros r H. apply Rabs_le_inv in H.
  assert (S : 0 < sqrt (1 - r)) by (apply sqrt_lt_R0; lra).
  assert (Q : sqrt (1 - r) * sqrt (1 - r) = 1 - r) by (apply sqrt_sqrt; lra).
  assert (B : 0 <= r * r) by nra.
  assert (B' : r * r <= / 1048576) by nra.
  split.
  - assert (sqrt (1 - r) <= 1 - r / 2); [|lra]. apply Rsqr_incr_0_var; [|lra]. unfold Rsqr. rewrite Q. nra.
  - assert (1 - r / 2 - 1251 / 10000 * (r * r) <= sqrt (1 - r)); [|lra].
    apply Rsqr_incr_0_var; [|lra]. unfold Rsqr. rewrite Q. set (k := 1251 / 10000).
    replace ((1 - r / 2 - k * (r * r)) * (1 - r / 2 - k * (r * r)))
      with (1 - r + r * r * (k * k * (r * r) + k * r + / 4 - 2 * k)) by field.
    assert (k * k * (r * r) + k * r + / 4 - 2 * k <= 0) by (unfold k; lra).
    nra.
Qed.

(* The same about 1 + x, which is what the fast stage of one pair and the oracle take the root of. *)
Lemma root_series_above : forall x, Rabs x <= / 1048576 ->
  0 <= (1 + x / 2) - sqrt (1 + x) <= 1251 / 10000 * (x * x).
Proof.
  intros x H. assert (P := root_series (- x)). rewrite Rabs_Ropp in P. specialize (P H).
  replace (1 - - x / 2) with (1 + x / 2) in P by field. replace (1 - - x) with (1 + x) in P by ring.
  replace (- x * - x) with (x * x) in P by ring. exact P.
Qed.

(* Errors that are linear in two lengths: the scripts bound the share of each, with the other 0. *)
From Coq Require Import Reals Lra.
From Flocq Require Import Core.

Open Scope R_scope.

Lemma linear : forall a b w h x y, Rabs a <= x -> Rabs b <= y -> Rabs (a * w + b * h) <= x * Rabs w + y * Rabs h.
Proof.
  intros a b w h x y Ha Hb. apply Rle_trans with (1 := Rabs_triang _ _). rewrite !Rabs_mult.
  apply Rplus_le_compat; apply Rmult_le_compat_r; try apply Rabs_pos; assumption.
Qed.

(* point(): the steps of batch_sphere_sphere.cpp, each with its rounding, and the two shares of point.g. *)
Lemma point_is_linear : forall c w h rq rlow p g l v ew eh ep e1 e2 e3 low dn,
  rq = w * (1 + ew) -> c + w = h * (1 + eh) -> p = (h - c) * (1 + ep) -> g = c - (h - p) ->
  rlow = rq * low -> v = (rlow + (rq - p) * (1 + e1)) * (1 + e2) -> l = (g + v) * (1 + e3) ->
  let lw := (ep + ((1 + ew) * low + (ew - ep) * (1 + e1)) * (1 + e2)) * (1 + e3) in
  let ow := (1 + ew) * (1 + low + dn) - 1 - lw in
  let lh := (eh * (1 + ep) * (1 + e1) * (1 + e2) - eh * ep) * (1 + e3) in
  l = lw * w + lh * h /\ c + rq * (1 + low + dn) - (h + l) = ow * w + (eh - lh) * h.
Proof.
  intros c w h rq rlow p g l v ew eh ep e1 e2 e3 low dn Hrq Hc Hp Hg Hrlow Hv Hl.
  assert (c = h * (1 + eh) - w) by lra. subst. cbv zeta. split; ring.
Qed.

(* rounded_point() of one vector, and the fast stage of one pair: the residual of w and the rest of c + w are exact. *)
Lemma point_of_one_vector_is_linear : forall c w h rq rest v l ew eh e2 e3 low dn,
  rq = w * (1 + ew) -> c + w = h * (1 + eh) -> rest = c + w - h ->
  v = (rq * low + (rq - w)) * (1 + e2) -> l = (rest + v) * (1 + e3) ->
  let lw := ((1 + ew) * low + ew) * (1 + e2) * (1 + e3) in
  let ow := (1 + ew) * (1 + low + dn) - 1 - lw in
  let lh := eh * (1 + e3) in
  l = lw * w + lh * h /\ c + rq * (1 + low + dn) - (h + l) = ow * w + (eh - lh) * h.
Proof.
  intros c w h rq rest v l ew eh e2 e3 low dn Hrq Hc Hrest Hv Hl.
  assert (c = h * (1 + eh) - w) by lra. subst. cbv zeta. split; ring.
Qed.

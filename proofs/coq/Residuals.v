(* Residuals of quotients and roots: a fused operation gives them exactly. Exponents are unbounded here; within the ranges that the code
   asks for nothing underflows. *)
From Coq Require Import Reals.
From Flocq Require Import Core Div_sqrt_error.
Require Import Rounding.

Open Scope R_scope.

Definition wide := FLX_exp prec.
Definition RNwide := round radix2 wide ZnearestE.

Lemma RNwide_keeps : forall x, generic_format radix2 wide x -> RNwide x = x.
Proof. intros x F. apply round_generic; auto with typeclass_instances. Qed.

(* RN(x - q y), q = RN(x / y): the remainder of a quotient. *)
Lemma quotient_residual : forall x y, generic_format radix2 wide x -> generic_format radix2 wide y ->
  RNwide (x - RNwide (x / y) * y) = x - RNwide (x / y) * y.
Proof. intros x y Fx Fy. apply RNwide_keeps. apply div_error_FLX; auto with typeclass_instances. Qed.

(* RN(x - s^2), s = RN(sqrt x). *)
Lemma root_residual : forall x, generic_format radix2 wide x ->
  RNwide (x - RNwide (sqrt x) * RNwide (sqrt x)) = x - RNwide (sqrt x) * RNwide (sqrt x).
Proof.
  intros x Fx. apply RNwide_keeps.
  replace (RNwide (sqrt x) * RNwide (sqrt x)) with (Rsqr (RNwide (sqrt x))) by reflexivity.
  apply sqrt_error_FLX_N; auto with typeclass_instances. reflexivity.
Qed.

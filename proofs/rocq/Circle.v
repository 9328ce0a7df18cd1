(* Products of P + Q cos at equidistant angles, by doubling. *)
From Coq Require Import Reals Lra Lia Psatz.
Open Scope R_scope.

Fixpoint product n (F : nat -> R) := match n with O => 1 | S n => product n F * F n end.
Lemma product_ext n F G : (forall j, F j = G j) -> product n F = product n G.
Proof. intros E; induction n as [|n IH]; simpl; [|rewrite IH, E]; reflexivity. Qed.
Lemma product_split n m F : product (n + m) F = product n F * product m (fun j => F (n + j)%nat).
Proof. induction m as [|m IH]; [rewrite Nat.add_0_r; simpl; ring | rewrite Nat.add_succ_r; simpl; rewrite IH; ring]. Qed.
Lemma product_mult n F G : product n F * product n G = product n (fun j => F j * G j).
Proof. induction n as [|n IH]; simpl; [ring | rewrite <- IH; ring]. Qed.

Lemma power_half k : INR (2 ^ k) * (/2) ^ k = 1.
Proof.
induction k as [|k IH]; [simpl; ring |].
replace (2 ^ S k)%nat with (2 * 2 ^ k)%nat by (simpl; lia); rewrite mult_INR; change ((/2) ^ S k) with (/2 * (/2) ^ k); change (INR 2) with 2; rewrite <- IH; field.
Qed.

(* The product over 2^k angles is P' + Q' cos(2^k y). *)
Lemma doubling k : forall P Q, Rabs Q < Rabs P -> Q <> 0 -> exists P' Q', P' * Q' <> 0 /\
  forall y, product (2 ^ k) (fun j => P + Q * cos (y - 2 * PI * (INR j * (/2) ^ k))) = P' + Q' * cos (INR (2 ^ k) * y).
Proof.
induction k as [|k IH]; intros P Q A Z.
- exists P, Q; split.
  + assert (P <> 0) by (intros ->; rewrite Rabs_R0 in A; generalize (Rabs_pos Q); lra).
    apply Rmult_integral_contrapositive; split; assumption.
  + intros y; simpl; rewrite Rmult_0_l, Rmult_0_r, Rminus_0_r, !Rmult_1_l; reflexivity.
- assert (S2 : Q * Q < P * P) by (apply Rsqr_lt_abs_1 in A; exact A).
  assert (0 < Q * Q) by (destruct (Rtotal_order Q 0) as [|[|]]; nra).
  destruct (IH (P * P - Q * Q / 2) (- (Q * Q / 2))) as [P' [Q' [N E]]].
  + rewrite Rabs_Ropp, !Rabs_pos_eq; lra.
  + lra.
  + exists P', Q'; split; [assumption |]; intros y.
    replace (2 ^ S k)%nat with (2 ^ k + 2 ^ k)%nat by (simpl; lia).
    rewrite product_split, product_mult, plus_INR.
    replace ((INR (2 ^ k) + INR (2 ^ k)) * y) with (INR (2 ^ k) * (2 * y)) by ring; rewrite <- E.
    apply product_ext; intros j; rewrite plus_INR.
    set (a := y - 2 * PI * (INR j * (/2) ^ S k)).
    replace (y - 2 * PI * ((INR (2 ^ k) + INR j) * (/ 2) ^ S k)) with (a - PI).
    2: { unfold a; simpl; assert (T := power_half k).
      replace (2 * PI * ((INR (2 ^ k) + INR j) * (/ 2 * (/ 2) ^ k)))
        with (PI * (INR (2 ^ k) * (/ 2) ^ k) + 2 * PI * (INR j * (/ 2 * (/ 2) ^ k))) by field; rewrite T; ring. }
    replace (2 * y - 2 * PI * (INR j * (/ 2) ^ k)) with (2 * a) by (unfold a; simpl; field).
    rewrite cos_minus, cos_PI, sin_PI, cos_2a_cos; field.
Qed.

(* Over two turns: at y = 0 it is not what it is at y = -PI / 2^k. *)
Lemma two_turns k P Q : Rabs Q < Rabs P -> Q <> 0 -> let n := (2 ^ k + 2 ^ k)%nat in let t := PI * (/2) ^ k in
  Rabs (product n (fun j => P + Q * cos (- (2 * INR j * t)))) <> Rabs (product n (fun j => P + Q * cos (- t - 2 * INR j * t))).
Proof.
intros A Z n t; destruct (doubling k P Q A Z) as [P' [Q' [N E]]].
assert (twice : forall y, product n (fun j => P + Q * cos (y - 2 * INR j * t)) = (P' + Q' * cos (INR (2 ^ k) * y)) * (P' + Q' * cos (INR (2 ^ k) * y))).
{ intros y; unfold n; rewrite product_split; rewrite <- E; f_equal; apply product_ext; intros j; do 2 f_equal.
  - f_equal; unfold t; ring.
  - rewrite plus_INR; replace (y - 2 * (INR (2 ^ k) + INR j) * t) with (y - 2 * PI * (INR j * (/ 2) ^ k) - 2 * PI * (INR (2 ^ k) * (/2) ^ k))
      by (unfold t; ring).
    rewrite power_half, Rmult_1_r, cos_minus, cos_2PI, sin_2PI; ring. }
rewrite (product_ext n _ (fun j => P + Q * cos (0 - 2 * INR j * t))) by (intros; do 3 f_equal; ring).
rewrite !twice, Rmult_0_r, cos_0.
replace (INR (2 ^ k) * - t) with (- PI) by (unfold t; replace (INR (2 ^ k) * - (PI * (/ 2) ^ k)) with (- (PI * (INR (2 ^ k) * (/2) ^ k))) by ring; rewrite power_half; ring).
assert (sq : forall a, Rabs (a * a) = a * a) by (intros; apply Rabs_pos_eq; nra).
rewrite cos_neg, cos_PI, !sq; intros F; apply N; lra.
Qed.

(* Matrices of rational numbers, as lists of rows, for points at which hypotheses hold and printed statements fail.
   What does not fit together is the matrix of no rows, which equals nothing. *)

Require Import QArith List Bool.
Import ListNotations.

Definition matrix := list (list Q).
Definition columns (A : matrix) : nat := match A with [] => O | row :: _ => length row end.
Definition fits (A B : matrix) : bool := Nat.eqb (length A) (length B) && Nat.eqb (columns A) (columns B).

Fixpoint zipped {X Y Z} (f : X -> Y -> Z) (xs : list X) (ys : list Y) : list Z :=
  match xs, ys with x :: xs, y :: ys => f x y :: zipped f xs ys | _, _ => [] end.
Definition inner (x y : list Q) : Q := fold_right (fun a s => Qred (a + s)) 0 (zipped Qmult x y).
Definition transposed (A : matrix) : matrix := map (fun j => map (fun row => nth j row 0) A) (seq 0 (columns A)).
Definition plus (A B : matrix) : matrix := if fits A B then zipped (zipped (fun x y => Qred (x + y))) A B else [].
Definition times (A B : matrix) : matrix :=
  if Nat.eqb (columns A) (length B) then map (fun row => map (inner row) (transposed B)) A else [].
Definition scaled (c : Q) (A : matrix) : matrix := map (map (fun x => Qred (c * x))) A.
Definition unit_matrix (n : nat) : matrix :=
  map (fun i => map (fun j => if Nat.eqb i j then 1 else 0) (seq 0 n)) (seq 0 n).
Definition trace (A : matrix) : Q := fold_right (fun i s => Qred (nth i (nth i A []) 0 + s)) 0 (seq 0 (length A)).
Definition zero_matrix (n m : nat) : matrix := repeat (repeat 0 m) n.
Definition equal (A B : matrix) : bool :=
  fits A B && negb (Nat.eqb (length A) 0) && forallb (fun x => x) (concat (zipped (zipped Qeq_bool) A B)).

Declare Scope matrix_scope.
Delimit Scope matrix_scope with M.
Bind Scope matrix_scope with matrix.
Infix "+" := plus : matrix_scope.
Infix "*" := times : matrix_scope.
Notation "c *: A" := (scaled c%Q A) (at level 40) : matrix_scope.
Notation "A == B" := (equal A B = true) : matrix_scope.

Ltac at_this_point :=
  repeat match goal with |- _ /\ _ => split end;
  match goal with |- ~ _ => intros H; vm_compute in H; discriminate H | _ => vm_compute; reflexivity end.

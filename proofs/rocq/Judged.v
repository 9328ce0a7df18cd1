(* The theorem is that of the page, by its full name; what it rests on is compared with axioms.txt. *)
Require Chaplygin.Statement Chaplygin.MeasureIff.
Theorem judged : Chaplygin.Statement.measure_iff.
Proof Chaplygin.MeasureIff.measure_iff_holds.
Print Assumptions judged.

"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""

TEXT = "37ea237ad0c6d9b694f2b1b954a3ba96c4c45a131eb503fb1370583b7231a934"

"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""

TEXT = "d8dc542d5e0712239998cfd8108a9e996bb391dbfab5acedd2bcf0844b91901e"

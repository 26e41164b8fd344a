"""Work-precision: error against CPU time of emitted methods and peers, and the fastest for an accuracy."""

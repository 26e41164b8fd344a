"""Work-precision diagrams of emitted methods and peers, and the fastest method for each accuracy."""

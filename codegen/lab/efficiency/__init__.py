"""Work-precision diagrams of emitted methods and of peers (other integrators), and the fastest method for
each accuracy."""

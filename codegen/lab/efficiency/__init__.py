"""Work-precision diagrams of emitted methods and of peers (other integrators), and the search for the fastest
method that reaches an accuracy."""

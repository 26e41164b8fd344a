"""What surrounds a kernel at run time: the solver of implicit stages and its choice."""

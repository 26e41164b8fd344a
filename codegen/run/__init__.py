"""This package adds solvers, warm start, continuation, step control and trajectories to the arithmetic of a
step."""

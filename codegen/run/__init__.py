"""This package builds the emitted code around the arithmetic of a step: solvers, warm start, continuation,
step control and trajectories."""

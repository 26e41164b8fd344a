"""The emitted code around the arithmetic of a step: solvers, warm start, continuation, step control,
trajectories."""

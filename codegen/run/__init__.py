"""The code around a kernel: solvers, warm start, continuation, step control, trajectories."""

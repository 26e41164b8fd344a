"""Builds the emitted functions from the formulas of a step: solvers, step control and trajectories."""

"""Exact flows of the parts of a Hamiltonian: closed forms, and their recognition from formulas."""

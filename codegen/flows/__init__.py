"""Exact flows of the parts of a Hamiltonian: one file for each kind of flow, and recognition from formulas.

The interface of a flow is :class:`codegen.scene.flow.Flow`.
"""

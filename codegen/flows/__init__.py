"""Exact flows of the parts of a Hamiltonian: one file a kind of flow, and their recognition from formulas.

The interface of a flow is :class:`codegen.scene.flow.Flow`.
"""

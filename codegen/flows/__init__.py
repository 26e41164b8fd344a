"""Exact flows of the parts of a Hamiltonian, with one file for each kind of flow. The module ``recognise``
finds the flow of a part from the formula of the part.

The interface of a flow is :class:`codegen.scene.flow.Flow`.
"""

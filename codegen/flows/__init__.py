"""Exact flows of the parts of a Hamiltonian. One file defines each kind of flow; the module ``recognise``
finds the flow of a part from the formula of the part.

The interface of a flow is :class:`codegen.scene.flow.Flow`.
"""

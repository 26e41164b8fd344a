"""Exact flows of the parts of a Hamiltonian.

A part is one summand of the Hamiltonian, such as the kinetic energy. The interface of a flow is
:class:`codegen.scene.flow.Flow`.
"""

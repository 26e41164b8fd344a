"""Exact flows of the parts of a Hamiltonian. Each kind of flow has its own file.

A part is one summand of the Hamiltonian, such as the kinetic energy. The module ``recognise`` finds the flow
of a part from the formula of the part.

The interface of a flow is :class:`codegen.scene.flow.Flow`.
"""

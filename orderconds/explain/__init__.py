"""Explanations of conditions: drawings of trees, and the elementary differentials or Hamiltonians they name.

``diagram`` turns every kind of tree into one record of vertices and edges, ``lines`` draws that as text,
``svg`` as a picture; ``differentials`` names trees; ``kinds`` lists all kinds with their members and numbers.
"""

"""Explanations of conditions: drawings of trees, and their elementary differentials or Hamiltonians.

``diagram`` turns every kind of tree into one record of vertices and edges, ``lines`` draws this record as
text, ``svg`` as a picture. ``differentials`` writes elementary differentials. ``kinds`` lists all kinds with
their members and numbers.
"""

"""Explanations of conditions: drawings of trees, and their elementary differentials or Hamiltonians.

The module ``diagram`` converts a tree of any kind to a diagram of vertices and edges. The module ``lines``
draws a diagram as text, ``svg`` and ``tikz`` draw it as a picture. ``differentials`` returns elementary
differentials as text. ``kinds`` defines all kinds of trees, with functions that enumerate and count the
trees.
"""

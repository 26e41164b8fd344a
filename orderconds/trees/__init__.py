"""Trees and forests, represented as bytes. The bytes are the levels of the vertices in preorder, with the
root at level 0.

``rooted`` enumerates unordered rooted trees. ``ordered`` enumerates planar rooted trees and their forests.
``directed`` enumerates rooted and free trees with directed edges. ``levels`` contains functions for all level
sequences. ``counts`` computes the numbers of trees from generating functions.
"""

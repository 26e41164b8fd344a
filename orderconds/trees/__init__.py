"""Trees and forests, represented as bytes. The bytes of a tree are the levels of its vertices in preorder.
These bytes are called the level sequence. The root has level 0.

``rooted`` enumerates unordered rooted trees. ``ordered`` enumerates planar rooted trees and their forests.
``directed`` enumerates rooted and free trees with directed edges. ``levels`` contains functions for level
sequences. ``counts`` computes the numbers of trees from generating functions.
"""

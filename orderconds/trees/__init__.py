"""Trees and forests as bytes: the level sequence in preorder, the root at level 0.

``rooted`` enumerates unordered rooted trees, ``ordered`` planar ones and their forests, ``directed`` rooted
and free trees with directed edges. ``levels`` has the functions common to all level sequences. ``counts``
computes the numbers of trees from generating functions.
"""

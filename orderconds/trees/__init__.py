"""Trees and forests as bytes: the level sequence in preorder, the root at level 0.

``rooted`` enumerates unordered rooted trees, ``ordered`` planar ones and their forests, ``directed`` rooted
and free trees whose edges carry a direction; ``levels`` has the functions common to all level sequences,
``counts`` their numbers by generating functions.
"""

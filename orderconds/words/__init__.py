"""Words over a graded alphabet: Lyndon words, shuffles and concatenation, free Lie elements, expansions.

A word is a tuple of letters, a series a mapping from words to rational numbers. A word t_1 ... t_k that
represents a map is written in the order of action: t_1 acts first (``expansions``). In ``lie``, ``hall`` and
``bch``, which concern brackets only, the word xy is the product xy.
"""

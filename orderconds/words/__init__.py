"""Words over a graded alphabet: Lyndon words, shuffles and concatenation, free Lie elements, expansions.

A word is a tuple of letters. A series is a mapping from words to rational numbers. If a word t_1 ... t_k
represents a map, it is written in the order of action: t_1 acts first (``expansions``). The modules ``lie``,
``hall`` and ``bch`` contain brackets only; in these modules the word xy denotes the product xy.
"""

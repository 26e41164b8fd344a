"""Words over a graded alphabet: Lyndon words, shuffles and concatenation, free Lie elements, expansions.

A word is a tuple of letters. A series is a mapping from words to rational numbers. In the module
``expansions``, a word t_1 ... t_k represents a composition of maps in the order of action: t_1 acts first. In
the modules ``lie``, ``hall`` and ``bch``, which compute with brackets, the word xy denotes the product xy.
"""

"""Words over a graded alphabet: Lyndon words, shuffles and concatenation, free Lie elements, expansions.

A word is a tuple of letters, a series a mapping from words to rational numbers. Words t_1 ... t_k are
written in the order of action, t_1 acting first, wherever they represent maps (``expansions``); in ``lie``,
``hall`` and ``bch``, which are about brackets alone, the word xy is the product xy.
"""

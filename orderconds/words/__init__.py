"""Words over a graded alphabet: Lyndon words, shuffles and concatenation, free Lie elements, expansions.

A word is a tuple of letters. A series is a mapping from words to rational numbers. In the module
``expansions``, the first letter of a word acts first, so a word denotes the product of its letters in reverse
order. In the modules ``lie``, ``hall`` and ``bch``, which compute with brackets, a word denotes the product
of its letters in the written order.
"""

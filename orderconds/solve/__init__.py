"""The search for methods: numerical search, certification of the solutions, closed forms of coefficients, and
proofs that no method exists."""

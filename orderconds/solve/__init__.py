"""Search for methods: numerical search for coefficients, proofs of the order conditions, closed forms of
coefficients, and proofs that no method exists."""

"""Search for methods: numerical search, proof of the solutions, closed forms of coefficients, and proofs that
no method exists."""

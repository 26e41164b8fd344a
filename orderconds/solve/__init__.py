"""The search for methods: numerical search, certification, closed forms, and proofs that no method exists."""

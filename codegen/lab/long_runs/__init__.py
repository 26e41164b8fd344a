"""Long runs: drift of conserved quantities, growth of rounding errors, symplecticity, reversibility."""

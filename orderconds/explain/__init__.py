"""Explanations of conditions: drawings of trees, and their elementary differentials or Hamiltonians."""

"""Explanations of conditions: tree drawings, elementary differentials and elementary Hamiltonians."""

"""Order conditions for papers and notebooks, in LaTeX and HTML.

The LaTeX text contains numbered equations with labels, diagrams of trees, and a legend.
"""

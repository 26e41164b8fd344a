"""Order conditions for papers and notebooks, in LaTeX and HTML. The LaTeX text contains trees, labels and a
legend."""

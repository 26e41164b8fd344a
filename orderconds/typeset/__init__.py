"""Order conditions for papers and notebooks: LaTeX with trees, labels and a legend, and HTML."""

"""Order conditions as papers and notebooks show them: LaTeX with trees, labels and a legend, and HTML."""

"""The pages of the report: figures, formulas and numbers as HTML, and whole documents."""

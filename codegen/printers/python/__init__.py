"""Python: one module that needs the standard library and nothing else."""

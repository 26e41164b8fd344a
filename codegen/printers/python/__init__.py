"""Python: one module that needs only the standard library."""

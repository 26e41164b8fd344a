"""The backend: it translates the program of a step to a kernel, an ordered list of scalar statements."""

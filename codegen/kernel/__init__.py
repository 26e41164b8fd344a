"""The backend: it translates the program of a step to a kernel, which is a sequence of statements."""

"""The backend translates the program of a step to a kernel, a sequence of statements."""

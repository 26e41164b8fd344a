"""The backend, which translates a step program to a kernel of scheduled scalar statements."""

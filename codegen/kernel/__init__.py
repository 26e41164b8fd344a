"""The backend: a step program becomes a kernel of scheduled scalar statements."""

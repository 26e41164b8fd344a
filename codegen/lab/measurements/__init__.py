"""The measurements of the report, one class a file."""

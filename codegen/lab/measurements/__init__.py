"""The measurements of the report, one class in each file."""

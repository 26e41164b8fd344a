"""The measurements of the report. Each module defines one measurement with one section."""

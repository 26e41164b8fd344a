"""The measurements of the report. Each module defines one measurement, which writes one section."""

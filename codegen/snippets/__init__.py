"""Run-time helpers of emitted code. An emitted module contains only the helpers that it calls."""

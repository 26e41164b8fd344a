"""Run-time helpers of emitted code; a module contains only the helpers that it calls."""

"""Observed orders from step-size sequences, and exact orders from local errors over Q[[h]]."""

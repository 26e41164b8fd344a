"""Run-time helpers that emitted code may call, pulled in only with what uses them."""

"""The compiler's commands, a module each, found by the command line through entry points."""

"""The commands of the compiler, one module each; the command line finds them through entry points."""

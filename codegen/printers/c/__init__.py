"""C11: no allocation, no global variables, no warnings; every external name starts with one prefix."""

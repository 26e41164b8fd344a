"""C11: no allocation, no globals, no warnings; every external name under one prefix."""

"""A step has two intermediate representations: step programs and kernels. The variables of a step program
are elements of Lie groups and Lie algebras. The variables of a kernel are scalars."""

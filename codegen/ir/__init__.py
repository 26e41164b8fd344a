"""The two intermediate representations: step programs and kernels. The variables of step programs are
elements of Lie groups and Lie algebras. The variables of kernels are scalars."""

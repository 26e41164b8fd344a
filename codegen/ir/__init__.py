"""The two intermediate representations: step programs, whose variables are elements of Lie groups and Lie
algebras, and kernels, whose variables are scalars."""

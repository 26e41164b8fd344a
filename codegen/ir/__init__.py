"""The intermediate representations: step programs over Lie group types, kernels over scalars."""

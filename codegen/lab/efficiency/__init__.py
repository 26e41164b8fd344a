"""Compares the CPU times of methods that reach the same accuracy.

The package draws work-precision diagrams of emitted methods and of peers (other integrators). The
package also searches the library for the fastest method that reaches a given accuracy.
"""

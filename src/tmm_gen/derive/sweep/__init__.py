"""Sweeps over a chain of elements: Riccati recursion and plain product."""

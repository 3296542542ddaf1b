"""Runs of generated kernels, and how far they are to be trusted."""

"""Measurements of generated kernels: independent references, errors, stability, speed."""

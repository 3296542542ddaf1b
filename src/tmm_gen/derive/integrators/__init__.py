"""Time integrators: one short file each, declared by their defining formulas."""

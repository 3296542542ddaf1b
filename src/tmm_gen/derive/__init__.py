"""Physics to expressions: elements, integrators, transfer matrices and sweeps, all in SymPy."""

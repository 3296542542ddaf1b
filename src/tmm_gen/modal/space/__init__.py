"""Arms in space about rest: equilibria, modes, frequency responses."""

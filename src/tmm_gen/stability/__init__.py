"""Where a scene stands against the limits of integrators."""

"""Arms in space, in the axes of their links: from velocities and kinetic energies to the recursion of a sweep."""

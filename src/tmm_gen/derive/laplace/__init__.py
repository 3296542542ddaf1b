"""The Laplace domain: transfer functions of chains, and the planar elements linearised at rest."""

"""The Laplace domain: system matrices and transfer functions of chains, and the planar elements linearised at rest."""

"""Independent truths: other equations, other solvers; nothing of derive, program or emit."""

"""How many digits a step of a chain keeps: what rounding, and what a plain product of matrices, leaves of them."""

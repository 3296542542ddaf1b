"""`tmm-gen check`: backends against each other and against references."""

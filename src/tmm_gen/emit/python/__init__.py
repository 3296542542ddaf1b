"""What the backends that write Python share: expressions, lines, names."""

"""Elements, each declared by its equations."""

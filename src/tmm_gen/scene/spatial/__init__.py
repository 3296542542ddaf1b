"""Arms in space: what a scene's parts make of them."""

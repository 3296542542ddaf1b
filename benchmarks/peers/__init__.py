"""Other people's way to compute a step, to compare speed with."""

"""Reading URDF, and writing the scene that it says."""

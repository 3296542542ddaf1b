"""The program of a planar arm with large rotations."""

"""The program of a torsional chain."""

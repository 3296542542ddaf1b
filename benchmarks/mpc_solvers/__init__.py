"""The task of `mpc_speed.py`, and other people's solvers of it."""

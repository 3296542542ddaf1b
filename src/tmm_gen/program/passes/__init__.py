"""Passes: each takes routines and returns routines that compute the same values."""

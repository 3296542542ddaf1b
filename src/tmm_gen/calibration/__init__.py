"""Fitting a scene to a recorded response, with how sure each number is."""

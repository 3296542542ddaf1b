"""Steps chosen by a tolerance."""

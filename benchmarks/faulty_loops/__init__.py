"""Closed loops of emitted controllers whose sensors fail for a while, all in C."""

"""The quadratic program of a sample: condensed, bounded, solved."""

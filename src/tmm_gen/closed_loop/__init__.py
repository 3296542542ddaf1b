"""Controllers on a finer plant: loops, what is measured of them, comparisons, tuning."""

"""Where a scene stands against the derived limits of stability, and maps of growth: derived and measured."""

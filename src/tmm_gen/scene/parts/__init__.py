"""Arms written as parts that hang on each other by name: their tables, their order, and the row of links they make."""

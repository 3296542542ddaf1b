"""How a step follows its state and inputs: exact tangents with the factors of the step's own sweep."""

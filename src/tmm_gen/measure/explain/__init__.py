"""What a scene makes the generator model, what it leaves out, and what each would cost: counted, not estimated."""

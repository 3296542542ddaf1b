"""What a scene models and what it leaves out."""

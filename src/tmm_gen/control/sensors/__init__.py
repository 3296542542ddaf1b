"""What the sensors of an arm show."""

"""What state an arm is in, by what its sensors show."""

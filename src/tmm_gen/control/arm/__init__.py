"""What controllers know of an arm: its motors, its frames, its payload, its balance; in a plane or in space."""

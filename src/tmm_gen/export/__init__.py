"""The same arm for other tools: functional mock-up units and MuJoCo models."""

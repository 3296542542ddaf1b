"""The trade between speed and accuracy: configurations of a scene, their errors, their cost."""

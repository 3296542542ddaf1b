"""An arm as a row of elements: the single thing between a scene and what is derived from it."""

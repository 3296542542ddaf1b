"""Error against cost: trade, tune, their store and workers."""

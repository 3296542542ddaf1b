"""A page on which the reader plays with an arm: its emitted C as WebAssembly, and nothing from elsewhere."""

"""Form-finding by finite elements: one core of its own, and methods that are objectives over it."""

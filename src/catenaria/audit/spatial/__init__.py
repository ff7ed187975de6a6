"""The audit of lines in space, whose wires are found all at once."""

"""Methods that find the form of a line."""

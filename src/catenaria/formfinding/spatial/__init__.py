"""Form-finding for lines in space: the whole line at once, by Newton's method or as a controlled motion."""

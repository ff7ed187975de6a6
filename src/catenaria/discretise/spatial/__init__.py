"""Lines of any number of wires in three dimensions: laid out, guessed, modelled as one system, read back."""

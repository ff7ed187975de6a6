"""Closed forms: starting guesses, and what numerical results are compared with."""

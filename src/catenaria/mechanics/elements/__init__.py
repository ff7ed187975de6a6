"""Finite elements, one formulation a file."""

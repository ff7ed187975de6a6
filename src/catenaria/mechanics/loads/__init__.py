"""Loads, inertia and damping."""

"""Joints, one formulation a file."""

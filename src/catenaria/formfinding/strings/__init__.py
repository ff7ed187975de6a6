"""Form-finding for wires without bending stiffness: independent formulations of strings."""

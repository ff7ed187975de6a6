"""Controls: a parameter, a measure, a target and a velocity law."""

"""Systems of cables, joints, loads and controls: residuals and exact Jacobians."""

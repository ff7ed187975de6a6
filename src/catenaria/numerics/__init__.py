"""Small numerical tools without mechanics: quadrature, shape functions, smooth steps."""

"""After form-finding: a found line under loads, with errors of its installation, and as measured."""

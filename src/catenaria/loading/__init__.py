"""After form-finding: what a found line does under loads, with errors of its installation, and as measured."""

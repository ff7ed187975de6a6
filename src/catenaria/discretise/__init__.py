"""From a line to systems, from states to results: the bridge between engineering and mechanics."""

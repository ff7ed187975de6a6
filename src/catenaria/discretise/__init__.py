"""From a line to systems, and from states back to results: the only bridge between engineering and mechanics."""

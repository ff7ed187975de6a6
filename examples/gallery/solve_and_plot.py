"""Solve the line of Yang et al. 2017 and look at it: schedule, places, figures.

    python examples/gallery/solve_and_plot.py

Draws solve_and_plot.png into the current folder.
"""

# %% [markdown]
# # Solve a line and look at it
#
# The line of section 5 of Yang et al. 2017: three spans of 65 m, both wires at 15 kN, 21 droppers. What
# is looked for are the lengths to which the droppers must be cut, so that the contact wire is level.

# %%
from pathlib import Path

from rich import print as show

import catenaria

EXAMPLES = Path(__file__).resolve().parents[1]

result = catenaria.solve(EXAMPLES / "yang2017_three_span.yaml")
show(result)

# %% [markdown]
# ## The dropper schedule
#
# A pandas data frame, like every table; the names of its columns say the unit. A result is worth
# something if its audit and its rebuild passed.

# %%
if not result.passed:
    raise SystemExit("audit or rebuild failed")
schedule = result.droppers[["span", "dropper", "x_m", "cut_length_m", "force_bottom_N"]]
show(schedule.round(4).to_string(index=False))

# %% [markdown]
# ## One place
#
# In the middle of the second span, and half way from there to the next dropper.

# %%
middle = result.at(97.5)
beside = result.at(97.5 + 4.75)
show(middle, beside)
sag = middle.wire("contact wire").height - beside.wire("contact wire").height
show(f"Between two droppers the contact wire sags by {1e3 * sag:.1f} mm.")

# %% [markdown]
# ## Figures
#
# `plan()`, `tension(wire)` and `moments()` are drawn in the same way.

# %%
figure = result.plot.profile()
figure.savefig("solve_and_plot.png", dpi=100)

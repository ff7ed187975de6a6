"""Find the same line by every method, and compare the lengths to which droppers would be cut.

    python examples/gallery/compare_methods.py

Draws compare_methods.png into the current folder.
"""

# %% [markdown]
# # Compare methods
#
# All methods find the line of Yang et al. 2017. Those for strings neglect that wires bend, which the
# paper's line shows in its dropper lengths; those with finite elements do not; the dynamic method stops
# within its dead bands.

# %%
from pathlib import Path
from time import perf_counter

import numpy as np
import pandas as pd
from matplotlib.figure import Figure
from rich import print as show

import catenaria

EXAMPLES = Path(__file__).resolve().parents[1]

line = catenaria.load(EXAMPLES / "yang2017_three_span.yaml")
reference = catenaria.solve(line, "direct", rebuild="none")
length = reference.droppers["length_m"].to_numpy()

# %% [markdown]
# ## All of them
#
# A difference is positive where a dropper is longer than by the direct method. Times are those of a first
# run.

# %%
rows: dict[str, dict[str, float | bool]] = {}
for method in catenaria.METHODS:
    begin = perf_counter()
    result = catenaria.solve(line, method, rebuild="none")
    difference = result.droppers["length_m"].to_numpy() - length
    rows[method] = {
        "largest_mm": 1e3 * float(np.abs(difference).max()),
        "mean_mm": 1e3 * float(difference.mean()),
        "bends": result.form.physics != "string",
        "time_s": perf_counter() - begin,
    }
table = pd.DataFrame.from_dict(rows, orient="index")
show(table.to_string(float_format="%.4f"))

# %%
figure = Figure(figsize=(8.0, 4.6), layout="constrained")
axes = figure.subplots()
shown = table["largest_mm"].drop("direct").sort_values(ascending=False, kind="stable")
colours = table["bends"].map({True: "#0072B2", False: "#E69F00"})[shown.index]
axes.barh(shown.index, shown, color=colours)
axes.set_xscale("log")
axes.set_xlim(1e-3, 20.0)
axes.set_xlabel("largest difference of a dropper's length from that by the direct method [mm]")
axes.set_title("Wires for strings (orange) or with bending (blue)", loc="left")
axes.spines[["top", "right"]].set_visible(False)
figure.savefig("compare_methods.png", dpi=100)

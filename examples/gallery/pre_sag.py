"""How much pre-sag makes the path of a pantograph level? A parameter study.

    python examples/gallery/pre_sag.py

Draws pre_sag.png into the current folder.
"""

# %% [markdown]
# # Pre-sag
#
# A contact wire gives way more in the middle of a span than at its supports. If it hangs lower in the
# middle by as much, a pantograph that pushes with a constant force runs level. Droppers at the ends of a
# span pay for it: they carry more.

# %%
from pathlib import Path

import numpy as np
import pandas as pd
from matplotlib.figure import Figure
from rich import print as show

import catenaria

EXAMPLES = Path(__file__).resolve().parents[1]
SPANS, INNER, LENGTH = 6, 3, 55.0  # how many, the one that is looked at, and how long each is [m]
PUSH = 150.0  # N
PRE_SAGS = (0, 15, 30, 45, 60, 75)  # mm

full = catenaria.load(EXAMPLES / "simple_55m.yaml")
line = catenaria.vary(
    full, {"spans": full.spans[:SPANS], "supports": [*full.supports[:SPANS], full.supports[-1]]}
)


# %% [markdown]
# ## One variant
#
# Solved with another pre-sag in all spans, then pushed every metre of one span, one place after the
# other.


# %%
def path_of(result: catenaria.Result) -> tuple[np.ndarray, np.ndarray]:
    """Return places in the inner span and heights of the contact wire while it is pushed there [m]."""
    study = result.elasticity(PUSH, 1.0, start=(INNER - 1) * LENGTH, end=INNER * LENGTH)
    height = np.array([result.at(c).wire("contact wire").height for c in study.points.chainage])
    return study.points.chainage, height + PUSH * study.points.elasticity


rows: list[dict[str, float]] = []
paths: dict[int, tuple[np.ndarray, np.ndarray]] = {}
for pre_sag in PRE_SAGS:
    variant = catenaria.vary(line, {f"spans.{i}.pre_sag": f"{pre_sag} mm" for i in range(SPANS)})
    result = catenaria.solve(variant)
    force = result.droppers.query("span == @INNER")["force_bottom_N"].to_numpy()
    paths[pre_sag] = path_of(result)
    rows.append(
        {
            "pre_sag_mm": pre_sag,
            "path_mm": 1e3 * float(np.ptp(paths[pre_sag][1])),
            "outer_dropper_N": float(force[0]),
            "middle_dropper_N": float(force[force.size // 2]),
        }
    )
table = pd.DataFrame(rows)
show(table.round(1).to_string(index=False))

# %%
figure = Figure(figsize=(8.0, 6.4), layout="constrained")
above, below = figure.subplots(2, 1, height_ratios=[3, 2])
colours = ("#CC79A7", "#56B4E9", "#0072B2", "#009E73", "#E69F00", "#D55E00")
for (pre_sag, (chainage, height)), colour in zip(paths.items(), colours, strict=True):
    above.plot(chainage, 1e3 * (height - height[0]), color=colour, label=f"{pre_sag} mm")
above.set_xlabel("chainage [m]")
above.set_ylabel("path above its start [mm]")
above.set_title(f"Contact wire where it is pushed with {PUSH:g} N, by pre-sag", loc="left")
low, high = above.get_ylim()
above.set_ylim(low, high + 0.12 * (high - low))
above.legend(frameon=False, loc="upper center", ncols=len(PRE_SAGS))
below.plot(table["pre_sag_mm"], table["outer_dropper_N"], "o-", color="#D55E00", label="outer dropper")
below.plot(table["pre_sag_mm"], table["middle_dropper_N"], "o-", color="#0072B2", label="middle dropper")
below.set_xlabel("pre-sag [mm]")
below.set_ylabel("force [N]")
below.legend(frameon=False)
for axes in (above, below):
    axes.spines[["top", "right"]].set_visible(False)
figure.savefig("pre_sag.png", dpi=100)

"""Radial forces of steady arms through a curve, beside the formula of the textbooks.

    python examples/gallery/radial_forces.py

Draws radial_forces.png into the current folder.
"""

# %% [markdown]
# # Radial forces in a curve
#
# Where a wire of tension T turns, it pulls its support aside. With offsets b from the track (to the left)
# at supports, spans a between them and a track that turns by the angle psi, averaged over the spans
# beside the support,
#
# $$F = T\,\Bigl(\frac{b_i-b_{i-1}}{a_{i-1}}+\frac{b_i-b_{i+1}}{a_i}-\psi_i\Bigr)$$
#
# to the right. In an arc of radius R, psi is (a1 + a2)/2R. The form that is found also knows the slope of
# wires and droppers that lean, which the formula does not.

# %%
from pathlib import Path

import numpy as np
import pandas as pd
from matplotlib.figure import Figure
from rich import print as show

import catenaria

EXAMPLES = Path(__file__).resolve().parents[1]

result = catenaria.solve(EXAMPLES / "curve_800m.yaml")
show(result)

# %% [markdown]
# ## The formula
#
# The curvature of the track grows along the transition of 80 m to 1/800 m, and goes back in the same way.
# The angle is its integral weighted with a hat that is 1 at the support and 0 at its neighbours.
#
# Staggers are measured in the canted track plane. Cant grows with the curvature, and turns this plane to
# the inside: a wire 5.5 m above the rails is carried aside by 5.5 m x 100 mm/1.5 m = 367 mm. That counts
# as offset too, and where the cant begins and ends it matters: without it, arms there would be wrong by
# up to 46 N.

# %%
track = result.line.track
[curve] = track.curves
c = np.linspace(0.0, 1000.0, 100_001)
into, out_of = c - curve.start, curve.start + curve.length - c
kappa = np.clip(np.minimum(into, out_of) / curve.transition, 0.0, 1.0) / curve.radius


def turned(before: float, here: float, after: float) -> float:
    """Return the angle by which the track turns at a support, averaged over both spans."""
    hat = np.interp(c, [before, here, after], [0.0, 1.0, 0.0])
    return float(np.trapezoid(hat * kappa, c))


held = result.supports.query("wire == 'contact wire'")
at, stagger, height = (held[column].to_numpy() for column in ("chainage_m", "stagger_m", "height_m"))
cant = curve.cant * np.interp(at, c, kappa) * curve.radius
b = stagger + height * cant / track.rail_spacing
T = result.form.wire("contact wire").tension
angle = np.array([turned(*at[i - 1 : i + 2]) for i in range(1, at.size - 1)])
slope = np.diff(b) / np.diff(at)
to_the_right = T * (slope[:-1] - slope[1:] - angle)

# %% [markdown]
# ## Both
#
# A pull-off arm is hinged on the side of the stagger; its force is positive where the wire pulls away
# from there.

# %%
arms = result.arms
side = np.sign(arms["hinge_stagger_m"].to_numpy() - stagger[1:-1])
table = pd.DataFrame(
    {
        "support": arms["support"],
        "chainage_m": arms["chainage_m"],
        "stagger_m": stagger[1:-1],
        "offset_m": b[1:-1],
        "found_N": arms["radial_N"],
        "formula_N": side * to_the_right,
    }
)
table["difference_N"] = table["found_N"] - table["formula_N"]
show(table.round(2).to_string(index=False))

# %%
figure = Figure(figsize=(8.0, 5.0), layout="constrained")
above, below = figure.subplots(2, 1, sharex=True, height_ratios=[1, 2])
above.plot(c, 1e3 * kappa, color="#666666")
above.set_ylabel("curvature [1/km]")
below.plot(table["chainage_m"], table["formula_N"], color="#0072B2", label="formula")
below.plot(table["chainage_m"], table["found_N"], "o", color="#D55E00", label="found")
below.set_ylim(bottom=0.0)
below.set_ylabel("radial force [N]")
below.set_xlabel("chainage [m]")
below.set_xlim(at[0], at[-1])
below.legend(frameon=False)
above.set_title("Pull of the contact wire at its arms, 10 kN", loc="left")
for axes in (above, below):
    axes.spines[["top", "right"]].set_visible(False)
figure.savefig("radial_forces.png", dpi=100)

"""What becomes of a found line in heat, cold and wind: strokes of the tensioning devices, and blow-off.

    python examples/gallery/temperature_and_wind.py

Draws temperature_and_wind.png into the current folder.
"""

# %% [markdown]
# # Load cases
#
# Half a tension length of 12 spans, pulled at its start, is found at 15 degrees and then built:
# unstressed lengths stay what they were found to be. Warm wires are longer; the weights sink and take up
# what is too long.

# %%
from pathlib import Path

import pandas as pd
from matplotlib.figure import Figure
from rich import print as show

import catenaria

EXAMPLES = Path(__file__).resolve().parents[1]
CHANGES = (-40.0, -20.0, 20.0, 40.0)  # K
WIND = 26.0  # m/s, from the right

result = catenaria.solve(EXAMPLES / "simple_60m.yaml")
cases = {f"warmer by {change:g} K": {"temperature": {"change": f"{change} K"}} for change in CHANGES}
cases["wind"] = {"wind": {"speed": f"{WIND} m/s", "direction": "90 deg"}}
study = result.under(cases)

# %% [markdown]
# ## Stroke
#
# A free wire of length L would move its end by alpha L dT. These wires are not free: arms swing along
# with the contact wire, the messenger wire runs over rollers with friction, and droppers between them
# lean.

# %%
LONG = ("contact wire", "messenger wire")

names = [wire.name for wire in study.before.wires]
unstressed = result.wires.set_index("wire")["unstressed_length_m"]
rows: list[dict[str, float | str]] = []
for case in study.cases[: len(CHANGES)]:
    for name in LONG:
        i = names.index(name)
        rows.append(
            {
                "warming_K": case.warming,
                "wire": name,
                "stroke_mm": 1e3 * (case.state.wires[i].travel - study.before.wires[i].travel),
                "formula_mm": 1e3 * float(study.expansion[i] * unstressed[name] * case.warming),
            }
        )
strokes = pd.DataFrame(rows)
show(strokes.round(1).to_string(index=False))

# %% [markdown]
# ## Wind
#
# In the middle of spans the wind carries the contact wire aside. The textbook takes it for a string on
# its own.

# %%
blown = study.cases[-1].blow_off
wind = pd.DataFrame({"span": blown.span, "solved_mm": 1e3 * blown.solved, "textbook_mm": 1e3 * blown.alone})
show(wind.round(1).to_string(index=False))

# %%
figure = Figure(figsize=(8.0, 6.0), layout="constrained")
above, below = figure.subplots(2, 1)
for name, colour in zip(LONG, ("#D55E00", "#0072B2"), strict=True):
    own = strokes.query("wire == @name").sort_values("warming_K")
    above.plot(own["warming_K"], own["stroke_mm"] - own["formula_mm"], "o-", color=colour, label=name)
above.axhline(0.0, color="#666666", linewidth=0.8)
above.set_xlabel("warmer than the line was found by [K]")
above.set_ylabel("stroke less alpha L dT [mm]")
above.set_title("Stroke at the weights beyond that of a free wire", loc="left")
above.legend(frameon=False)
for state, colour, label in (
    (study.before, "#666666", "still air"),
    (study.cases[-1].state, "#009E73", f"{WIND:g} m/s from the right"),
):
    contact = state.wire("contact wire")
    below.plot(contact.chainage, 1e3 * contact.lateral, color=colour, label=label)
below.set_xlabel("chainage [m]")
below.set_ylabel("contact wire to the left [mm]")
below.set_xlim(0.0, 360.0)
low, high = below.get_ylim()
below.set_ylim(low, high + 0.25 * (high - low))
below.legend(frameon=False, loc="upper right", ncols=2)
below.set_title("Contact wire from above", loc="left")
for axes in (above, below):
    axes.spines[["top", "right"]].set_visible(False)
figure.savefig("temperature_and_wind.png", dpi=100)

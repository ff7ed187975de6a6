"""A soft wire that slides through its supports over many elements, outwards and back."""

from __future__ import annotations

import numpy as np
import pytest

from catenaria.discretise.mesh import Grading
from catenaria.discretise.read_back import stage
from catenaria.discretise.restart import start_from, with_full_gravity
from catenaria.discretise.wire_model import WireModel, build_wire_model
from catenaria.discretise.wire_setup import DropperSetup, TensionSetup, WireSetup
from catenaria.errors import CatenariaError
from catenaria.formfinding.controlled_motion import Motion, move
from catenaria.formfinding.motion_problem import Tolerances
from catenaria.formfinding.settling import Settled
from catenaria.mechanics.chain import Chain, Section
from catenaria.mechanics.controls.velocity_law import VelocityLaw
from catenaria.mechanics.loads.gravity import Ramp
from catenaria.solvers.outcome import Options


def setup(tension: float, largest: float) -> WireSetup:
    """Return a 10 m span of a wire that stretches by 5 % under 5 kN, with two droppers."""
    droppers = DropperSetup(
        x=np.array([3.0, 7.0]),
        up=True,
        length=1.0,
        elements=1,
        section=Section(EA=1e6, EJ=1.0, rhoA=0.1),
        clamp_mass=0.0,
        guided=True,
        target=np.zeros(2),
        law=VelocityLaw(2e-3, 1e-6, 1e-3),
        foot_x=np.zeros(2),
        foot_height=np.zeros(2),
        clamps_mass=0.0,
    )
    return WireSetup(
        name="contact wire",
        section=Section(EA=1e5, EJ=10.0, rhoA=1.0),
        support_x=np.array([0.0, 10.0]),
        height=0.0,
        tail=0.5,
        tension=TensionSetup(tension, "reaction", True, VelocityLaw(5e-3, 0.05, 50.0)),
        droppers=droppers,
        grading=Grading((), largest),
        gauss_points=5,
        g=9.81,
        gravity_ramp=Ramp(2.0),
        control_ramp=Ramp(2.0),
        damping=(0.0, 0.0),
    )


def moved(model: WireModel) -> Motion:
    tolerances, settled = Tolerances(1e-3, 1e-3, 1e-6, 1e-3), Settled(1e-3, 1.1, 1e-7)
    return move(model, tolerances, Options(), settled, 1e5)


def clamp_forces(motion: Motion) -> np.ndarray:
    return -motion.z[motion.model.droppers.clamp_force[:, 2]]


def crossed(motion: Motion) -> tuple[int, int]:
    """Return over how many elements the wire slid at its two supports."""
    first, last = (motion.model.wire.locate(z[motion.model.support_s]) for z in motion.solution.y[[0, -1]])
    return abs(int(last[0] - first[0])), abs(int(last[1] - first[1]))


def there_and_back(largest: float) -> tuple[Motion, Motion]:
    """Tension the wire to 5 kN, and from there to 3 kN."""
    out = moved(build_wire_model(setup(5e3, largest)))
    back_setup = with_full_gravity(setup(3e3, largest))
    return out, moved(start_from(build_wire_model(back_setup), stage(out.model, out.z)))


def test_joints_cross_many_elements_out_and_back() -> None:
    """Joints slide 0.25 m over elements of 20 mm; forces are those of a mesh in which they need not cross."""
    out, back = there_and_back(0.02)
    assert min(crossed(out)) >= 10
    assert min(crossed(back)) >= 3
    assert min(out.solution.counters.reselections, back.solution.counters.reselections) >= 3
    straight = moved(build_wire_model(setup(3e3, 0.02)))
    np.testing.assert_allclose(clamp_forces(back), clamp_forces(straight), atol=0.1)
    np.testing.assert_allclose(back.z[back.model.support_s], straight.z[straight.model.support_s], atol=1e-5)


def test_without_relocation_it_goes_wrong(monkeypatch: pytest.MonkeyPatch) -> None:
    """Negative control: a joint that never changes its element leaves the wire."""
    right = clamp_forces(moved(build_wire_model(setup(5e3, 0.02))))
    monkeypatch.setattr(Chain, "relocate", lambda self, s, element: element)
    try:
        wrong = clamp_forces(moved(build_wire_model(setup(5e3, 0.02))))
    except CatenariaError:
        return
    assert np.max(np.abs(wrong - right)) > 1.0

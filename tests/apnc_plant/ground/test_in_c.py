"""Grounds of one's own: touched in Python, or in C by address."""

from __future__ import annotations

import ctypes
import gc
import weakref
from collections.abc import Sequence
from pathlib import Path
from typing import Any, ClassVar

import numpy as np
import pytest
from compilers import run, tool
from plain_robot import plain_robot
from plants import Kind, in_both

import apnc
from apnc_plant.compiled import CompiledPlant
from apnc_plant.ground import Ground, GroundInC, Numbers, Plane

TICK = 1 / 60
ROBOT = plain_robot()
RADIUS = ROBOT.contact.foot_radius


class Own(Ground):
    """The plane once more, with a touch function of its own."""

    kind: ClassVar[str] = "own"
    top = 0.0

    def elevation(self, x: Any, y: Any) -> Any:
        return np.zeros(np.broadcast(x, y).shape)

    def touch(self, x: float, y: float, z: float, radius: float) -> Sequence[Sequence[float]]:
        return [(0.0, 0.0, 1.0, radius - z)] if z < radius else []


SOURCE = """
#include <stdint.h>
int32_t touch(double x, double y, double z, double radius, const double *reals,
              const int64_t *integers, double *found) {
    if (!(z < radius)) return 0;
    found[0] = found[1] = 0.0;
    found[2] = 1.0;
    found[3] = radius - z + (integers[0] - 7) + (reals[1] - 0.5);
    return 1;
}
"""


@pytest.fixture(scope="module")
def own_in_c(tmp_path_factory: pytest.TempPathFactory) -> Ground:
    """The same in C; it reads numbers of its own."""
    folder: Path = tmp_path_factory.mktemp("own")
    (folder / "own.c").write_text(SOURCE)
    run(tool("cc", "gcc"), "-shared", "-fPIC", "own.c", "-o", "own.so", cwd=folder)
    function = ctypes.CDLL(str(folder / "own.so")).touch

    class InC(Own):
        address = ctypes.cast(function, ctypes.c_void_p).value or 0

        def numbers(self, radius: float) -> Numbers:
            return Numbers(np.array([0.0, 0.5]), np.array([7]), contacts=1)

    return InC()


def walked(kind: Kind, ground: Ground) -> dict[str, np.ndarray]:
    plant = kind(ROBOT, 1, ground=ground)
    for tick in range(60):
        swing = 0.1 * np.sin(0.12 * tick) * np.array([1.0, -1.0, -1.0, 1.0])
        plant.advance(swing, -swing, TICK)
    assert not plant.fell
    return plant.sample()


@in_both
def test_in_python_and_in_c_it_carries_as_the_plane_does(kind: Kind, own_in_c: Ground) -> None:
    plane = walked(kind, Plane(slope=0.05))
    assert plane["foot_force"].max() > 1.0
    in_c = type(own_in_c)(slope=0.05)
    for ground in (Own(slope=0.05), in_c):
        for name, values in walked(kind, ground).items():
            np.testing.assert_allclose(values, plane[name], atol=1e-11, err_msg=name)


def test_it_is_asked_for_contacts_and_heights_like_any_other(own_in_c: Ground) -> None:
    for ground in (Own(), own_in_c):
        np.testing.assert_array_equal(
            ground.contacts((1.0, 2.0, 0.01), RADIUS), [[0.0, 0.0, 1.0, RADIUS - 0.01]]
        )
        assert ground.rest_height(0.3, 0.1, RADIUS) == pytest.approx(RADIUS, abs=1e-15)


def test_a_touch_of_its_own_counts_in_a_ground_that_c_knows_too() -> None:
    class Higher(Plane):
        top = 0.001  # type: ignore[assignment]

        def touch(self, x: float, y: float, z: float, radius: float) -> Sequence[Sequence[float]]:
            depth = radius + self.top - z
            return [(0.0, 0.0, 1.0, depth)] if depth > 0.0 else []

    height = CompiledPlant(ROBOT, ground=Higher()).sample()["position"][2]
    assert height == pytest.approx(CompiledPlant(ROBOT).sample()["position"][2] + 0.001, abs=1e-12)
    assert len(Higher().contacts((0.0, 0.0, RADIUS + 0.0005), RADIUS)) == 1
    walk = apnc.Experiment(robot=ROBOT, duration=0.1, ground=Higher(), engine="compiled")
    record = apnc.simulate(walk)
    assert record.signals["position"][0, 2] == height
    assert record.signals["foot_position"][:, :, 2].min() > RADIUS


class Broken(Own):
    """Fails once a foot is where the robot has walked to; asked too often it says so."""

    kind: ClassVar[str] = "broken"
    calls = 0
    good = 500

    def touch(self, x: float, y: float, z: float, radius: float) -> Sequence[Sequence[float]]:
        type(self).calls += 1
        if self.calls > self.good:
            raise ZeroDivisionError("no ground there")
        return super().touch(x, y, z, radius)


MESSAGE = r"^ground 'broken': touch failed: ZeroDivisionError: no ground there$"


@in_both
def test_an_error_in_it_is_one_clear_error(kind: Kind, capfd: pytest.CaptureFixture[str]) -> None:
    Broken.calls = 0
    plant = kind(ROBOT, ground=Broken())
    with pytest.raises(ValueError, match=MESSAGE) as caught:
        for _ in range(60):
            plant.advance(np.zeros(4), np.zeros(4), TICK)
    assert isinstance(caught.value.__cause__, ZeroDivisionError)
    assert plant.time > 0.0
    # told once: it is not asked again in the tick in which it failed
    assert Broken.calls == Broken.good + 1
    assert capfd.readouterr() == ("", "")


@in_both
def test_its_error_counts_more_than_the_motion_that_breaks_down_with_it(kind: Kind) -> None:
    class Wild(Broken):
        def touch(self, x: float, y: float, z: float, radius: float) -> Sequence[Sequence[float]]:
            return [(0.0, 0.0, 1.0, 1e300)] if super().touch(x, y, z, radius) else []

    Wild.calls, Wild.good = 0, 10**6
    plant = kind(ROBOT, ground=Wild())
    Wild.good = Wild.calls + 2
    with pytest.raises(ValueError, match=MESSAGE):
        plant.advance(np.zeros(4), np.zeros(4), TICK)


@pytest.mark.parametrize("engine", ["compiled", "exudyn"])
def test_a_walk_over_a_broken_ground_ends_with_that_error(engine: str) -> None:
    Broken.calls = 0
    walk = apnc.Experiment(duration=2.0, ground=Broken(), engine=engine)
    with pytest.raises(ValueError, match=MESSAGE):
        apnc.simulate(walk)


def test_an_interrupt_stays_an_interrupt() -> None:
    class Interrupted(Own):
        def touch(self, x: float, y: float, z: float, radius: float) -> Sequence[Sequence[float]]:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        Interrupted().contacts((0.0, 0.0, 0.0), RADIUS)


class Odd(Own):
    """Gives back what it is told to."""

    kind: ClassVar[str] = "odd"
    places: ClassVar[Any] = None

    def touch(self, x: float, y: float, z: float, radius: float) -> Sequence[Sequence[float]]:
        return self.places  # type: ignore[no-any-return]


@pytest.mark.parametrize(
    ("places", "message"),
    [
        ([(0.0, 0.0, 1.0, 0.001)] * 5, "ValueError: 5 contact points; its numbers allow 4"),
        ([(0.0, 0.0, 1.0)], "ValueError: not enough values to unpack"),
        ([("up", 0.0, 1.0, 0.001)], "TypeError"),
        (None, "TypeError"),
    ],
)
def test_what_is_no_list_of_places_is_refused(
    places: Any, message: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(Odd, "places", places)
    with pytest.raises(ValueError, match=f"ground 'odd': touch failed: {message}") as caught:
        Odd().contacts((0.0, 0.0, 0.0), RADIUS)
    assert "\n" not in str(caught.value)


def test_a_ground_without_a_touch_function_is_refused() -> None:
    class Nothing(Own):
        touch = Ground.touch

    with pytest.raises(ValueError, match="ground 'own' has neither a method touch nor the address"):
        CompiledPlant(ROBOT, ground=Nothing())


def test_what_c_calls_lives_as_long_as_the_plant_and_no_longer() -> None:
    plant = CompiledPlant(ROBOT, ground=Own())
    seen = weakref.ref(plant._ground)
    gc.collect()
    plant.advance(np.zeros(4), np.zeros(4), TICK)
    assert isinstance(seen(), GroundInC)
    del plant
    gc.collect()
    assert seen() is None

"""Faults put into the sources of the plant on purpose are noticed by the checks of it."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import Any, NamedTuple

import pytest
from c_plant import SOURCES, linked, objects
from c_plant_checks import CHECKS


class Fault(NamedTuple):
    """One line of the sources, changed.

    Args:
        check: the check that must notice it.
        file: where it is.
        right, wrong: the line, or enough of it to stand there once, and what it becomes.
    """

    check: str
    file: str
    right: str
    wrong: str


FAULTS = {
    "Coriolis term with the wrong sign": Fault(
        "accelerations", "dynamics.h", "a2.w.x -= T2.w.z * qd[1];", "a2.w.x += T2.w.z * qd[1];"
    ),
    "rotor forgotten in one joint": Fault(
        "accelerations", "dynamics.h", "i23.yy + n->joint[1].rotor", "i23.yy"
    ),
    "legs that are never sprawled": Fault(
        "accelerations", "dynamics.h", "v_sin_cos(n->abduction_angle + q[0], ", "v_sin_cos(q[0], "
    ),
    "knees that all flex one way": Fault(
        "motion", "numbers.h", "leg->knee_in_front ? 1.0 : -1.0", "-1.0"
    ),
    "Coriolis term of any axes forgotten": Fault(
        "accelerations", "any_axes.h", "v_add(a.v, v_cross(moves.v, turns))", "a.v"
    ),
    "inertia of a link that is not turned": Fault(
        "accelerations", "any_axes.h", "= vr_inertia(&m->link[1], &n->link[1])", "= n->link[1]"
    ),
    "joint that is not locked": Fault(
        "accelerations", "numbers.h", "leg->locked[j] ? 0.0 : 1.0", "1.0"
    ),
    "coxa that swings back": Fault("forces", "numbers.h", "0.0, 1, -side)", "0.0, 1, side)"),
    "output of the hip at the first joint": Fault(
        "motion", "plant.c", "angles[angle_of(*NUMBER(plant, angle[j], leg, lane))]", "angles[j]"
    ),
    "gravity upward": Fault(
        "accelerations", "dynamics.h", "s->xdd.z -= n->gravity;", "s->xdd.z += n->gravity;"
    ),
    "rates of Euler angles without their coupling": Fault(
        "accelerations", "dynamics.h", " + m->sp * s->yawdd;", ";"
    ),
    "lever of the mount forgotten": Fault(
        "accelerations",
        "dynamics.h",
        "const v3 moment = v_add(about_x(m->c1, m->s1, b.bias.n), v_cross(n->mount, force));",
        "const v3 moment = about_x(m->c1, m->s1, b.bias.n);",
    ),
    "motor that drives beyond its speed": Fault(
        "accelerations", "servo.h", "stall * v_min(v_max(one - ratio, -one), one)", "stall"
    ),
    "servo of another joint": Fault(
        "accelerations", "numbers.h", "servo_at(own, &robot->servo);", "robot->servo;"
    ),
    "friction that drives": Fault(
        "accelerations", "servo.h", "+ n->friction * slip", "- n->friction * slip"
    ),
    "friction without its onset": Fault(
        "accelerations", "servo.h", "speed * n->per_slow, -one", "speed * 1e9, -one"
    ),
    "joint without damping": Fault("accelerations", "servo.h", "n->damping * speed + n", "n"),
    "stops of the other side": Fault(
        "accelerations", "numbers.h", "passive.low = -own->high;", "passive.low = own->low;"
    ),
    "stop that pulls": Fault(
        "accelerations", "servo.h", "v_max(spring, zero), zero", "spring, zero"
    ),
    "stop damped from the first touch on": Fault(
        "accelerations", "servo.h", "depth * (1.0 / STOP_DEPTH)", "depth * 1e9"
    ),
    "work with friction": Fault(
        "forces",
        "dynamics.h",
        "        add_passive(p, n, s, torque);\n",
        "        s->work[1] += v_abs(torque[1]); add_passive(p, n, s, torque);\n",
    ),
    "feet with one radius": Fault(
        "forces",
        "numbers.h",
        "n->radius = foot_radius(robot, leg);",
        "n->radius = robot->contact.foot_radius;",
    ),
    "stop that the step does not know": Fault(
        "steps", "step.h", "law.stiffness += passive->stop_stiffness;", ";"
    ),
    "friction that the step does not know": Fault(
        "steps", "step.h", "law.damping += passive->friction * passive->per_slow;", ";"
    ),
    "joint damping that the step does not know": Fault(
        "steps", "step.h", "law.damping += passive->damping;", ";"
    ),
    "joints left out of a tuning": Fault(
        "tuning",
        "plant.c",
        "set_leg(&leg, robot, place < h->legs ? place : 0);",
        "set_leg(&leg, robot, 0);",
    ),
    "friction without bound": Fault(
        "forces", "contact.h", "grip * wide(stopping)", "0.0 * grip * wide(stopping)"
    ),
    "damping that pulls": Fault(
        "forces", "contact.h", "depth + wide(c->damping)", "depth - wide(c->damping)"
    ),
    "damping from the first touch on": Fault(
        "forces", "contact.h", "v_min(one, depth * wide(c->per_depth))", "one"
    ),
    "suspension with yaw and roll swapped": Fault(
        "forces", "dynamics.h", "s->yaw, s->pitch, s->roll}", "s->roll, s->pitch, s->yaw}"
    ),
    "work that is given back": Fault(
        "forces", "dynamics.h", "v_abs(torque[j] * s->qd[j])", "(torque[j] * s->qd[j])"
    ),
    "roll and pitch swapped in a sample": Fault(
        "forces",
        "plant.c",
        "*TRUNK(p, roll, lane), *TRUNK(p, pitch, lane)",
        "*TRUNK(p, pitch, lane), *TRUNK(p, roll, lane)",
    ),
    "mass of a foot from one direction": Fault(
        "forces", "foot_mass.h", "mobility[0][1] * mobility[1][0]", "0.0"
    ),
    "half a kick too much": Fault(
        "motion", "tick.h", "drift(p, h);", "drift(p, h), kick(p, 0.5 * h);"
    ),
    "command a tick late": Fault(
        "motion", "tick.h", "waits[entry] = h->latency;", "waits[entry] = h->latency + duration;"
    ),
    "slew rate one way only": Fault(
        "motion", "tick.h", "v_min(v_max(wanted, before - reach), ", "v_min(wanted, "
    ),
    "damaged leg that obeys": Fault(
        "motion", "tick.h", "v_select(s->sound > zero, s->asked[j], zero)", "s->asked[j]"
    ),
    "filter of another share": Fault(
        "sensors", "sensor.h", "plant_decay(duration / T)", "duration / (duration + T)"
    ),
    "delay off by one": Fault(
        "sensors", "sensor.h", "? (at + h->history - 1)", "? (at + h->history - 2)"
    ),
    "two pairs of legs with one noise": Fault(
        "noise", "sensor.h", "32u + (uint64_t)group / 2", "32u + (uint64_t)group / 4"
    ),
    "noise that does not go on": Fault(
        "noise", "sensor.h", "h->readings[robot]++;", "h->readings[robot] += 0;"
    ),
    "corners all on one side": Fault("fall", "fall.h", "(corner >> i) & 1", "corner & 1"),
    "push on a foot without its moment": Fault(
        "steps", "step.h", "{force, v_cross(m.tibia, force), 0.0}", "{force, still, 0.0}"
    ),
    "motor as a spring alone": Fault(
        "steps", "step.h", "s_max(servo->damping, servo->stall * servo->per_no_load)", "0.0"
    ),
    "friction at the load of a standing robot": Fault(
        "steps", "step.h", "4.0 * p->robot->half_weight", "2.0 * p->robot->half_weight"
    ),
    "divergence that is called a fall": Fault(
        "steps", "plant.c", "h->fares[lane] = PLANT_DIVERGED; /* it was", "; /* it was"
    ),
    "number left out of a tuning": Fault("tuning", "plant.c", "TAKE(contact.slow);", ""),
    "noise that goes on for the next robot": Fault(
        "again", "plant.c", "h->readings[lane] = 0;", ""
    ),
    "loads of the robot before": Fault(
        "again", "plant.c", "*of_leg(plant, loads, 1, 0, leg, lane) = 0.0;", ";"
    ),
    "lane that reads its neighbour": Fault(
        "lanes",
        "dynamics.h",
        "V_AT(at.z, lane), V_AT(radius, lane), found",
        "V_AT(at.z, (lane + 1) % PLANT_WIDTH), V_AT(radius, lane), found",
    ),
    "lanes with one noise": Fault(
        "lanes",
        "sensor.h",
        "random_normal_pair(h->seed[robot],",
        "random_normal_pair(h->seed[0],",
    ),
    "legs added up in another order": Fault(
        "lanes", "robot.h", "sum[i] += part[i][leg];", "sum[i] += part[i][legs - 1 - leg];"
    ),
}

ALWAYS = "friction without bound"
"""The one that the default run tries."""
THOROUGH = [
    "Coriolis term with the wrong sign",
    "delay off by one",
    "lane that reads its neighbour",
]
"""Those that CI tries as well; all together they take minutes."""

KERNELS = ["legs.c", "legs_avx2.c", "robots.c", "robots_avx2.c", "robots_avx512.c"]
OTHERS = ["forces.c", "laws.c", "sensors.c", "start.c", "obstacles.c", "level.c"]
PLAIN = "-DPLANT_PLAIN"
"""Without vectors."""


@pytest.fixture(scope="module")
def unchanged(tmp_path_factory: pytest.TempPathFactory) -> list[Path]:
    """What no check asks more of than where a ball touches and random numbers, compiled once."""
    return objects(SOURCES, OTHERS, tmp_path_factory.mktemp("others"))


def build(sources: Path, unchanged: list[Path], lanes: bool) -> Any:
    """A library of sources that may be wrong."""
    flags = [] if lanes else [PLAIN]
    parts = objects(sources, ["plant.c", "step.c", *(KERNELS if lanes else [])], sources, *flags)
    return linked([*parts, *unchanged], sources / "plant.so")


def copied(folder: Path) -> Path:
    sources = folder / "sources"
    shutil.copytree(SOURCES, sources)
    return sources


@pytest.mark.parametrize(
    "lanes",
    # the default run compares the lanes of the library that is installed, in test_lanes
    [pytest.param(False, id="plain"), pytest.param(True, id="lanes", marks=pytest.mark.thorough)],
)
def test_without_a_fault_every_check_passes(
    lanes: bool, unchanged: list[Path], tmp_path: Path
) -> None:
    library = build(copied(tmp_path), unchanged, lanes)
    for name, check in CHECKS.items():
        if lanes or name != "lanes":
            check(library)


def marks_of(fault: str) -> list[pytest.MarkDecorator]:
    if fault == ALWAYS:
        return []
    return [pytest.mark.thorough if fault in THOROUGH else pytest.mark.slow]


@pytest.mark.parametrize("name", [pytest.param(n, marks=marks_of(n)) for n in FAULTS])
def test_a_fault_is_noticed(name: str, unchanged: list[Path], tmp_path: Path) -> None:
    fault, sources = FAULTS[name], copied(tmp_path)
    text = (sources / fault.file).read_text(encoding="utf-8")
    assert text.count(fault.right) == 1, f"{fault.file} has another line now"
    (sources / fault.file).write_text(text.replace(fault.right, fault.wrong), encoding="utf-8")
    library = build(sources, unchanged, fault.check == "lanes")
    with pytest.raises(AssertionError):
        CHECKS[fault.check](library)

"""The environment of Gymnasium: its contract, seeds and units, and the walk that it records."""

from __future__ import annotations

import math
import subprocess
import sys
import warnings
from dataclasses import replace
from typing import Any

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env

import apnc
from apnc.gym_env import FALL, ID, WalkEnv

SHORT = apnc.Experiment(duration=3.0, engine="compiled")
FORWARD = np.array([0.2, 0.0], np.float32)


def made(**given: Any) -> WalkEnv:
    return WalkEnv(**{"experiment": SHORT, **given})


def walked(env: WalkEnv, seed: int, action: np.ndarray = FORWARD) -> list[Any]:
    """First observation and the result of every step of an episode."""
    seen: list[Any] = [env.reset(seed=seed)]
    while len(seen) == 1 or not (seen[-1][2] or seen[-1][3]):
        seen.append(env.step(action))
    return seen


# check_env leaves copies of its own to the collector
@pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning")
@pytest.mark.parametrize("acts", ["commands", "loads"])
@pytest.mark.parametrize("robot", ["lilibot", "hexapod"])
def test_the_contract_of_gymnasium_holds(acts: Any, robot: str) -> None:
    own = replace(SHORT, robot=robot, rate=None, mi=None, step=None)
    env: Any = gymnasium.make(ID, experiment=own, acts=acts).unwrapped
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        # natural units, as the class says
        warnings.filterwarnings("ignore", message=".*symmetric and normalized.*")
        check_env(env)
    n = len(env._legs)
    assert env.action_space.shape == ((2,) if acts == "commands" else (n,))
    assert env.observation_space.shape == (3 * n + 2,) == (len(env.names),)


def test_it_is_made_by_its_name_and_side_by_side() -> None:
    envs = gymnasium.make_vec(ID, num_envs=3, experiment=SHORT)
    first, _ = envs.reset(seed=[1, 2, 1])
    total = np.zeros(3)
    for _ in range(4):
        seen, reward, _, _, info = envs.step(np.tile(FORWARD, (3, 1)))
        total += reward
    envs.close()
    assert (first[0] == first[2]).all()
    assert (seen[0] == seen[2]).all() and (seen[0] != seen[1]).any()
    assert total[0] == total[2] != total[1]
    assert info["forward"] == pytest.approx(total)


def test_the_same_seed_is_the_same_walk_and_every_reset_another_robot() -> None:
    a, b = walked(made(), 5), walked(made(), 5)
    for (one, *rest), (other, *others) in zip(a, b, strict=True):
        assert (one == other).all() and rest == others
    env = made()
    seeds = [env.reset(seed=5)[1]["seed"], *(env.reset()[1]["seed"] for _ in range(2))]
    assert len(set(seeds)) == 3 and seeds[0] == a[0][1]["seed"]
    assert env.reset(seed=5)[1]["seed"] == seeds[0]


def test_the_walk_is_the_one_of_simulate_and_repeats() -> None:
    env = made()
    *_, last = walked(env, 3)
    record = env.record()
    assert record.complete and last[3] and not last[2]
    alone = apnc.simulate(replace(SHORT, mi=float(FORWARD[0]), seed=record.experiment.seed))
    for name, values in alone.signals.items():
        assert np.array_equal(values, record.signals[name]), name
    again = apnc.simulate(record.experiment)
    assert np.array_equal(again.signals["position"], record.signals["position"])
    assert apnc.walk_features(record).distance_m is not None


def test_the_commands_of_each_step_are_in_the_record() -> None:
    env = made(period=0.5)
    env.reset(seed=0)
    for mi, turn in ((0.1, 0.0), (0.25, 0.5), (0.25, 0.5), (0.5, -1.0)):
        env.step(np.array([mi, turn], np.float32))
    record = env.record()
    assert [t for t, _ in record.experiment.mi] == pytest.approx([0.0, 0.5, 1.5])
    assert record.signals["MI"][[0, 29, 30, 89, 90]] == pytest.approx([0.1, 0.1, 0.25, 0.25, 0.5])
    assert record.signals["turn"][[0, 30, 119]] == pytest.approx([0.0, 0.5, -1.0])
    again = apnc.simulate(record.experiment).until(len(record))
    assert np.array_equal(again.signals["position"], record.signals["position"])


def test_reward_and_observation_have_the_units_that_are_told() -> None:
    env = made(period=0.5)
    seen = walked(env, 1)
    record = env.record()
    position, yaw = record.signals["position"], record.signals["rpy"][:, 2]
    step = np.diff(position[:31, :2], axis=0)
    ahead = (step * np.column_stack([np.cos(yaw[:30]), np.sin(yaw[:30])])).sum()
    observation, reward, _, _, info = seen[1]
    assert reward == pytest.approx(ahead) and info["time"] == pytest.approx(0.5)
    found = dict(zip(env.names, observation, strict=True))
    weight = record.robot.weight
    assert found["forward speed [m/s]"] == pytest.approx(ahead / 0.5, abs=1e-6)
    assert found["yaw rate [rad/s]"] == pytest.approx((yaw[30] - yaw[0]) / 0.5, abs=1e-5)
    assert found["roll [rad]"] == pytest.approx(record.signals["rpy"][30, 0], abs=1e-6)
    assert found["RF.load [1]"] == pytest.approx(
        record.signals["grf"][30, 0] / (0.5 * weight), abs=1e-6
    )
    phi = record.signals["phi"][29, 1]  # of the tick before, the newest that there is
    assert found["sin phi13 [1]"] == pytest.approx(math.sin(phi), abs=1e-6)
    assert found["cos phi13 [1]"] == pytest.approx(math.cos(phi), abs=1e-6)
    assert sum(entry[1] for entry in seen[1:]) == pytest.approx(seen[-1][4]["forward"])


def test_an_agent_on_the_loads_changes_what_the_controller_sees() -> None:
    steady = replace(SHORT, mi=0.15)
    as_it_is, silent = (
        walked(made(acts="loads", experiment=steady), 2, np.full(4, factor, np.float32))
        for factor in (1.0, 0.0)
    )
    assert (as_it_is[-1][0] != silent[-1][0]).any()
    env = made(acts="loads", experiment=steady)
    *_, last = walked(env, 2, np.ones(4, np.float32))
    alone = apnc.simulate(replace(steady, seed=env.reset(seed=2)[1]["seed"]))
    heading = alone.signals["rpy"][:, 2]
    way = np.diff(alone.signals["position"][:, :2], axis=0)
    ahead = (way * np.column_stack([np.cos(heading[:-1]), np.sin(heading[:-1])])).sum()
    assert last[4]["forward"] == pytest.approx(ahead, abs=0.01)
    with pytest.raises(ValueError, match="no experiment"):
        env.record()


def test_a_fall_ends_the_episode_and_costs() -> None:
    steep = replace(SHORT, duration=9.0, ground=apnc.Plane(slope=math.radians(60)), conditions="C4")
    env = made(experiment=steep)
    seen = walked(env, 0, np.array([0.08, 0.0], np.float32))
    _, reward, terminated, truncated, info = seen[-1]
    assert terminated and not truncated and info["fell"]
    assert env.record().end is apnc.End.fell
    assert reward < -FALL + 0.2
    with pytest.raises(gymnasium.error.ResetNeeded):
        env.step(FORWARD)


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"acts": "fly"}, "acts is 'fly'; allowed: commands, loads"),
        ({"period": 0.0}, "period is 0.0; allowed: a finite number above 0"),
        ({"period": math.nan}, "period is nan"),
        ({"render_mode": "human"}, "render_mode is 'human'; allowed: None"),
    ],
)
def test_what_makes_no_sense_is_refused(given: dict[str, Any], said: str) -> None:
    with pytest.raises(ValueError, match=said):
        made(**given)


@pytest.mark.parametrize("action", [[0.1], [0.1, math.nan], [0.1, 0.0, 0.0]])
def test_a_wrong_action_is_refused(action: list[float]) -> None:
    env = made()
    env.reset(seed=0)
    with pytest.raises(ValueError, match="allowed: finite numbers of shape"):
        env.step(np.array(action))


def test_actions_are_clipped_to_their_bounds() -> None:
    env = made()
    env.reset(seed=0)
    env.step(np.array([7.0, -3.0]))
    assert env.record().signals["MI"][0] == 1.0 and env.record().signals["turn"][0] == -1.0


def test_before_a_reset_there_is_nothing_to_step_or_record() -> None:
    env = made()
    for call in (lambda: env.step(FORWARD), env.record):
        with pytest.raises(gymnasium.error.ResetNeeded):
            call()
    env.close()


WITHOUT = """
import sys
sys.modules["gymnasium"] = None
try:
    import apnc.gym_env
except ModuleNotFoundError as error:
    print(error)
"""


def test_without_the_extra_the_message_names_it() -> None:
    done = subprocess.run(
        [sys.executable, "-c", WITHOUT], capture_output=True, text=True, check=True
    )
    assert "'gymnasium' is not installed: pip install" in done.stdout and "gym]" in done.stdout

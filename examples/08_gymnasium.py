"""A learner that knows nothing finds commands at which Lilibot walks faster, by cross-entropy.

It needs ``pip install ".[gym]"``. An action is MI and turn; the reward is the way forward [m].
"""

import gymnasium
import numpy as np

import apnc
import apnc.gym_env

SECONDS, TRIED, KEPT, ROUNDS = 10.0, 16, 4, 6
walk = apnc.Experiment(duration=SECONDS, engine="compiled")
env = gymnasium.make(apnc.gym_env.ID, experiment=walk)
rng = np.random.default_rng(0)
mean, spread = np.array([0.1, 0.0]), np.array([0.1, 0.3])
for number in range(ROUNDS):
    actions = np.clip(rng.normal(mean, spread, (TRIED, 2)), env.action_space.low, 1.0)
    ways = np.zeros(TRIED)
    for k, action in enumerate(actions):
        env.reset(seed=number)  # all of a round walk with the same robot
        over = False
        while not over:
            _, reward, fell, ended, _ = env.step(action.astype(np.float32))
            ways[k], over = ways[k] + reward, fell or ended
    best = actions[np.argsort(ways)[-KEPT:]]
    mean, spread = best.mean(axis=0), best.std(axis=0) + 0.005
    print(f"round {number}: {ways.mean() / SECONDS:.3f} m/s, MI {mean[0]:.2f}, turn {mean[1]:.2f}")
env.close()

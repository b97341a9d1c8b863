// Gaits by name, as apnc/metrics/gaits.py has them.

export const wrap = (angle) => angle - 2 * Math.PI * Math.round(angle / (2 * Math.PI));

/** Name of the gait that the relative phases are near, or null. */
export function nearest(gaits, phases, tolerance) {
  let found = null, best = tolerance;
  for (const [name, gait] of Object.entries(gaits)) {
    const error = Math.max(...gait.map((phase, k) => Math.abs(wrap(phases[k] - phase))));
    if (error <= best) [found, best] = [name, error];
  }
  return found;
}

const STEADY = 0.5; // [s] that a gait lasts before it is named

/** The gait that was the last to be steady, and the present one with the time since when it lasts [s]. */
export class GaitWatch {
  constructor(robot, tolerance) { Object.assign(this, { robot, tolerance, name: null, now: null, since: 0, lasted: 0 }); }

  look(phases, time) {
    const now = nearest(this.robot.gaits, phases, this.tolerance);
    if (now !== this.now) [this.now, this.since] = [now, time];
    this.lasted = time - this.since;
    this.steady = this.lasted >= STEADY;
    if (this.steady) this.name = now;
  }
}

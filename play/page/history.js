// The last minute: what the strip, the dial and the words look back at, and its CSV.

import { perLeg } from "./loop.js";

const SHOWN = ["MI", "turn", "phi", "phi_memory", "d", "kappa", "gamma", "o1", "o2", "theta_hip", "theta_knee"];
const SECONDS = 60;

export class History {
  constructor(loop) {
    this.n = loop.n;
    this.robot = loop.robot;
    this.Ts = loop.Ts;
    this.room = Math.round(SECONDS / this.Ts);
    this.threshold = 0.5 * loop.data.stanceShare * loop.robot.weight;
    this.count = 0; // ticks taken, of which the last `room` are kept
    this.samples = [];
    this.signals = [];
    this.standing = [];
    this.events = [];
  }

  /** Keep what the loop shows after a tick. */
  take(loop) {
    const at = this.count++ % this.room;
    this.samples[at] = loop.sample.slice();
    this.signals[at] = SHOWN.map((name) => loop.variable(name).slice());
    this.standing[at] = loop.robot.legs.map((_, leg) => perLeg(loop.sample, this.n, 5, leg)[2] > this.threshold);
  }

  /** Number of the oldest tick that is kept. */
  get first() { return Math.max(0, this.count - this.room); }
  sample(tick) { return this.samples[tick % this.room]; }
  stands(tick, leg) { return this.standing[tick % this.room][leg]; }
  signal(tick, name) { return this.signals[tick % this.room][SHOWN.indexOf(name)]; }
  last(name) { return this.signal(this.count - 1, name); }

  note(text) {
    this.events.push({ tick: this.count, text });
    this.events = this.events.filter((event) => event.tick >= this.first);
  }

  /** Mean speed over the last seconds [m/s]. */
  speed(seconds) {
    const end = this.count - 1, begin = Math.max(this.first, end - Math.round(seconds / this.Ts));
    if (end <= begin) return 0;
    const [a, b] = [this.sample(begin), this.sample(end)];
    return Math.hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]) / ((end - begin) * this.Ts);
  }

  /** As record.csv: a column per signal, a line per tick, SI units. */
  csv(data) {
    const { legs } = this.robot;
    const labels = (name) => ({
      scalar: [name], leg: legs.map((leg) => `${leg}.${name}`), relation: legs.slice(1).map((_, k) => `${name}1${k + 2}`),
    })[data.variables[name].per];
    const lines = [["time", ...SHOWN.flatMap(labels), ...this.robot.columns].join(",")];
    for (let tick = this.first; tick < this.count; tick++) {
      const values = [tick * this.Ts, ...this.signals[tick % this.room].flatMap((v) => [...v]), ...this.sample(tick)];
      lines.push(values.map((value) => Number(value.toPrecision(9))).join(","));
    }
    return lines.join("\n") + "\n";
  }
}

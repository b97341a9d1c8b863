// Three small experiments: what is done one after the other, and what is said about it.

const WAIT = { say: () => "First it walks until its gait is stored …", until: (p, since) => p.stored && p.formed && since > 0.5 };

/** A step acts and speaks as it begins and lasts until its condition holds; `took` is how long the one before lasted [s]. */
const EXPERIMENTS = {
  blind: [
    WAIT,
    { act: (p) => p.sensors(p.legs), say: () => "All foot sensors are off: the controller feels nothing any more.", until: (p, since) => since > 5 },
    { say: (p) => (p.formed ? `Five seconds without any sensor, and it still walks in a ${p.gait}: the stored gait holds its legs together.` : "It has lost its gait.") },
  ],
  recall: [
    WAIT,
    { act: (p) => { p.sensors(p.legs); p.reset(); }, say: () => "Reset, with all foot sensors off: all legs are in step, and only the stored gait is left.", until: (p, since) => p.steady && p.lasted < since },
    { say: (p, took) => `Back in a ${p.gait} after ${(took - p.lasted).toFixed(1)} s without a single sensor: only the stored gait can have brought it back.` },
  ],
  forget: [
    { act: (p) => { p.forget(); p.sensors(p.legs); }, say: () => "The gait is forgotten and all foot sensors are off.", until: (p, since) => since > 5 },
    { say: () => "No stored gait and no sensor: nothing moves the legs apart, and it gets nowhere. Repair the sensors, and a gait forms again." },
  ],
};

export class Script {
  constructor(name, page) {
    Object.assign(this, { steps: EXPERIMENTS[name], page, at: -1 });
    this.next(0);
  }

  next(took) {
    const step = this.steps[++this.at];
    this.begun = this.page.time;
    step.act?.(this.page);
    this.page.say(step.say(this.page, took));
  }

  /** Go on if it is time; false once the last step has begun. */
  go() {
    const since = this.page.time - this.begun, { until } = this.steps[this.at];
    if (until?.(this.page, since)) this.next(since);
    return this.at < this.steps.length - 1;
  }
}

// The closed loop of controller and robot, as play.c has it, behind names.

export const WALKS = 0;
export const DIVERGED = 2;
const SAMPLE = { position: 0, rpy: 3, velocity: 6 }; // where these begin in a sample

function bytes(text) {
  return Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
}

/** Compile the modules: one per number of legs. */
export async function compiled(data) {
  const modules = {};
  for (const [legs, text] of Object.entries(data.modules)) modules[legs] = await WebAssembly.compile(bytes(text));
  return modules;
}

export class Loop {
  /** A robot at its start. settings: see settings.js; sensors that are off are off from the start. */
  constructor(data, modules, settings) {
    this.data = data;
    this.robot = data.robots.find((robot) => robot.name === settings.robot);
    this.n = this.robot.legs.length;
    this.c = new WebAssembly.Instance(modules[this.n]).exports;
    this.memory = this.c.memory.buffer;
    new Uint8Array(this.memory).set(bytes(this.robot.numbers), this.c.numbers_at());
    this.views = {};
    this.sample = new Float64Array(this.memory, this.c.sample_at(), 9 + 19 * this.n);
    this.stuck = new Float64Array(this.memory, this.c.stuck_at(), this.n);
    this.balls = new Float64Array(this.memory, this.c.balls_at(), 4 * data.balls);
    this.c.defaults();
    for (const [name, value] of Object.entries(this.robot.parameters[settings.controller])) this.variable(name).set([value].flat());
    this.command(settings);
    this.c.renew();
    this.sensors(settings.off, false);
    const fits = this.c.place(settings.seed, radians(settings.slope), settings.bumps, settings.load);
    if (!fits) throw new Error("the robot does not fit into the memory of the page");
    this.ticks = 0;
    this.resetting = 0;
    this.fares = WALKS;
  }

  /** Numbers of a variable of the controller, by its name in the table of variables. */
  variable(name) {
    if (this.views[name]) return this.views[name];
    const { index, real, per } = this.data.variables[name];
    const count = { scalar: 1, leg: this.n, relation: this.n - 1 }[per];
    return (this.views[name] = new (real ? Float64Array : Int32Array)(this.memory, this.c.variable_at(index), count));
  }

  get Ts() { return this.robot.Ts; }
  get time() { return this.ticks * this.Ts; }
  get stored() { return this.variable("kappa")[0] > 0; }
  get slope() { return this.c.slope_now(); }
  get bumps() { return this.c.rough_now(); }
  get mass() { return this.c.mass(); }

  /** Stepping rate and steering of the settings. */
  command({ mi, turn }) {
    this.variable("MI")[0] = mi;
    this.variable("turn")[0] = turn;
  }

  /** Which foot sensors deliver nothing; the others work. */
  sensors(off, now = true) {
    this.robot.legs.forEach((leg, k) => { this.stuck[k] = off.has(leg) ? 0 : NaN; });
    if (now) this.c.set_conditions();
  }

  ground({ slope, bumps }) { this.c.go_to_ground(radians(slope), bumps); }
  load(kg) { this.c.load(kg); }

  /** Change the robot's speed within a tenth of a second: forward and to the left, in the world [m/s]. */
  push(x, y) { this.c.push(x * this.mass, y * this.mass); }

  /** All legs in phase again; the stored gait stays. */
  reset() { this.resetting = 1; }

  /** A controller that has learned nothing. */
  forget() { this.c.renew(); }

  tick() {
    this.variable("reset")[0] = this.resetting;
    this.resetting = 0;
    this.fares = this.c.tick();
    this.ticks++;
  }
}

export const trunk = (sample) => ({
  position: sample.subarray(SAMPLE.position, SAMPLE.position + 3),
  rpy: sample.subarray(SAMPLE.rpy, SAMPLE.rpy + 3),
});

/** A vector per leg of a sample: 0 joint angles, 4 places of the feet, 5 forces on them. */
export const perLeg = (sample, n, which, leg) => {
  const at = 9 + 3 * n * which + 3 * leg;
  return sample.subarray(at, at + 3);
};

const radians = (degrees) => (degrees * Math.PI) / 180;

// The page: it steps the loop in time with the clock, draws it, and does what is asked for.

import { Controls, by } from "./controls.js";
import { drawDial } from "./dial.js";
import { Script } from "./experiments.js";
import { GaitWatch } from "./gait.js";
import { History } from "./history.js";
import { lookOf } from "./look.js";
import { DIVERGED, Loop, WALKS, compiled } from "./loop.js";
import { Scene } from "./scene.js";
import { LIMITS, address, defaults, parsed } from "./settings.js";
import { drawStrip } from "./strip.js";

const LONGEST = 0.1; // [s] that a frame makes up for
const SHOVE = 0.45; // [m/s] of the button
const FARTHEST = 0.9; // [m/s] of a push with the mouse
const FALLEN = 3; // [s] until it starts anew
const STILL = 8; // [s] that it has walked where nothing shall move by itself

class Page {
  constructor(data, modules) {
    Object.assign(this, { data, modules, settings: parsed(data, location.hash), owed: 0, paused: false, script: null });
    this.scene = new Scene(by("scene"));
    this.controls = new Controls(this);
    this.start();
    if (matchMedia("(prefers-reduced-motion: reduce)").matches) {
      for (let t = 0; t < STILL; t += this.loop.Ts) this.step();
      this.paused = true;
    }
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.changed());
    addEventListener("resize", () => this.picture());
    addEventListener("hashchange", () => { this.settings = parsed(data, location.hash); this.start(); });
    this.changed();
    requestAnimationFrame((now) => this.frame(now));
  }

  /** A robot at its start, with what is set. */
  start() {
    this.loop = new Loop(this.data, this.modules, this.settings);
    this.history = new History(this.loop);
    this.watch = new GaitWatch(this.loop.robot, this.data.tolerance);
    this.scene.show(this.loop);
    this.script = null;
    this.fallen = 0;
    this.wasStored = false;
    this.owed = 0;
    this.story = null;
    this.controls.feet();
    this.step();
    this.changed();
  }

  get time() { return this.loop.time; }
  get stored() { return this.loop.stored; }
  get legs() { return this.loop.robot.legs; }
  get gait() { return this.watch.name; }
  get target() { return this.loop.robot.gait; }
  get formed() { return this.gait === this.target; }
  /** The gait that it should have has lasted for long enough to be named, and how long [s]. */
  get steady() { return this.watch.steady && this.watch.now === this.target; }
  get lasted() { return this.watch.lasted; }

  step() {
    this.loop.tick();
    this.history.take(this.loop);
    this.scene.take(this.history);
    this.watch.look(this.loop.variable("phi"), this.time);
    if (this.stored && !this.wasStored) this.history.note("gait stored");
    this.wasStored = this.stored;
    if (this.loop.fares !== WALKS) this.fall();
    if (this.script && !this.script.go()) this.script = null;
  }

  fall() {
    if (!this.fallen) this.history.note("fell");
    this.fallen += this.loop.Ts;
    this.say("It fell. It starts anew in a moment.");
    if (this.fallen > FALLEN || this.loop.fares === DIVERGED) this.restart = true;
  }

  frame(now) {
    requestAnimationFrame((next) => this.frame(next));
    const passed = Math.min(LONGEST, (now - (this.before ?? now)) / 1000);
    this.before = now;
    this.passed = passed;
    if (passed) this.rate = this.rate ? 0.95 * this.rate + 0.05 / passed : 1 / passed; // over about 20 frames
    if (this.paused) return;
    this.owed += passed / this.settings.slow;
    for (; this.owed >= this.loop.Ts; this.owed -= this.loop.Ts) {
      this.step();
      if (this.restart) { this.restart = false; this.start(); }
    }
    this.picture();
  }

  /** Draw between the last two ticks, so that it moves smoothly at any speed. */
  picture() {
    const { history, settings, look } = this, part = this.owed / this.loop.Ts, last = history.count - 1;
    const [a, b] = [history.sample(Math.max(history.first, last - 1)), history.sample(last)];
    const sample = b.map((value, k) => a[k] + part * (value - a[k]));
    this.scene.draw({ sample, look, off: settings.off, payload: settings.load, tick: last, passed: this.passed ?? 0, fallen: this.fallen > 0 });
    drawStrip(by("strip"), history, part, look, settings.off);
    drawDial(by("dial"), history, part, look, this.stored);
    this.words();
  }

  words() {
    const { history } = this, remembers = this.settings.controller === "apnc";
    const name = this.fallen ? "Fell" : this.gait ? this.gait[0].toUpperCase() + this.gait.slice(1) : "Finding its gait …";
    put("gait", name);
    put("stored", !remembers ? "stores no gait" : this.stored ? "gait stored" : "no gait stored yet");
    by("stored").classList.toggle("on", this.stored);
    if (history.count % 15 === 0 || this.paused) put("speed", `${history.speed(1.5).toFixed(2)} m/s`);
    put("clock", `${this.time.toFixed(1)} s${this.counting ? ` · ${Math.round(this.rate ?? 0)} frames/s` : ""}`);
    put("story", this.story ?? this.usual());
    by("break").classList.toggle("inviting", this.stored && !this.settings.off.size && !this.script);
  }

  /** What is told while no experiment runs. */
  usual() {
    const { off } = this.settings, remembers = this.settings.controller === "apnc", count = { 4: "Four", 6: "Six", 8: "Eight" }[this.legs.length];
    if (off.size) {
      const which = off.size === this.legs.length ? "No leg feels" : `${[...off].join(" and ")} no longer feel${off.size > 1 ? "" : "s"}`;
      return this.stored ? `${which} the ground. It walks on: the stored gait holds the legs together.` : `${which} the ground, and no gait is stored.`;
    }
    if (!this.formed) return `${count} legs, each with a rhythm of its own that feels its own foot and nothing else. Nobody tells them the order.`;
    if (!remembers) return `They found a ${this.gait}. This controller stores no gait.`;
    if (!this.stored) return `They found a ${this.gait}. If it stays, the controller stores it.`;
    return `They found a ${this.gait} by themselves, and it is stored. Now break a foot sensor.`;
  }

  say(text) { this.story = text; }

  /** Anything that is shown has changed: theme, settings, pause. */
  changed() {
    this.look = lookOf(this.loop.robot);
    this.controls.show();
    history.replaceState(null, "", address(this.data, this.settings));
    this.picture();
  }

  // ---- what can be asked for ----

  set(name, value) {
    const [low, high] = LIMITS[name], { settings, loop } = this;
    settings[name] = Math.round(1000 * Math.min(high, Math.max(low, value))) / 1000;
    if (name === "mi" || name === "turn") loop.command(settings);
    if (name === "load") loop.load(settings.load);
    if (name === "slope" || name === "bumps") loop.ground(settings);
    this.changed();
  }

  begin(changes) {
    const other = changes?.robot && changes.robot !== this.settings.robot;
    Object.assign(this.settings, other ? { ...defaults(this.data, changes.robot), controller: this.settings.controller } : changes);
    if (other) this.settings.off.clear();
    this.start();
  }

  sensors(off) {
    const before = this.settings.off;
    this.settings.off = new Set(off);
    this.loop.sensors(this.settings.off);
    const all = this.settings.off.size === this.legs.length, lost = [...this.settings.off].filter((leg) => !before.has(leg));
    if (lost.length) this.history.note(all && lost.length > 1 ? "all sensors off" : `${lost.join(", ")} off`);
    else if (before.size) this.history.note("repaired");
    this.changed();
  }

  toggle(leg) {
    const off = new Set(this.settings.off);
    if (!off.delete(leg)) off.add(leg);
    this.free();
    this.sensors(off);
  }

  breakOne() {
    const next = this.legs.find((leg) => !this.settings.off.has(leg));
    this.free();
    this.sensors(next ? [...this.settings.off, next] : []);
  }

  repair() { this.free(); this.sensors([]); }
  /** A person takes over from an experiment. */
  free() { this.script = null; this.story = null; }

  reset() { this.loop.reset(); this.history.note("reset"); }
  forget() { this.loop.forget(); this.history.note("forgotten"); }

  shove(side = Math.random() < 0.5 ? "left" : "right") {
    const yaw = this.loop.sample[5], way = side === "left" ? 1 : -1;
    this.loop.push(-way * SHOVE * Math.sin(yaw), way * SHOVE * Math.cos(yaw));
    this.history.note("push");
  }

  /** A push along a way on the ground [px]. */
  shoveAlong([x, y]) {
    const length = Math.hypot(x, y), speed = Math.min(FARTHEST, 0.004 * length);
    if (length < 5) return;
    this.loop.push((speed * x) / length, (speed * y) / length);
    this.history.note("push");
  }

  experiment(name) {
    if (this.settings.controller !== "apnc" || this.fallen) this.begin({ controller: "apnc" });
    this.free();
    if (this.paused) this.pause();
    this.script = new Script(name, this);
    by("scene").scrollIntoView({ block: "nearest" });
  }

  pause() { this.paused = !this.paused; this.before = undefined; this.changed(); }
  /** Show how many frames the browser draws in a second, or no longer. */
  count() { this.counting = !this.counting; this.words(); }
  slower() { this.settings.slow = { 1: 4, 4: 10, 10: 1 }[this.settings.slow] ?? 1; this.changed(); }
  /** Another seed: another sensor noise and another asymmetry of the robot. */
  again() { this.begin({ seed: this.settings.seed + 1 }); }

  save() {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([this.history.csv(this.data)], { type: "text/csv" }));
    link.download = "walk.csv";
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  }

  async share() {
    try {
      await navigator.clipboard.writeText(location.href);
      this.say("The address of this walk is in the clipboard.");
    } catch {
      this.say("The address of the page holds this walk: copy it from there.");
    }
  }
}

function put(id, text) {
  const element = by(id);
  if (element.textContent !== text) element.textContent = text;
}

const data = JSON.parse(by("data").textContent);
if (typeof WebAssembly === "object") {
  compiled(data).then((modules) => { window.play = new Page(data, modules); }, () => document.body.classList.add("still"));
} else {
  document.body.classList.add("still");
}

// Everything that can be pressed, moved or typed.

const WORDS = {
  mi: (v) => `MI ${v.toFixed(2)}`, turn: (v) => (v === 0 ? "straight" : `${Math.round(100 * Math.abs(v))} % ${v > 0 ? "left" : "right"}`),
  load: (v) => `${v.toFixed(2)} kg`, slope: (v) => (v === 0 ? "level" : `${Math.abs(v)}° ${v > 0 ? "up" : "down"}`),
  bumps: (v) => (v === 0 ? "none" : `${Math.round(12.65 * v)} mm`),
};

export const by = (id) => document.getElementById(id);

export class Controls {
  constructor(page) {
    this.page = page;
    this.sliders = [...document.querySelectorAll("input[type=range]")];
    for (const slider of this.sliders) slider.addEventListener("input", () => page.set(slider.name, Number(slider.value)));
    for (const name of ["robot", "controller"]) by(name).addEventListener("change", (event) => page.begin({ [name]: event.target.value }));
    for (const button of document.querySelectorAll("[data-do]")) button.addEventListener("click", () => page[button.dataset.do](button.dataset.with));
    document.addEventListener("keydown", (event) => this.key(event));
    this.choices("controller", Object.entries(page.data.controllers));
    this.choices("robot", page.data.robots.map(({ name, legs }) => [name, `${name[0].toUpperCase()}${name.slice(1)}, ${legs.length} legs`]));
    this.onScene(by("scene"));
  }

  choices(id, entries) { by(id).replaceChildren(...entries.map(([value, text]) => new Option(text, value))); }

  /** A switch per foot sensor, placed as the feet are, seen from above. */
  feet() {
    const { legs } = this.page.loop.robot, rows = legs.length / 2, box = by("feet");
    box.replaceChildren(...legs.map((leg, k) => {
      const button = document.createElement("button");
      button.type = "button";
      button.className = "foot";
      button.dataset.leg = leg;
      button.style.gridArea = `${(k % rows) + 1} / ${k < rows ? 2 : 1}`;
      button.addEventListener("click", () => this.page.toggle(leg));
      return button;
    }));
  }

  /** Show what is set. */
  show() {
    const { settings, loop, look, paused } = this.page;
    for (const slider of this.sliders) {
      slider.value = settings[slider.name];
      slider.parentElement.querySelector("output").textContent = WORDS[slider.name](settings[slider.name]);
      slider.setAttribute("aria-valuetext", WORDS[slider.name](settings[slider.name]));
    }
    for (const name of ["robot", "controller"]) by(name).value = settings[name];
    for (const button of by("feet").children) {
      const { leg } = button.dataset, off = settings.off.has(leg);
      button.textContent = off ? `${leg} is off` : `${leg} works`;
      button.setAttribute("aria-pressed", String(off));
      button.style.setProperty("--leg", look.colours[loop.robot.legs.indexOf(leg)]);
    }
    const left = loop.robot.legs.filter((leg) => !settings.off.has(leg)).length;
    by("break").textContent = left === loop.robot.legs.length ? "Break a foot sensor" : left ? "Break another one" : "Repair all sensors";
    by("pause").textContent = paused ? "▶ Play" : "❚❚ Pause";
    by("slow").textContent = { 1: "Slow motion", 4: "Slower still", 10: "Real time" }[settings.slow];
    by("slow").setAttribute("aria-pressed", String(settings.slow !== 1));
  }

  key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target.matches("select")) return;
    const { page } = this, leg = page.loop.robot.legs[Number(event.key) - 1];
    const nudge = (name, by) => page.set(name, page.settings[name] + by);
    const keys = {
      " ": () => page.pause(), b: () => page.breakOne(), o: () => page.sensors(page.settings.off.size ? [] : page.legs), p: () => page.shove(), r: () => page.reset(),
      f: () => page.forget(), n: () => page.again(), s: () => page.slower(), i: () => page.count(), "+": () => nudge("mi", 0.01), "-": () => nudge("mi", -0.01),
      ArrowLeft: () => nudge("turn", 0.1), ArrowRight: () => nudge("turn", -0.1),
    };
    const slides = event.target.matches("input"), presses = event.target.matches("button, a, summary");
    if ((slides && event.key.startsWith("Arrow")) || (presses && (event.key === " " || event.key === "Enter"))) return;
    const act = keys[event.key] ?? keys[event.key.toLowerCase()] ?? (leg && (() => page.toggle(leg)));
    if (!act) return;
    event.preventDefault();
    act();
  }

  /** Drag turns the view, shift-drag pushes the robot, the wheel and two fingers zoom. */
  onScene(canvas) {
    const { page } = this, { scene } = page, fingers = new Map();
    let from = null, pushing = false;
    const middle = (event) => { const box = canvas.getBoundingClientRect(); return [event.clientX - box.left, event.clientY - box.top]; };
    canvas.addEventListener("pointerdown", (event) => {
      fingers.set(event.pointerId, middle(event));
      canvas.setPointerCapture(event.pointerId);
      from = middle(event);
      pushing = event.shiftKey;
    });
    canvas.addEventListener("pointermove", (event) => {
      if (!fingers.has(event.pointerId)) return;
      const [before, at] = [fingers.get(event.pointerId), middle(event)];
      if (fingers.size === 2) {
        const other = [...fingers].find(([id]) => id !== event.pointerId)[1], apart = (p) => Math.hypot(p[0] - other[0], p[1] - other[1]);
        scene.camera.zoom(apart(before) / Math.max(1, apart(at)));
      } else if (pushing) scene.aim = [at[0] - from[0], at[1] - from[1]];
      else scene.camera.turn(at[0] - before[0], at[1] - before[1]);
      fingers.set(event.pointerId, at);
      page.picture();
    });
    const end = (event) => {
      if (pushing && scene.aim && event.type === "pointerup") page.shoveAlong(scene.groundwards(scene.aim));
      scene.aim = null;
      pushing = false;
      fingers.delete(event.pointerId);
    };
    canvas.addEventListener("pointerup", end);
    canvas.addEventListener("pointercancel", end);
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      scene.camera.zoom(Math.exp(0.001 * event.deltaY));
      page.picture();
    }, { passive: false });
  }
}

// Seen in the page: walks on loops of their own, at once, beside the one that is shown.
window.apncReady = () => window.play !== undefined;
window.apncProbe = () => {
  const page = window.play, { data, modules, loop } = page, Loop = loop.constructor, Watch = page.watch.constructor;
  const own = { controller: "apnc", mi: 0.08, turn: 0, load: 0, slope: 0, bumps: 0, off: [] };
  const made = (settings) => {
    const all = { ...own, ...settings };
    return new Loop(data, modules, { ...all, off: new Set(all.off) });
  };
  const walk = (at, seconds) => {
    const watch = new Watch(at.robot, data.tolerance), [x, y] = at.sample, loads = [];
    for (let n = Math.round(seconds / at.Ts); n > 0; n--) {
      at.tick();
      watch.look(at.variable("phi"), at.time);
      loads.push(at.robot.legs.reduce((sum, _, leg) => sum + at.sample[9 + 3 * (5 * at.n + leg) + 2], 0));
    }
    const way = Math.hypot(at.sample[0] - x, at.sample[1] - y);
    return { gait: watch.name, stored: at.stored, way, load: loads.reduce((a, b) => a + b) / loads.length, fares: at.fares };
  };
  const walks = Object.fromEntries(Object.entries(WALKS).map(([name, settings]) => {
    const at = made(settings);
    for (let n = 0; n <= TICK; n++) at.tick();
    return [name, { time: at.time, position: [...at.sample.slice(0, 3)], phi: [...at.variable("phi")] }];
  }));
  const start = { robot: "lilibot", seed: 0, mi: 0.18 }, all = new Set(["RF", "RH", "LF", "LH"]);
  const story = (act, seconds = 8) => {
    const at = made(start);
    walk(at, 8);
    act(at);
    return walk(at, seconds);
  };
  const pushed = made(start), left = made(start);
  walk(pushed, 6);
  walk(left, 6);
  pushed.push(0, 0.3);
  walk(pushed, 0.1 + loop.Ts);
  walk(left, 0.1 + loop.Ts);
  const seen = page.history.csv(data).split("\n");
  const hash = (change) => { change(); return location.hash; };
  const typed = (key) => {
    document.body.dispatchEvent(new KeyboardEvent("keydown", { key, bubbles: true }));
    return document.getElementById("clock").textContent;
  };
  return {
    walks,
    formed: walk(made(start), 8),
    blind: story((at) => at.sensors(all), 10),
    recalled: story((at) => { at.sensors(all); at.reset(); }),
    forgotten: story((at) => { at.sensors(all); at.forget(); }),
    relearned: story((at) => at.forget()),
    loaded: story((at) => at.load(1.0)),
    tilted: story((at) => at.ground({ slope: 4, bumps: 0 })),
    rough: story((at) => at.ground({ slope: 0, bumps: 1 })),
    shoved: story((at) => at.push(0, 0.4)),
    push: pushed.sample[7] - left.sample[7],
    columns: seen[0].split(","),
    widths: seen.slice(1, -1).map((line) => line.split(",").length),
    lines: page.history.count - page.history.first,
    hash: [
      hash(() => page.breakOne()), hash(() => page.set("slope", -2)), hash(() => page.begin({ controller: "apc" })),
      hash(() => page.begin({ robot: "hexapod" })), hash(() => page.pause()),
    ],
    broken: document.getElementById("feet").textContent,
    said: document.getElementById("gait").textContent,
    still: document.body.classList.contains("still"),
    clocks: [typed("i"), typed("i")],
    requests: performance.getEntriesByType("resource").map((entry) => entry.name),
  };
};

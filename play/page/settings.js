// What a person has set, and its way into the address of the page and back.

export const LIMITS = { mi: [0.04, 0.4], turn: [-1, 1], load: [0, 1.5], slope: [-8, 8], bumps: [0, 1], seed: [0, 2 ** 32 - 1], slow: [1, 10] };

export function defaults(data, name = data.robots[0].name) {
  const { mi, seed } = data.robots.find((robot) => robot.name === name);
  return { robot: name, controller: Object.keys(data.controllers)[0], seed, mi, turn: 0, load: 0, slope: 0, bumps: 0, slow: 1, off: new Set() };
}

/** Settings of an address, e.g. #robot=hexapod&mi=0.2&off=RF.LH; what is missing or wrong is the default. */
export function parsed(data, hash) {
  const given = new URLSearchParams(hash.replace(/^#/, ""));
  const robot = data.robots.find((r) => r.name === given.get("robot")) ?? data.robots[0];
  const settings = defaults(data, robot.name);
  if (given.get("controller") in data.controllers) settings.controller = given.get("controller");
  for (const [name, [low, high]] of Object.entries(LIMITS)) {
    const value = Number.parseFloat(given.get(name));
    if (Number.isFinite(value)) settings[name] = Math.min(high, Math.max(low, value));
  }
  settings.seed = Math.round(settings.seed);
  settings.off = new Set((given.get("off") ?? "").split(".").filter((leg) => robot.legs.includes(leg)));
  return settings;
}

/** The address of settings: only what is not the default. */
export function address(data, settings) {
  const own = defaults(data, settings.robot), told = new URLSearchParams();
  if (settings.robot !== data.robots[0].name) told.set("robot", settings.robot);
  for (const name of ["controller", ...Object.keys(LIMITS)]) if (settings[name] !== own[name]) told.set(name, settings[name]);
  if (settings.off.size) told.set("off", [...settings.off].join("."));
  return told.size ? `#${told}` : "#";
}

"use strict";
// Draws one moment of the walk on a canvas: ground, path, trunk, legs, ground forces.
apnc.Scene = class {
  constructor(canvas, source) {
    this.canvas = canvas;
    this.context = canvas.getContext("2d");
    this.n = source.legs.length;
    this.count = source.count;
    this.legs = source.legs;
    this.colours = source.colours;
    this.trunk = source.trunk;
    this.trunkCenter = source.trunkCenter;
    this.weight = source.weight;
    for (const key of ["position", "rpy", "chains", "force"]) this[key] = apnc.unpack(source[key], Float32Array);
    this.stance = apnc.unpack(source.stance, Uint8Array);
    this.prints = this.footprints();
    this.view("orbit");
    this.zoom = 1;
  }

  // Presets are relative to a heading, so that the side view stays one after a turn.
  view(name, yaw = 0) {
    const presets = { orbit: [-0.95, 0.42], side: [-Math.PI / 2, 0.0], top: [-Math.PI / 2, Math.PI / 2], front: [0, 0.0] };
    [this.azimuth, this.elevation] = presets[name];
    this.azimuth += yaw;
  }

  // Where and when every foot came down, so that past steps can be shown on the ground.
  footprints() {
    const list = [];
    for (let i = 1; i < this.count; i++) {
      for (let leg = 0; leg < this.n; leg++) {
        if (this.stance[i * this.n + leg] && !this.stance[(i - 1) * this.n + leg]) {
          const [x, y] = this.point(i, leg, 3);
          list.push({ i, leg, x, y });
        }
      }
    }
    return list;
  }

  point(i, leg, joint) {
    const at = ((i * this.n + leg) * 4 + joint) * 3;
    return [this.chains[at], this.chains[at + 1], this.chains[at + 2]];
  }

  vector(array, i) { return [array[3 * i], array[3 * i + 1], array[3 * i + 2]]; }

  // The camera follows the mean of the last moments, so that the sway of the trunk stays visible.
  focus(i) {
    const from = Math.max(0, i - 45), to = Math.min(this.count - 1, i + 45);
    let x = 0, y = 0;
    for (let k = from; k <= to; k++) { x += this.position[3 * k]; y += this.position[3 * k + 1]; }
    return [x / (to - from + 1), y / (to - from + 1), 0.08];
  }

  // Parallel projection; the camera looks from (azimuth, elevation) in the world frame.
  project([x, y, z]) {
    const dx = x - this.centre[0], dy = y - this.centre[1], dz = z - this.centre[2];
    const ca = Math.cos(this.azimuth), sa = Math.sin(this.azimuth);
    const ce = Math.cos(this.elevation), se = Math.sin(this.elevation);
    const right = -dx * sa + dy * ca, depth = dx * ca + dy * sa;
    const up = dz * ce - depth * se;
    return [this.width / 2 + right * this.scale, this.height * 0.56 - up * this.scale, depth * ce + dz * se];
  }

  draw(i) {
    const ratio = window.devicePixelRatio || 1;
    this.width = this.canvas.clientWidth;
    this.height = this.canvas.clientHeight;
    if (this.canvas.width !== Math.round(this.width * ratio)) this.canvas.width = Math.round(this.width * ratio);
    if (this.canvas.height !== Math.round(this.height * ratio)) this.canvas.height = Math.round(this.height * ratio);
    this.scale = 1250 * this.zoom * Math.min(1, this.height / 440);
    this.centre = this.focus(i);
    const c = this.context;
    c.setTransform(ratio, 0, 0, ratio, 0, 0);
    c.clearRect(0, 0, this.width, this.height);
    c.lineCap = c.lineJoin = "round";
    this.ground();
    this.track(i);
    const middle = this.project(this.vector(this.position, i))[2];
    const parts = [{ depth: middle, paint: () => this.box(i) }];
    for (let leg = 0; leg < this.n; leg++) {
      // Sorted by the hip: a leg is as a whole before or behind the trunk.
      parts.push({ depth: this.project(this.point(i, leg, 1))[2], paint: () => this.leg(i, leg) });
    }
    parts.sort((a, b) => a.depth - b.depth).forEach((part) => part.paint());
    for (let leg = 0; leg < this.n; leg++) this.arrow(i, leg);
  }

  path(points, style, width, dash = []) {
    const c = this.context;
    c.beginPath();
    for (const p of points) { const [x, y] = this.project(p); c.lineTo(x, y); }
    c.strokeStyle = style; c.lineWidth = width; c.setLineDash(dash); c.stroke(); c.setLineDash([]);
  }

  ground() {
    const step = 0.1, reach = 1.2;
    const x0 = Math.round(this.centre[0] / step), y0 = Math.round(this.centre[1] / step), n = reach / step;
    for (let k = -n; k <= n; k++) {
      const x = (x0 + k) * step, y = (y0 + k) * step;
      // Stronger lines every half metre stay put in the world and show the progress.
      const tone = (m) => (m % 5 === 0 ? ["#b9c2cd", 1.3] : ["#e3e7ec", 1]);
      this.path([[x, this.centre[1] - reach, 0], [x, this.centre[1] + reach, 0]], ...tone(x0 + k));
      this.path([[this.centre[0] - reach, y, 0], [this.centre[0] + reach, y, 0]], ...tone(y0 + k));
    }
  }

  track(i) {
    const points = [];
    for (let k = Math.max(0, i - 900); k <= i; k += 6) points.push([this.position[3 * k], this.position[3 * k + 1], 0]);
    this.path(points, "#8a94a0", 1.5, [2, 5]);
    const c = this.context;
    for (const print of this.prints) {
      if (print.i > i || i - print.i > 600) continue;
      const [x, y] = this.project([print.x, print.y, 0]);
      c.globalAlpha = 0.55 * (1 - (i - print.i) / 600);
      c.fillStyle = this.colours[print.leg];
      c.beginPath();
      c.ellipse(x, y, 6, Math.max(1.2, 6 * Math.sin(this.elevation)), 0, 0, 2 * Math.PI);
      c.fill();
      c.globalAlpha = 1;
    }
  }

  box(i) {
    const p = this.vector(this.position, i), [r, t, w] = this.vector(this.rpy, i);
    const [cr, sr, cp, sp, cy, sy] = [Math.cos(r), Math.sin(r), Math.cos(t), Math.sin(t), Math.cos(w), Math.sin(w)];
    const world = ([x, y, z]) => [
      p[0] + cy * cp * x + (cy * sp * sr - sy * cr) * y + (cy * sp * cr + sy * sr) * z,
      p[1] + sy * cp * x + (sy * sp * sr + cy * cr) * y + (sy * sp * cr - cy * sr) * z,
      p[2] - sp * x + cp * sr * y + cp * cr * z,
    ];
    const [l, b, h] = this.trunk.map((v) => v / 2), [ox, oy, oz] = this.trunkCenter;
    const corner = (sx, sy_, sz) => this.project(world([ox + sx * l, oy + sy_ * b, oz + sz * h]));
    const faces = [
      [[1, -1, -1], [1, 1, -1], [1, 1, 1], [1, -1, 1], "#a9b6c4"], [[-1, 1, -1], [-1, -1, -1], [-1, -1, 1], [-1, 1, 1], "#a9b6c4"],
      [[-1, -1, -1], [1, -1, -1], [1, -1, 1], [-1, -1, 1], "#c0cad5"], [[1, 1, -1], [-1, 1, -1], [-1, 1, 1], [1, 1, 1], "#c0cad5"],
      [[-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1], "#dde4ec"], [[-1, 1, -1], [1, 1, -1], [1, -1, -1], [-1, -1, -1], "#8f9dac"],
    ];
    const c = this.context;
    for (const face of faces) {
      const q = face.slice(0, 4).map((v) => corner(...v));
      const area = (q[1][0] - q[0][0]) * (q[2][1] - q[1][1]) - (q[1][1] - q[0][1]) * (q[2][0] - q[1][0]);
      if (area >= 0) continue;
      c.beginPath();
      q.forEach(([x, y]) => c.lineTo(x, y));
      c.closePath();
      c.fillStyle = face[4]; c.fill();
      c.strokeStyle = "#5b6673"; c.lineWidth = 1; c.stroke();
    }
    const top = h + oz + 0.001;
    this.path([[-0.5 * l, 0, top], [0.7 * l, 0, top]].map(world), "#33404d", 2);
    this.path([[0.45 * l, 0.3 * b, top], [0.7 * l, 0, top], [0.45 * l, -0.3 * b, top]].map(world), "#33404d", 2);
  }

  leg(i, leg) {
    const chain = [0, 1, 2, 3].map((joint) => this.point(i, leg, joint));
    const colour = this.colours[leg], c = this.context;
    this.path(chain, "#ffffff", 9);
    this.path(chain, colour, 6);
    for (const joint of [1, 2]) this.dot(chain[joint], 4, "#ffffff", colour, 2);
    const standing = this.stance[i * this.n + leg];
    this.dot(chain[3], 0.012 * this.scale * 0.9, standing ? colour : "#ffffff", colour, 2.5);
    const [x, y] = this.project(chain[3]);
    c.fillStyle = "#1f2933"; c.font = "600 11px system-ui, sans-serif"; c.textAlign = "center";
    c.fillText(this.legs[leg], x, y + 0.012 * this.scale + 12);
  }

  dot(point, radius, fill, stroke, width) {
    const [x, y] = this.project(point), c = this.context;
    c.beginPath(); c.arc(x, y, radius, 0, 2 * Math.PI);
    c.fillStyle = fill; c.fill(); c.strokeStyle = stroke; c.lineWidth = width; c.stroke();
  }

  arrow(i, leg) {
    const force = this.vector(this.force, i * this.n + leg);
    const size = Math.hypot(...force) / this.weight;
    if (size < 0.02) return;
    const foot = this.point(i, leg, 3), base = [foot[0], foot[1], 0];
    // A tenth of a metre stands for half the weight.
    const tip = base.map((v, k) => v + (force[k] / this.weight) * 0.2);
    this.path([base, tip], "#1f2933", 2.2);
    const [x0, y0] = this.project(base), [x1, y1] = this.project(tip);
    const length = Math.hypot(x1 - x0, y1 - y0);
    if (length < 8) return;
    const ux = (x1 - x0) / length, uy = (y1 - y0) / length, c = this.context;
    c.beginPath();
    c.moveTo(x1 + 5 * ux, y1 + 5 * uy); c.lineTo(x1 - 5 * ux - 4 * uy, y1 - 5 * uy + 4 * ux); c.lineTo(x1 - 5 * ux + 4 * uy, y1 - 5 * uy - 4 * ux);
    c.fillStyle = "#1f2933"; c.fill();
  }
};

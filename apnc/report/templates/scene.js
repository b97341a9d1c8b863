"use strict";
// Draws one moment of the walk on a canvas: ground, path, trunk, legs, ground forces.
apnc.Scene = class {
  constructor(canvas, source) {
    Object.assign(this, source, { canvas, context: canvas.getContext("2d"), n: source.legs.length, zoom: 1 });
    for (const key of ["position", "rpy", "focus", "track", "chains", "force", "ground", "landmarks"]) this[key] = apnc.unpack(source[key], Float32Array);
    this.stance = apnc.unpack(source.stance, Uint8Array);
    // The robot as it stands at the start fills the same part of the picture, whatever its size.
    const feet = Array.from({ length: this.n }, (_, leg) => this.point(0, leg, 3));
    const span = (k) => Math.max(...feet.map((p) => p[k])) - Math.min(...feet.map((p) => p[k]));
    this.size = Math.max(Math.hypot(span(0), span(1)), this.trunk[0]);
    this.reach = 4.5 * this.size;
    this.above = this.focus[2] - this.track[2];
    this.prints = this.footprints();
    this.view("3d");
  }

  // Presets are relative to a heading, so that the side view stays one after a turn.
  view(name, yaw = 0) {
    const presets = { "3d": [-0.95, 0.42], side: [-Math.PI / 2, 0.0], top: [-Math.PI / 2, Math.PI / 2], front: [0, 0.0] };
    [this.azimuth, this.elevation] = presets[name];
    this.azimuth += yaw;
  }

  // Where and when every foot came down, so that past steps can be shown on the ground.
  footprints() {
    const list = [];
    for (let i = 1; i < this.count; i++) {
      for (let leg = 0; leg < this.n; leg++) {
        if (this.stance[i * this.n + leg] && !this.stance[(i - 1) * this.n + leg]) list.push({ i, leg, place: this.sole(i, leg) });
      }
    }
    return list;
  }

  vector(array, i) { return [array[3 * i], array[3 * i + 1], array[3 * i + 2]]; }
  point(i, leg, joint) { return this.vector(this.chains, (i * this.n + leg) * 4 + joint); }
  sole(i, leg) { return this.point(i, leg, 3).map((v, k) => v - this.radius * this.normal[k]); }

  // Parallel projection; the camera looks from (azimuth, elevation) in the world frame.
  project([x, y, z]) {
    const dx = x - this.centre[0], dy = y - this.centre[1], dz = z - this.centre[2];
    const ca = Math.cos(this.azimuth), sa = Math.sin(this.azimuth);
    const ce = Math.cos(this.elevation), se = Math.sin(this.elevation);
    const right = -dx * sa + dy * ca, depth = dx * ca + dy * sa;
    const up = dz * ce - depth * se;
    return [this.width / 2 + right * this.scale, this.height * 0.45 - up * this.scale, depth * ce + dz * se];
  }

  draw(i) {
    const ratio = window.devicePixelRatio || 1, canvas = this.canvas;
    this.width = canvas.clientWidth;
    this.height = canvas.clientHeight;
    for (const side of ["width", "height"]) if (canvas[side] !== Math.round(this[side] * ratio)) canvas[side] = Math.round(this[side] * ratio);
    this.scale = (0.6 * Math.min(this.height, 0.7 * this.width) / this.size) * this.zoom;
    this.centre = this.vector(this.focus, i);
    const c = this.context;
    c.setTransform(ratio, 0, 0, ratio, 0, 0);
    c.clearRect(0, 0, this.width, this.height);
    c.lineCap = c.lineJoin = "round";
    this.surface();
    this.past(i);
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

  // The lines of the ground, cut off at a square around the robot.
  surface() {
    const [x, y, z] = this.centre, [nx, ny, nz] = this.normal, r = this.reach, c = this.context;
    const below = z - this.above;
    c.save();
    c.beginPath();
    for (const [dx, dy] of [[-r, -r], [r, -r], [r, r], [-r, r]]) c.lineTo(...this.project([x + dx, y + dy, below - (nx * dx + ny * dy) / nz]));
    c.clip();
    this.lines(this.ground, "#dde2e8", 1);
    this.lines(this.landmarks, "#b3bdc8", 1.4);
    c.restore();
  }

  lines(points, style, width) {
    const c = this.context, [cx, cy] = this.centre, r = this.reach;
    const side = (v, centre) => (v < centre - r ? -1 : v > centre + r ? 1 : 0);
    c.beginPath();
    for (let k = 3; k + 2 < points.length; k += 3) {
      const sx = side(points[k], cx), sy = side(points[k + 1], cy);
      // A step that ends on the side on which it began cannot cross the square.
      if (!(points[k] + points[k - 3] < Infinity) || (sx && sx === side(points[k - 3], cx)) || (sy && sy === side(points[k - 2], cy))) continue;
      const a = this.project([points[k - 3], points[k - 2], points[k - 1]]), b = this.project([points[k], points[k + 1], points[k + 2]]);
      c.moveTo(a[0], a[1]); c.lineTo(b[0], b[1]);
    }
    c.strokeStyle = style; c.lineWidth = width; c.stroke();
  }

  past(i) {
    const points = [];
    for (let k = Math.max(0, i - 900); k <= i; k += 6) points.push(this.vector(this.track, k));
    this.path(points, "#8a94a0", 1.5, [2, 5]);
    const c = this.context;
    for (const print of this.prints) {
      if (print.i > i || i - print.i > 600) continue;
      const [x, y] = this.project(print.place);
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
    this.path([[ox - 0.5 * l, oy, top], [ox + 0.7 * l, oy, top]].map(world), "#33404d", 2);
    this.path([[ox + 0.45 * l, oy + 0.3 * b, top], [ox + 0.7 * l, oy, top], [ox + 0.45 * l, oy - 0.3 * b, top]].map(world), "#33404d", 2);
  }

  leg(i, leg) {
    const chain = [0, 1, 2, 3].map((joint) => this.point(i, leg, joint));
    const colour = this.colours[leg], c = this.context, radius = this.radius * this.scale;
    this.path(chain, "#ffffff", 9);
    this.path(chain, colour, 6);
    for (const joint of [1, 2]) this.dot(chain[joint], 4, "#ffffff", colour, 2);
    this.dot(chain[3], 0.9 * radius, this.stance[i * this.n + leg] ? colour : "#ffffff", colour, 2.5);
    const [x, y] = this.project(chain[3]);
    c.fillStyle = "#1f2933"; c.font = "600 11px system-ui, sans-serif"; c.textAlign = "center";
    c.fillText(this.legs[leg], x, y + radius + 12);
  }

  dot(point, radius, fill, stroke, width) {
    const [x, y] = this.project(point), c = this.context;
    c.beginPath(); c.arc(x, y, radius, 0, 2 * Math.PI);
    c.fillStyle = fill; c.fill(); c.strokeStyle = stroke; c.lineWidth = width; c.stroke();
  }

  arrow(i, leg) {
    const force = this.vector(this.force, i * this.n + leg);
    if (Math.hypot(...force) < 0.02 * this.weight) return;
    const base = this.sole(i, leg);
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

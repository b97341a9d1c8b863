"use strict";
// Draws one moment of the walk on a canvas: ground, path, trunk, legs, ground forces.
apnc.Scene = class {
  constructor(canvas, source) {
    Object.assign(this, source, { canvas, n: source.legs.length, zoom: 1, stance: apnc.unpack(source.stance || "", Uint8Array) });
    for (const [name, text] of Object.entries(source.arrays)) this[name] = apnc.array(text);
    this.begin();
    this.view("3d");
  }

  begin() {
    this.time = apnc.time;
    this.above = this.focus[2] - this.track(0)[2];
    this.prints = this.footprints();
  }

  // Relative to a heading, so that the side view stays one after a turn.
  view(name, yaw = 0) {
    [this.azimuth, this.elevation] = this.look.views[name];
    this.azimuth += yaw;
  }

  // Where and when every foot came down, so that past steps can be shown on the ground.
  footprints() {
    const list = [], stands = (i, leg) => this.stance[i * this.n + leg];
    for (let i = 1; i < this.count; i++) {
      for (let leg = 0; leg < this.n; leg++) if (stands(i, leg) && !stands(i - 1, leg)) list.push({ i, leg, place: this.sole(i, leg) });
    }
    return list;
  }

  // The last sample at a time or before it, by bisection.
  sampleAt(t) {
    let low = 0, high = this.count - 1;
    while (low < high) { const middle = (low + high + 1) >> 1; if (this.time[middle] <= t + 1e-6) low = middle; else high = middle - 1; }
    return low;
  }

  vector(array, i) { return [array[3 * i], array[3 * i + 1], array[3 * i + 2]]; }
  // Joints 0 to 3 of a leg: first hip joint, second hip joint, knee, foot.
  point(i, leg, joint) { return this.placed(i, joint ? this.vector(this.chains, (i * this.n + leg) * 3 + joint - 1) : this.vector(this.hips, leg)); }
  // A point of the trunk in the world, by Rz(yaw) Ry(pitch) Rx(roll).
  placed(i, [x, y, z]) {
    const [px, py, pz] = this.vector(this.position, i), [cr, cp, cy, sr, sp, sy] = this.turn(i);
    const v = cr * y - sr * z, w = sr * y + cr * z, u = cp * x + sp * w;
    return [px + cy * u - sy * v, py + sy * u + cy * v, pz + cp * w - sp * x];
  }
  turn(i) {
    if (this.turnOf !== i) {
      const angles = this.vector(this.rpy, i);
      [this.turnOf, this.turned] = [i, [...angles.map(Math.cos), ...angles.map(Math.sin)]];
    }
    return this.turned;
  }
  // The trunk, projected on the plane of the ground.
  track(i) {
    const p = this.vector(this.position, i), away = p.reduce((sum, v, k) => sum + v * this.normal[k], 0);
    return p.map((v, k) => v - away * this.normal[k]);
  }
  sole(i, leg) { return this.point(i, leg, 3).map((v, k) => v - this.radius * this.normal[k]); }

  // Parallel projection; the camera looks from (azimuth, elevation) in the world frame.
  project([x, y, z]) {
    const dx = x - this.centre[0], dy = y - this.centre[1], dz = z - this.centre[2];
    const ca = Math.cos(this.azimuth), sa = Math.sin(this.azimuth), ce = Math.cos(this.elevation), se = Math.sin(this.elevation);
    const depth = dx * ca + dy * sa;
    return [this.width / 2 + (dy * ca - dx * sa) * this.scale, this.height * this.look.middle - (dz * ce - depth * se) * this.scale, depth * ce + dz * se];
  }

  // Context of an empty canvas in the pixels of the page, and its size.
  prepare(canvas) {
    const ratio = window.devicePixelRatio || 1, width = canvas.clientWidth, height = canvas.clientHeight, c = canvas.getContext("2d");
    canvas.width = Math.round(width * ratio); canvas.height = Math.round(height * ratio);
    c.setTransform(ratio, 0, 0, ratio, 0, 0);
    return [c, width, height];
  }

  draw(i) {
    [this.context, this.width, this.height] = this.prepare(this.canvas);
    [this.ink, this.halo, this.grid, this.strong] = ["--ink", "--canvas", "--grid", "--landmark"].map(apnc.colour);
    this.context.lineCap = this.context.lineJoin = "round";
    this.scale = (this.look.zoom * Math.min(this.height, 0.7 * this.width) / this.reach) * this.zoom;
    this.centre = this.vector(this.focus, i);
    this.surface();
    this.past(i);
    const parts = [{ depth: this.project(this.vector(this.position, i))[2], paint: () => this.box(i) }];
    // Sorted by the hip: a leg is as a whole before or behind the trunk.
    for (let leg = 0; leg < this.n; leg++) parts.push({ depth: this.project(this.point(i, leg, 1))[2], paint: () => this.leg(i, leg) });
    parts.sort((a, b) => a.depth - b.depth).forEach((part) => part.paint());
    for (let leg = 0; leg < this.n; leg++) this.arrow(i, leg);
  }

  // A line or an area through points on the canvas.
  trace(points, stroke, width, fill = null, dash = []) {
    const c = this.context;
    c.beginPath();
    for (const [x, y] of points) c.lineTo(x, y);
    if (fill) { c.closePath(); c.fillStyle = fill; c.fill(); }
    if (stroke) { c.strokeStyle = stroke; c.lineWidth = width; c.setLineDash(dash); c.stroke(); c.setLineDash([]); }
  }
  path(points, ...style) { this.trace(points.map((p) => this.project(p)), ...style); }

  // The lines of the ground, cut off at a square around the robot.
  surface() {
    const [x, y, z] = this.centre, [nx, ny, nz] = this.normal, r = this.reach, c = this.context;
    c.save();
    this.path([[-r, -r], [r, -r], [r, r], [-r, r]].map(([dx, dy]) => [x + dx, y + dy, z - this.above - (nx * dx + ny * dy) / nz]));
    c.clip();
    this.lines(this.ground, this.grid, 1);
    this.lines(this.landmarks, this.strong, 1.4);
    c.restore();
  }

  lines(points, style, width) {
    const c = this.context, [cx, cy] = this.centre, r = this.reach;
    const side = (v, centre) => (v < centre - r ? -1 : v > centre + r ? 1 : 0);
    c.beginPath();
    for (let k = 3; k < points.length; k += 3) {
      const sx = side(points[k], cx), sy = side(points[k + 1], cy);
      // A step that ends on the side on which it began cannot cross the square.
      if (Number.isNaN(points[k - 3] + points[k]) || (sx && sx === side(points[k - 3], cx)) || (sy && sy === side(points[k - 2], cy))) continue;
      const [p, q] = [k - 3, k].map((at) => this.project(points.subarray(at, at + 3)));
      c.moveTo(p[0], p[1]); c.lineTo(q[0], q[1]);
    }
    c.strokeStyle = style; c.lineWidth = width; c.stroke();
  }

  past(i) {
    const points = [], c = this.context, shown = this.look.prints;
    for (let k = Math.max(0, i - this.look.tracked); k <= i; k += this.look.trackStep) points.push(this.track(k));
    this.path(points, this.look.track, 1.5, null, [2, 5]);
    for (const print of this.prints) {
      if (print.i > i || i - print.i > shown) continue;
      const [x, y] = this.project(print.place);
      c.globalAlpha = 0.55 * (1 - (i - print.i) / shown);
      c.fillStyle = this.colours[print.leg];
      c.beginPath(); c.ellipse(x, y, 6, Math.max(1.2, 6 * Math.sin(this.elevation)), 0, 0, 2 * Math.PI); c.fill();
    }
    c.globalAlpha = 1;
  }

  box(i) {
    const corners = Array.from({ length: 8 }, (_, k) => this.placed(i, this.vector(this.corners, k))), seen = corners.map((p) => this.project(p));
    for (const [face, colour] of this.look.faces) {
      const [a, b, c] = face.map((at) => seen[at]);
      const front = (b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0]) < 0;
      if (front) this.trace(face.map((at) => seen[at]), this.look.edge, 1, colour);
    }
    // An arrow on the top shows where the front is.
    const top = ([x, y]) => corners[1].map((v, k) => v + x * (corners[3][k] - v) + y * (corners[5][k] - v));
    for (const arrow of this.look.arrow) this.path(arrow.map(top), this.look.nose, 2);
  }

  leg(i, leg) {
    const chain = [0, 1, 2, 3].map((joint) => this.point(i, leg, joint));
    const colour = this.colours[leg], c = this.context, radius = this.radius * this.scale, [x, y] = this.project(chain[3]);
    this.path(chain, this.halo, 9);
    this.path(chain, colour, 6);
    const dot = (point, size, fill) => {
      const [u, v] = this.project(point);
      c.beginPath(); c.arc(u, v, size, 0, 2 * Math.PI);
      c.fillStyle = fill; c.fill(); c.strokeStyle = colour; c.lineWidth = 2; c.stroke();
    };
    for (const joint of [1, 2]) dot(chain[joint], 4, this.halo);
    dot(chain[3], 0.9 * radius, this.stance[i * this.n + leg] ? colour : this.halo);
    c.fillStyle = this.ink; c.font = "600 11px system-ui, sans-serif"; c.textAlign = "center";
    c.fillText(this.legs[leg], x, y + radius + 12);
  }

  // A tenth of a metre stands for half the weight.
  arrow(i, leg) {
    const force = this.vector(this.force, i * this.n + leg), base = this.sole(i, leg);
    if (Math.hypot(...force) < this.look.leastForce * this.weight) return;
    const [[x0, y0], [x1, y1]] = [base, base.map((v, k) => v + (force[k] / this.weight) * this.look.force)].map((p) => this.project(p));
    const length = Math.hypot(x1 - x0, y1 - y0), ux = (x1 - x0) / length, uy = (y1 - y0) / length;
    this.trace([[x0, y0], [x1, y1]], this.ink, 2.2);
    if (length >= 8) this.trace([[x1 + 5 * ux, y1 + 5 * uy], [x1 - 5 * ux - 4 * uy, y1 - 5 * uy + 4 * ux], [x1 - 5 * ux + 4 * uy, y1 - 5 * uy - 4 * ux]], null, 0, this.ink);
  }
};

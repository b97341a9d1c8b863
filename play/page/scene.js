// The robot on its ground, as seen by a camera that follows it.

import { perLeg, trunk } from "./loop.js";
import { Camera, add, chainOf, dot, groundFrame, mix, rotation, turned, turnedBack } from "./space.js";
import { LIGHT, bevelled, css, drawBall, drawFaces, drawLimb, rgb, shade, shadowOf } from "./solids.js";

// lengths [m] are those for a robot of Lilibot's size; larger ones are seen from farther away
const TILE = 0.2; // edge of a tile that is drawn
const REACH = 1.7; // of the ground that is drawn
const RINGS = 12; // steps in which the floor fades
const PRINTS = 10; // [s] that footprints last
const ARROW = 0.13; // of the arrow of a load of half the weight
const CALM = 0.15; // [s] by which the camera lags behind
const TURNS = 1.5; // [s] by which it lags behind the heading
const LOST = 0.3; // lag at which it jumps
const DARK = [43, 50, 58];

export class Scene {
  constructor(canvas) {
    Object.assign(this, { canvas, camera: new Camera(), prints: [], aim: null, before: [] });
    this.camera.follow = null;
  }

  /** Another robot, or the same from its start. */
  show(loop) {
    const { robot } = loop;
    Object.assign(this, { robot, n: loop.n, loop, prints: [], before: [], size: robot.size });
    Object.assign(this.camera, { follow: null, size: robot.size });
    this.trunk = bevelled(robot.trunk.size, robot.trunk.center, 0.014 * robot.size);
    const [, , height] = robot.trunk.size, lift = (height + robot.payload[2]) / 2;
    this.payload = bevelled(robot.payload, add(robot.trunk.center, [0, 0, lift]), 0.006 * robot.size);
    this.half = robot.trunk.size[1] / 2;
    this.far = Math.max(...robot.chains.map((leg) => Math.hypot(...leg.mount))) / robot.size;
  }

  /** Remember where feet came down. */
  take(history) {
    const tick = history.count - 1;
    for (let leg = 0; leg < this.n; leg++) {
      if (tick && history.stands(tick, leg) && !history.stands(tick - 1, leg)) {
        this.prints.push({ tick, leg, at: [...perLeg(history.sample(tick), this.n, 4, leg)] });
      }
    }
    while (this.prints.length && tick - this.prints[0].tick > PRINTS / history.Ts) this.prints.shift();
  }

  /** Canvas in the pixels of the screen; colours of the theme. */
  prepare() {
    const { canvas } = this, ratio = Math.min(2, window.devicePixelRatio || 1);
    const [width, height] = [canvas.clientWidth, canvas.clientHeight];
    if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
      canvas.width = Math.round(width * ratio);
      canvas.height = Math.round(height * ratio);
    }
    this.context = canvas.getContext("2d");
    this.context.setTransform(ratio, 0, 0, ratio, 0, 0);
    this.context.clearRect(0, 0, width, height);
    this.context.lineCap = this.context.lineJoin = "round";
    Object.assign(this, { width, height });
  }

  /** view: a sample [see plant.h], footfall, which sensors are off, payload [kg], tick, look (colours). */
  draw(view) {
    this.prepare();
    const { sample } = view, { camera } = this, { position, rpy } = trunk(sample);
    const R = rotation(rpy), G = groundFrame(this.loop.slope);
    this.G = G;
    const below = turnedBack(G, position);
    const target = [...position];
    const away = camera.follow ? Math.hypot(...add(target, camera.follow, -1)) : Infinity;
    const lost = away > LOST * this.size, share = (slow) => 1 - Math.exp(-view.passed / slow);
    camera.follow = lost ? target : mix(camera.follow, target, share(CALM));
    camera.heading += (lost ? 1 : share(TURNS)) * (rpy[2] - camera.heading);
    const rest = turned(G, [below[0], below[1], 0.085 * this.size]);
    const focus = [camera.follow[0], camera.follow[1], rest[2]];
    const narrow = this.width < 560;
    camera.aim(focus, this.width / 2, this.height * (narrow ? 0.52 : 0.53), (narrow ? 1.45 : 1.7) * Math.min(this.height, 0.95 * this.width) / (1 + 1.6 * Math.max(0, this.far - 0.12)));
    this.floor(below, view.look);
    this.bumps(below, view.look);
    this.footprints(view);
    const legs = this.robot.chains.map((leg, k) => {
      const joints = chainOf(leg, perLeg(sample, this.n, 0, k)).map((p) => add(turned(R, p), position));
      return { k, joints, force: perLeg(sample, this.n, 5, k), depth: camera.see(joints[1])[2], mount: leg.mount };
    });
    this.shadow(legs, R, position, view);
    legs.sort((a, b) => b.depth - a.depth);
    // the trunk lies above its legs; legs that are mounted beside it are before or behind it
    const middle = camera.see(position)[2];
    const near = (leg) => Math.abs(leg.mount[1]) > this.half && leg.depth < middle;
    for (const leg of legs) if (!near(leg)) this.leg(leg, view, R, position);
    this.body(R, position, view);
    for (const leg of legs) if (near(leg)) this.leg(leg, view, R, position);
    for (const leg of legs) this.tag(leg, view);
    if (this.aim) this.pushArrow(position, view.look);
  }

  path(points) {
    this.context.beginPath();
    for (const [x, y] of points) this.context.lineTo(x, y);
    this.context.closePath();
  }

  /** A point of the ground's frame on the picture. */
  onGround(x, y, z = 0) { return this.camera.see(turned(this.G, [x, y, z])); }

  floor([x, y], look) {
    const { context: c } = this, tile = TILE * Math.round(this.size), reach = REACH * this.size, count = Math.ceil(reach / tile), colour = rgb(look.tile);
    const [i0, j0] = [Math.round(x / tile), Math.round(y / tile)];
    const rings = Array.from({ length: RINGS }, () => []); // of tiles that fade alike
    for (let i = i0 - count; i < i0 + count; i++) {
      for (let j = j0 - count; j < j0 + count; j++) {
        const away = Math.hypot((i + 0.5) * tile - x, (j + 0.5) * tile - y) / reach;
        if ((i + j) & 1 || away >= 1) continue;
        const seen = [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]].map(([u, v]) => this.onGround(u * tile, v * tile));
        if (seen.every((p) => p[2] > 0.08 * this.size)) rings[Math.floor(RINGS * away)].push(seen);
      }
    }
    rings.forEach((tiles, ring) => {
      c.beginPath();
      for (const [first, ...others] of tiles) {
        c.moveTo(first[0], first[1]);
        for (const p of others) c.lineTo(p[0], p[1]);
        c.closePath();
      }
      c.fillStyle = css(colour, Math.min(1, 1.3 * (1 - (ring + 0.5) / RINGS)));
      c.fill();
    });
  }

  bumps([x, y], look) {
    const { context: c, loop } = this, { tile } = loop.data, reach = 0.95, high = loop.bumps * loop.data.stepHeight;
    if (high <= 0) return;
    const found = [];
    for (let k = 0; k < loop.balls.length; k += 4) {
      const [bx, by, bz, radius] = loop.balls.subarray(k, k + 4);
      const u = bx + tile * Math.round((x - bx) / tile), v = by + tile * Math.round((y - by) / tile);
      const away = Math.hypot(u - x, v - y);
      if (away < reach) found.push({ u, v, bz, radius, alpha: Math.min(1, 3 * (1 - away / reach)) });
    }
    for (const { u, v, bz, radius, alpha } of found) {
      for (let layer = 0; layer < 4; layer++) {
        const z = (high * layer) / 4, wide = Math.sqrt(Math.max(0, radius ** 2 - (z - bz) ** 2));
        this.path(Array.from({ length: 14 }, (_, m) => this.onGround(u + wide * Math.cos(m * 0.4488), v + wide * Math.sin(m * 0.4488), z)));
        c.fillStyle = css(shade(rgb(look.bump), 0.86 + 0.1 * layer), alpha);
        c.fill();
      }
    }
  }

  footprints({ tick, look }) {
    const { context: c, robot } = this, last = PRINTS / this.loop.Ts;
    for (const { tick: when, leg, at } of this.prints) {
      const g = turnedBack(this.G, at), radius = 0.9 * robot.footRadius;
      this.path(Array.from({ length: 12 }, (_, m) => this.onGround(g[0] + radius * Math.cos(m * 0.5236), g[1] + radius * Math.sin(m * 0.5236))));
      c.fillStyle = css(rgb(look.colours[leg]), 0.5 * Math.max(0, 1 - (tick - when) / last));
      c.fill();
    }
  }

  shadow(legs, R, position, view) {
    const { context: c, robot, size } = this, light = turnedBack(this.G, LIGHT);
    const flat = (p) => { const g = turnedBack(this.G, p); return add(g, light, -g[2] / light[2]); };
    const corners = (faces) => faces.flatMap((face) => face.points).map((p) => [add(turned(R, p), position), 0]);
    const shapes = [shadowOf(corners(this.trunk), flat)];
    if (view.payload > 0) shapes.push(shadowOf(corners(this.payload), flat));
    for (const { joints } of legs) {
      [[0, 1, 0.016 * size, 0.016 * size], [1, 2, 0.014 * size, 0.011 * size], [2, 3, 0.011 * size, robot.footRadius]].forEach(([a, b, ra, rb]) => shapes.push(shadowOf([[joints[a], ra], [joints[b], rb]], flat)));
    }
    c.beginPath();
    for (const shape of shapes) {
      shape.forEach(([x, y], k) => { const [u, v] = this.onGround(x, y); if (k) c.lineTo(u, v); else c.moveTo(u, v); });
      c.closePath();
    }
    c.fillStyle = view.look.shadow;
    c.fill();
  }

  body(R, position, view) {
    const { context: c, camera, robot, trunk: faces } = this, shell = rgb(view.look.shell), [length, width, height] = robot.trunk.size;
    drawFaces(c, camera, faces, R, position, () => shell);
    const centre = robot.trunk.center, at = (x, y, z) => camera.see(add(turned(R, add(centre, [x * length / 2, y * width / 2, z * height / 2])), position));
    const seen = (normal, point) => dot(turned(R, normal), add(add(turned(R, add(centre, point)), position), camera.place, -1)) < 0;
    if (seen([1, 0, 0], [length / 2, 0, 0])) { // a face, so that one knows where the front is
      this.path([[1, -0.68, 0.45], [1, 0.68, 0.45], [1, 0.68, -0.5], [1, -0.68, -0.5]].map((p) => at(...p)));
      c.fillStyle = css(DARK);
      c.fill();
      for (const side of [-0.34, 0.34]) {
        const [x, y, , scale] = at(1.001, side, 0), radius = 0.0085 * this.size * scale;
        c.beginPath();
        c.ellipse(x, y, radius * Math.max(0.25, Math.abs(dot(turned(R, [1, 0, 0]), camera.ahead))), view.fallen ? 0.2 * radius : radius, 0, 0, 2 * Math.PI);
        c.fillStyle = view.look.eye;
        c.fill();
      }
    }
    if (view.payload > 0) {
      drawFaces(c, camera, this.payload, R, position, () => rgb(view.look.crate));
      this.label(camera.see(add(turned(R, add(centre, [0, 0, height / 2 + robot.payload[2] + 0.03 * this.size])), position)), `${view.payload.toFixed(2)} kg`, view.look);
    } else if (seen([0, 0, 1], [0, 0, height / 2])) { // an arrow on the top
      c.beginPath();
      for (const [x, y] of [[0.42, 0.5], [0.72, 0], [0.42, -0.5]]) { const [u, v] = at(x, y, 1.002); c.lineTo(u, v); }
      c.strokeStyle = css(shade(shell, 1.45));
      c.lineWidth = 4;
      c.stroke();
    }
  }

  leg({ k, joints, force, mount }, view, R, position) {
    const { context: c, camera, robot, size } = this, colour = rgb(view.look.colours[k]), [base, hip, knee, foot] = joints;
    if (Math.abs(mount[1]) > this.half) {
      const inner = add(turned(R, [mount[0], Math.sign(mount[1]) * 0.7 * this.half, mount[2]]), position);
      drawLimb(c, camera, inner, base, 0.013 * size, 0.013 * size, DARK);
    }
    drawLimb(c, camera, base, hip, 0.017 * size, 0.016 * size, DARK);
    drawLimb(c, camera, knee, foot, 0.0115 * size, 0.0065 * size, shade(colour, 1.18));
    drawBall(c, camera, foot, robot.footRadius, DARK);
    drawLimb(c, camera, hip, knee, 0.016 * size, 0.0125 * size, colour);
    drawBall(c, camera, hip, 0.0105 * size, DARK);
    drawBall(c, camera, knee, 0.0085 * size, DARK);
    if (view.off.has(robot.legs[k])) return;
    const load = Math.hypot(...force) / (0.5 * robot.weight);
    if (load < 0.03) return;
    const tip = add(foot, force, (size * ARROW / 0.5) / robot.weight), [x0, y0] = camera.see(foot), [x1, y1] = camera.see(tip);
    const length = Math.hypot(x1 - x0, y1 - y0), [u, v] = [(x1 - x0) / length, (y1 - y0) / length], head = Math.min(7, 0.6 * length);
    c.strokeStyle = c.fillStyle = css(rgb(view.look.ink), 0.75);
    c.lineWidth = 2;
    c.beginPath();
    c.moveTo(x0, y0);
    c.lineTo(x1 - head * u, y1 - head * v);
    c.stroke();
    this.path([[x1, y1], [x1 - head * u - 0.55 * head * v, y1 - head * v + 0.55 * head * u], [x1 - head * u + 0.55 * head * v, y1 - head * v - 0.55 * head * u]]);
    c.fill();
  }

  /** Name of a leg under its foot, and whether its sensor is off. */
  tag({ k, joints }, view) {
    const { robot } = this, name = robot.legs[k], [x, y, , size] = this.camera.see(joints[3]), off = view.off.has(name);
    this.label([x, y + robot.footRadius * size + 12], off ? `${name} ✕` : name, view.look, off ? view.look.alarm : view.look.colours[k]);
  }

  label([x, y], text, look, colour = look.ink) {
    const { context: c } = this;
    c.font = "600 12px system-ui, sans-serif";
    c.textAlign = "center";
    c.textBaseline = "middle";
    const width = c.measureText(text).width + 12;
    c.beginPath();
    c.roundRect(x - width / 2, y - 9, width, 18, 9);
    c.fillStyle = look.tag;
    c.fill();
    c.fillStyle = colour === look.alarm ? look.alarm : look.ink;
    c.fillText(text, x, y + 0.5);
    c.beginPath();
    c.roundRect(x - width / 2, y - 9, width, 18, 9);
    c.lineWidth = 1.5;
    c.strokeStyle = colour;
    c.stroke();
  }

  pushArrow(position, look) {
    const { context: c } = this, [x, y] = this.camera.see(position), [dx, dy] = this.aim, length = Math.hypot(dx, dy) || 1;
    const [u, v] = [dx / length, dy / length], head = Math.min(16, length);
    c.strokeStyle = c.fillStyle = look.alarm;
    c.lineWidth = 5;
    c.beginPath();
    c.moveTo(x, y);
    c.lineTo(x + dx - head * u, y + dy - head * v);
    c.stroke();
    this.path([[x + dx, y + dy], [x + dx - head * (u + 0.6 * v), y + dy - head * (v - 0.6 * u)], [x + dx - head * (u - 0.6 * v), y + dy - head * (v + 0.6 * u)]]);
    c.fill();
  }

  /** Direction on the ground of a way on the picture [px]. */
  groundwards([dx, dy]) {
    const { right, ahead } = this.camera, level = Math.hypot(ahead[0], ahead[1]) || 1;
    const forth = -dy / Math.max(0.3, Math.sin(this.camera.elevation));
    return [dx * right[0] + (forth * ahead[0]) / level, dx * right[1] + (forth * ahead[1]) / level];
  }
}

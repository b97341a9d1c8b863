// Vectors, rotations and the camera. World: x forward at the start, y to the left, z up.

export const add = (a, b, s = 1) => [a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]];
export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
export const unit = (a) => { const l = Math.hypot(...a) || 1; return a.map((x) => x / l); };
export const mix = (a, b, s) => a.map((x, k) => x + s * (b[k] - x));

/** Rz(yaw) Ry(pitch) Rx(roll) as rows. */
export function rotation([roll, pitch, yaw]) {
  const [cr, sr, cp, sp, cy, sy] = [Math.cos(roll), Math.sin(roll), Math.cos(pitch), Math.sin(pitch), Math.cos(yaw), Math.sin(yaw)];
  return [
    [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
    [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
    [-sp, cp * sr, cp * cr],
  ];
}
export const turned = (R, v) => [dot(R[0], v), dot(R[1], v), dot(R[2], v)];
export const turnedBack = (R, v) => [0, 1, 2].map((k) => R[0][k] * v[0] + R[1][k] * v[1] + R[2][k] * v[2]);

/** From the frame of a ground that rises along x by a slope [rad] to the world. */
export const groundFrame = (slope) => rotation([0, -slope, 0]);

/** A vector turned about a unit axis by an angle, by the formula of Rodrigues. */
export function turnedAbout(axis, angle, v) {
  const c = Math.cos(angle), s = Math.sin(angle);
  const turning = add(v.map((x) => c * x), cross(axis, v), s);
  return add(turning, axis, (1 - c) * dot(axis, v));
}

/** Points of a leg in the trunk: its joints from the trunk outward, then its foot. */
export function chainOf(leg, angles) {
  const turns = leg.links.map((link) => link.turn + link.sign * angles[link.angle]);
  // from the frame of link k to the trunk: the joints inward of it turn one after the other
  const inTrunk = (v, k) => {
    for (let j = k; j >= 0; j -= 1) v = turnedAbout(leg.links[j].axis, turns[j], v);
    return v;
  };
  const points = [];
  leg.links.forEach((link, k) => points.push(k ? add(points[k - 1], inTrunk(link.position, k - 1)) : link.position));
  points.push(add(points.at(-1), inTrunk([0, 0, -leg.tibia], leg.links.length - 1)));
  return points;
}

/** Convex hull of points of a plane, counter-clockwise. */
export function hull(points) {
  const sorted = [...points].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  const half = (list) => {
    const kept = [];
    for (const p of list) {
      while (kept.length > 1) {
        const [a, b] = kept.slice(-2);
        if ((b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]) > 0) break;
        kept.pop();
      }
      kept.push(p);
    }
    return kept.slice(0, -1);
  };
  return [...half(sorted), ...half(sorted.reverse())];
}

/** Looks at a point from a direction and a distance, which counts in sizes of what is seen; perspective. */
export class Camera {
  constructor() { Object.assign(this, { azimuth: -1.02, elevation: 0.33, distance: 0.98, size: 1, heading: 0, focus: [0, 0, 0] }); }

  turn(dx, dy) {
    this.azimuth -= 0.008 * dx;
    this.elevation = Math.min(1.5, Math.max(0.06, this.elevation + 0.008 * dy));
  }
  zoom(by) { this.distance = Math.min(3, Math.max(0.45, this.distance * by)); }

  /** Begin a picture of a size [px] whose middle is (x, y). */
  aim(focus, x, y, scale) {
    const [ca, sa, ce, se] = [Math.cos(this.azimuth + this.heading), Math.sin(this.azimuth + this.heading), Math.cos(this.elevation), Math.sin(this.elevation)];
    const back = [ce * ca, ce * sa, se];
    this.right = [-sa, ca, 0];
    this.up = [-se * ca, -se * sa, ce];
    this.ahead = back.map((v) => -v);
    this.place = add(focus, back, this.size * this.distance);
    Object.assign(this, { focus, x, y, scale });
  }

  /** Right and down [px], distance [m], and pixels per metre there. */
  see(point) {
    const d = add(point, this.place, -1), depth = dot(d, this.ahead), size = this.scale / Math.max(depth, 0.02);
    return [this.x + size * dot(d, this.right), this.y - size * dot(d, this.up), depth, size];
  }
}

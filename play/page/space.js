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

/** Points of a leg in the trunk: mount, hip, knee, foot; joint angles swing forward and lift. */
export function chainOf(leg, [abduction, hip, knee]) {
  const lean = hip - leg.femurAngle, bent = lean + knee + leg.tibiaAngle;
  const along = (angle, length) => [length * Math.sin(angle), 0, -length * Math.cos(angle)];
  const c = Math.cos(abduction), s = Math.sin(abduction);
  const points = [leg.hip];
  points.push(add(points[0], along(lean, leg.femur)));
  points.push(add(points[1], along(bent, leg.tibia)));
  return [leg.mount, ...points.map(([x, y, z]) => add(leg.mount, [x, c * y - s * z, s * y + c * z]))];
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

/** Looks at a point from a direction and a distance; perspective. */
export class Camera {
  constructor() { Object.assign(this, { azimuth: -1.02, elevation: 0.33, distance: 0.98, heading: 0, focus: [0, 0, 0] }); }

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
    this.place = add(focus, back, this.distance);
    Object.assign(this, { focus, x, y, scale });
  }

  /** Right and down [px], distance [m], and pixels per metre there. */
  see(point) {
    const d = add(point, this.place, -1), depth = dot(d, this.ahead), size = this.scale / Math.max(depth, 0.02);
    return [this.x + size * dot(d, this.right), this.y - size * dot(d, this.up), depth, size];
  }
}

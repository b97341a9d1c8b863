// Solids on a canvas: boxes with bevelled edges, limbs that taper, balls; lit from one side.

import { add, dot, hull, turned, unit } from "./space.js";

export const LIGHT = unit([0.35, -0.5, 1.0]); // towards the light, in the world

const clamp = (x) => Math.max(0, Math.min(255, Math.round(x)));
export const rgb = (hex) => [1, 3, 5].map((at) => Number.parseInt(hex.slice(at, at + 2), 16));
export const css = (colour, alpha = 1) => `rgba(${colour.map(clamp).join(",")},${alpha})`;
/** A colour lighter (above 1) or darker (below). */
export const shade = (colour, light) => colour.map((c) => (light <= 1 ? c * light : c + (255 - c) * (light - 1)));

/** A box with bevelled edges as flat faces: corners and the way each looks. */
export function bevelled([x, y, z], [cx, cy, cz], bevel) {
  const half = [x / 2, y / 2, z / 2], signs = [-1, 1], faces = [];
  const at = (s, inset) => s.map((sign, k) => [cx, cy, cz][k] + sign * (half[k] - (inset[k] ? bevel : 0)));
  const ordered = (normal, points) => {
    const middle = points.reduce((sum, p) => add(sum, p, 1 / points.length), [0, 0, 0]);
    const u = unit(add(points[0], middle, -1));
    const v = [normal[1] * u[2] - normal[2] * u[1], normal[2] * u[0] - normal[0] * u[2], normal[0] * u[1] - normal[1] * u[0]];
    const angle = (p) => { const d = add(p, middle, -1); return Math.atan2(dot(d, v), dot(d, u)); };
    faces.push({ normal, points: points.sort((a, b) => angle(a) - angle(b)) });
  };
  for (let k = 0; k < 3; k++) {
    const [i, j] = [(k + 1) % 3, (k + 2) % 3];
    for (const s of signs) {
      const normal = [0, 0, 0];
      normal[k] = s;
      ordered(normal, signs.flatMap((a) => signs.map((b) => {
        const sign = [0, 0, 0], inset = [1, 1, 1];
        [sign[k], sign[i], sign[j], inset[k]] = [s, a, b, 0];
        return at(sign, inset);
      })));
      for (const t of signs) { // the edge of the sides k and i
        const edge = [0, 0, 0];
        [edge[k], edge[i]] = [s, t];
        ordered(unit(edge), signs.flatMap((b) => [k, i].map((free) => {
          const sign = [0, 0, 0], inset = [1, 1, 1];
          [sign[k], sign[i], sign[j], inset[free]] = [s, t, b, 0];
          return at(sign, inset);
        })));
      }
    }
  }
  for (const a of signs) for (const b of signs) for (const c of signs) {
    ordered(unit([a, b, c]), [0, 1, 2].map((free) => at([a, b, c], [0, 1, 2].map((k) => (k === free ? 0 : 1)))));
  }
  return faces;
}

/** Draw the faces of a convex solid that are seen. tint: colour of a face by its number. */
export function drawFaces(context, camera, faces, R, place, tint) {
  faces.forEach((face, index) => {
    const normal = turned(R, face.normal), points = face.points.map((p) => add(turned(R, p), place));
    if (dot(normal, add(points[0], camera.place, -1)) >= 0) return;
    const light = 0.66 + 0.42 * Math.max(-0.35, dot(normal, LIGHT));
    context.beginPath();
    for (const p of points) { const [x, y] = camera.see(p); context.lineTo(x, y); }
    context.closePath();
    context.fillStyle = context.strokeStyle = css(shade(tint(index), light));
    context.lineWidth = 0.8; // covers the seam between two faces
    context.fill();
    context.stroke();
  });
}

/** A limb between two points whose radii [m] differ, as a cylinder in the light. */
export function drawLimb(context, camera, from, to, r0, r1, colour) {
  const [x0, y0, , s0] = camera.see(from), [x1, y1, , s1] = camera.see(to);
  const R0 = Math.max(1.2, r0 * s0), R1 = Math.max(1.2, r1 * s1), length = Math.hypot(x1 - x0, y1 - y0);
  const across = length > 0.5 ? [-(y1 - y0) / length, (x1 - x0) / length] : [1, 0];
  const lean = length > Math.abs(R0 - R1) ? Math.asin((R0 - R1) / length) : 0;
  const towards = Math.atan2(y1 - y0, x1 - x0), R = Math.max(R0, R1), middle = [(x0 + x1) / 2, (y0 + y1) / 2];
  // the light comes from above on the picture
  const lit = across[1] < 0 ? 1 : -1;
  const shading = context.createLinearGradient(
    middle[0] + lit * across[0] * R, middle[1] + lit * across[1] * R, middle[0] - lit * across[0] * R, middle[1] - lit * across[1] * R,
  );
  shading.addColorStop(0, css(shade(colour, 1.08)));
  shading.addColorStop(0.28, css(shade(colour, 1.3)));
  shading.addColorStop(0.62, css(shade(colour, 0.92)));
  shading.addColorStop(1, css(shade(colour, 0.62)));
  context.beginPath();
  context.arc(x0, y0, R0, towards + Math.PI / 2 - lean, towards - Math.PI / 2 + lean);
  context.arc(x1, y1, R1, towards - Math.PI / 2 + lean, towards + Math.PI / 2 - lean);
  context.closePath();
  context.fillStyle = shading;
  context.fill();
  context.lineWidth = 1;
  context.strokeStyle = css(shade(colour, 0.45), 0.55);
  context.stroke();
}

export function drawBall(context, camera, at, radius, colour) {
  const [x, y, , size] = camera.see(at), R = Math.max(1.5, radius * size);
  const shading = context.createRadialGradient(x - 0.35 * R, y - 0.4 * R, 0.1 * R, x, y, R);
  shading.addColorStop(0, css(shade(colour, 1.4)));
  shading.addColorStop(1, css(shade(colour, 0.7)));
  context.beginPath();
  context.arc(x, y, R, 0, 2 * Math.PI);
  context.fillStyle = shading;
  context.fill();
}

const ROUND = Array.from({ length: 8 }, (_, k) => [Math.cos((k * Math.PI) / 4), Math.sin((k * Math.PI) / 4)]);

/** Outline of the shadow of balls [place, radius] on a plane: hull of their circles, in the plane. */
export function shadowOf(balls, flat) {
  return hull(balls.flatMap(([at, radius]) => {
    const [x, y] = flat(at);
    return ROUND.map(([c, s]) => [x + radius * c, y + radius * s]);
  }));
}

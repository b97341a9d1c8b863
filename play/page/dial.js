// Relative phases as dots on a circle: leg 1 at the top, those ahead of it clockwise.

import { sharp } from "./strip.js";

const TRAIL = 0.8; // [s]

export function drawDial(canvas, history, part, look, stored) {
  const [c, width, height] = sharp(canvas), { legs } = history.robot;
  const x = width / 2, y = height / 2, radius = Math.min(width, height) / 2 - 20;
  const place = (phase, r = radius) => [x + r * Math.sin(phase), y - r * Math.cos(phase)];
  const phase = (tick, leg) => (leg ? history.signal(tick, "phi")[leg - 1] : 0);
  c.lineWidth = 6;
  c.strokeStyle = look.track;
  c.beginPath();
  c.arc(x, y, radius, 0, 2 * Math.PI);
  c.stroke();
  if (stored) { // where the stored gait wants the legs
    legs.forEach((_, leg) => {
      const wanted = leg ? history.last("phi_memory")[leg - 1] : 0, [u, v] = place(wanted);
      c.beginPath();
      c.arc(u, v, 14, 0, 2 * Math.PI);
      c.lineWidth = 2;
      c.setLineDash([3, 3]);
      c.strokeStyle = look.colours[leg];
      c.stroke();
      c.setLineDash([]);
    });
  }
  const last = history.count - 1, first = Math.max(history.first, last - Math.round(TRAIL / history.Ts));
  legs.forEach((name, leg) => {
    c.strokeStyle = look.colours[leg];
    c.lineWidth = 3;
    for (let tick = first; tick < last; tick += 4) {
      const [a, b] = [phase(tick, leg), phase(Math.min(last, tick + 4), leg)];
      if (Math.abs(a - b) > 2) continue;
      c.globalAlpha = (0.6 * (tick - first)) / (last - first + 1);
      c.beginPath();
      c.arc(x, y, radius, Math.min(a, b) - Math.PI / 2, Math.max(a, b) - Math.PI / 2);
      c.stroke();
    }
    c.globalAlpha = 1;
  });
  // legs at one place stand side by side: those that were named first outside
  const seen = [];
  legs.forEach((name, leg) => {
    const angle = phase(last, leg), [u0, v0] = place(angle);
    const beside = seen.filter(([u, v]) => Math.hypot(u - u0, v - v0) < 15).length;
    seen.push([u0, v0]);
    const [u, v] = place(angle, radius - 19 * beside);
    c.beginPath();
    c.arc(u, v, 10.5, 0, 2 * Math.PI);
    c.fillStyle = look.colours[leg];
    c.fill();
    c.fillStyle = "#fff";
    c.font = "700 10px system-ui, sans-serif";
    c.textAlign = "center";
    c.textBaseline = "middle";
    c.fillText(name, u, v + 0.5);
  });
}

// Bars of stance over the last seconds, a row per leg, and what happened when.

const SECONDS = 7;

/** Make a canvas as sharp as the screen; its context and size in the page's pixels. */
export function sharp(canvas) {
  const ratio = Math.min(2, window.devicePixelRatio || 1), width = canvas.clientWidth, height = canvas.clientHeight;
  if (canvas.width !== Math.round(width * ratio)) canvas.width = Math.round(width * ratio);
  if (canvas.height !== Math.round(height * ratio)) canvas.height = Math.round(height * ratio);
  const context = canvas.getContext("2d");
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, width, height);
  return [context, width, height];
}

export function drawStrip(canvas, history, part, look, off) {
  const [c, width, height] = sharp(canvas), { legs } = history.robot, left = 34, top = 16;
  const seconds = width < 560 ? 0.6 * SECONDS : SECONDS, pitch = (height - top - 2) / legs.length, bar = Math.min(18, 0.68 * pitch);
  const now = history.count - 1 + part, perTick = (width - left) / (seconds / history.Ts);
  const at = (tick) => width - (now - tick) * perTick;
  const first = Math.max(history.first, Math.floor(now - seconds / history.Ts));
  c.textBaseline = "middle";
  legs.forEach((name, leg) => {
    const y = top + (leg + 0.5) * pitch;
    c.fillStyle = look.track;
    c.beginPath();
    c.roundRect(left, y - bar / 2, width - left, bar, 4);
    c.fill();
    c.font = "600 12px system-ui, sans-serif";
    c.textAlign = "left";
    c.fillStyle = off.has(name) ? look.alarm : look.ink;
    c.fillText(off.has(name) ? `${name}✕` : name, 2, y);
    c.fillStyle = look.colours[leg];
    c.beginPath();
    for (let tick = first; tick < history.count; tick++) {
      if (!history.stands(tick, leg)) continue;
      const begin = tick;
      while (tick + 1 < history.count && history.stands(tick + 1, leg)) tick++;
      const x0 = Math.max(left, at(begin)), x1 = Math.min(width, at(tick + 1));
      if (x1 > x0) c.roundRect(x0, y - bar / 2, x1 - x0, bar, 3);
    }
    c.fill();
  });
  c.font = "600 11px system-ui, sans-serif";
  let free = Infinity; // the newest is told where there is no room for all
  for (const { tick, text } of [...history.events].reverse()) {
    const x = at(tick);
    if (x < left) continue;
    c.strokeStyle = look.ink;
    c.lineWidth = 1.5;
    c.beginPath();
    c.moveTo(x, 2);
    c.lineTo(x, height);
    c.stroke();
    const room = c.measureText(text).width;
    c.textAlign = x + room + 8 > width ? "right" : "left";
    const begin = c.textAlign === "left" ? x : x - room - 8;
    if (begin + room + 10 > free) continue;
    free = begin;
    c.fillStyle = look.ink;
    c.fillText(text, x + (c.textAlign === "left" ? 5 : -5), 8);
  }
}

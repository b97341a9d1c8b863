"use strict";
// What surrounds the scene: the gait strip, the pose in words, and the mouse that turns the view.

// Which feet stand between two times, with a mark at t.
apnc.drawStrip = (canvas, scene, t, begin, end) => {
  const left = 34, n = scene.n, time = scene.time, last = scene.count - 1, [c, width, height] = scene.prepare(canvas);
  const row = (height - 18) / n, x = (s) => Math.max(left, left + ((s - begin) / (end - begin)) * (width - left));
  const [swing, stance] = ["--swing", "--stance"].map(apnc.colour);
  const from = scene.sampleAt(begin), to = scene.sampleAt(end);
  c.font = "600 12px system-ui, sans-serif"; c.textBaseline = "middle"; c.textAlign = "left";
  for (let leg = 0; leg < n; leg++) {
    const bar = (style, a, b) => { c.fillStyle = style; c.fillRect(a, leg * row + 2, b - a, row - 4); };
    bar(swing, left, width);
    for (let i = from; i < to; i++) if (scene.stance[i * n + leg]) bar(stance, x(time[i]), x(time[i + 1]) + 1);
    c.fillStyle = scene.colours[leg]; c.fillText(scene.legs[leg], 4, (leg + 0.5) * row);
  }
  c.font = "11px system-ui, sans-serif"; c.fillStyle = apnc.colour("--soft"); c.textAlign = "center";
  for (let s = Math.ceil(Math.max(begin, time[0])); s <= Math.min(end, time[last]); s++) {
    if (x(s) > left + 10 && x(s) < width - 12) c.fillText(s + " s", x(s), height - 7);
  }
  c.fillStyle = "#d55e00"; c.fillRect(x(t) - 1, 0, 2, height - 16);
};

apnc.pose = (scene, i, t) => {
  const [x, y] = scene.vector(scene.position, i), degrees = scene.vector(scene.rpy, i).map((v) => ((v * 180) / Math.PI).toFixed(1));
  return `t ${t.toFixed(2)} s   x ${x.toFixed(2)} m   y ${y.toFixed(2)} m   roll ${degrees[0]}°   pitch ${degrees[1]}°   yaw ${degrees[2]}°`;
};

apnc.drag = (element, start, move) => {
  element.addEventListener("pointerdown", (event) => { element.setPointerCapture(event.pointerId); start(event); });
  element.addEventListener("pointermove", (event) => { if (element.hasPointerCapture(event.pointerId)) move(event); });
};

// The buttons of the views, zoom, and orbit by dragging; `show` draws again, `now` is the sample shown.
apnc.lookAround = (scene, show, now, taken = () => false) => {
  const by = (id) => document.getElementById(id), buttons = document.querySelectorAll("#views button");
  const mark = (chosen) => buttons.forEach((button) => button.classList.toggle("on", button === chosen));
  const zoom = (factor) => { scene.zoom = Math.min(4, Math.max(0.3, scene.zoom * factor)); show(); };
  by("in").addEventListener("click", () => zoom(1.25));
  by("out").addEventListener("click", () => zoom(0.8));
  for (const button of buttons) {
    button.addEventListener("click", () => { scene.view(button.dataset.view, scene.rpy[3 * now() + 2]); mark(button); show(); });
  }
  apnc.drag(by("robot"), (event) => { if (!taken(event)) mark(null); }, (event) => {
    if (taken(event)) return;
    scene.azimuth -= event.movementX * 0.008;
    scene.elevation = Math.min(Math.PI / 2, Math.max(0, scene.elevation + event.movementY * 0.008));
    show();
  });
};

"use strict";
// Plays the walk: clock, controls, gait strip, and the cursor in the plots.
{
  const source = apnc.data.animation, time = apnc.time, last = source.count - 1;
  const $ = (id) => document.getElementById(id);
  const scene = new apnc.Scene($("robot"), source);
  let now = time[source.opensAt], playing = false, before = null;
  $("scrub").max = last;

  const sampleAt = (t) => {
    let low = 0, high = last;
    while (low < high) { const middle = (low + high + 1) >> 1; if (time[middle] <= t + 1e-6) low = middle; else high = middle - 1; }
    return low;
  };

  const drawStrip = (t) => {
    const left = 34, span = 3, n = scene.n, [c, width, height] = scene.prepare($("strip"));
    const row = (height - 18) / n, x = (s) => Math.max(left, left + ((s - t + span) / (2 * span)) * (width - left));
    const [swing, stance] = ["--swing", "--stance"].map(apnc.colour);
    const from = sampleAt(t - span), to = sampleAt(t + span);
    c.font = "600 12px system-ui, sans-serif"; c.textBaseline = "middle"; c.textAlign = "left";
    for (let leg = 0; leg < n; leg++) {
      const bar = (style, a, b) => { c.fillStyle = style; c.fillRect(a, leg * row + 2, b - a, row - 4); };
      bar(swing, left, width);
      for (let i = from; i < to; i++) if (scene.stance[i * n + leg]) bar(stance, x(time[i]), x(time[i + 1]) + 1);
      c.fillStyle = scene.colours[leg]; c.fillText(scene.legs[leg], 4, (leg + 0.5) * row);
    }
    c.font = "11px system-ui, sans-serif"; c.fillStyle = apnc.colour("--soft"); c.textAlign = "center";
    for (let s = Math.ceil(Math.max(t - span, time[0])); s <= Math.min(t + span, time[last]); s++) {
      if (x(s) > left + 10 && x(s) < width - 12) c.fillText(s + " s", x(s), height - 7);
    }
    c.fillStyle = "#d55e00"; c.fillRect(x(t) - 1, 0, 2, height - 16);
  };

  const show = () => {
    const i = sampleAt(now), [x, y] = scene.vector(scene.position, i);
    scene.draw(i);
    drawStrip(now);
    apnc.moveCursor(now);
    $("scrub").value = i;
    $("clock").textContent = `${now.toFixed(2)} / ${time[last].toFixed(1)} s`;
    const degrees = scene.vector(scene.rpy, i).map((v) => ((v * 180) / Math.PI).toFixed(1));
    $("hud").textContent = `t ${now.toFixed(2)} s   x ${x.toFixed(2)} m   y ${y.toFixed(2)} m   roll ${degrees[0]}°   pitch ${degrees[1]}°   yaw ${degrees[2]}°`;
  };
  const frame = (stamp) => {
    if (!playing) return;
    if (before !== null) now += ((stamp - before) / 1000) * Number($("rate").value);
    before = stamp;
    if (now >= time[last]) now = apnc.window[0];
    show();
    requestAnimationFrame(frame);
  };
  const setPlaying = (on) => {
    if (on && !playing) requestAnimationFrame(frame);
    playing = on; before = null;
    $("play").textContent = on ? "Pause" : "Play";
  };
  const jump = (t) => { now = Math.min(Math.max(t, time[0]), time[last]); before = null; show(); };
  apnc.seekListeners.push(jump);

  const mark = (chosen) => document.querySelectorAll("#views button").forEach((b) => b.classList.toggle("on", b === chosen));
  const zoom = (factor) => { scene.zoom = Math.min(4, Math.max(0.3, scene.zoom * factor)); show(); };
  $("play").addEventListener("click", () => setPlaying(!playing));
  $("scrub").addEventListener("input", (event) => jump(time[Number(event.target.value)]));
  $("in").addEventListener("click", () => zoom(1.25));
  $("out").addEventListener("click", () => zoom(0.8));
  for (const button of document.querySelectorAll("#views button")) {
    button.addEventListener("click", () => { scene.view(button.dataset.view, scene.rpy[3 * sampleAt(now) + 2]); mark(button); show(); });
  }
  const drag = (element, start, move) => {
    element.addEventListener("pointerdown", (event) => { element.setPointerCapture(event.pointerId); start(); });
    element.addEventListener("pointermove", (event) => { if (element.hasPointerCapture(event.pointerId)) move(event); });
  };
  drag($("robot"), () => mark(null), (event) => {
    scene.azimuth -= event.movementX * 0.008;
    scene.elevation = Math.min(Math.PI / 2, Math.max(0, scene.elevation + event.movementY * 0.008));
    show();
  });
  drag($("strip"), () => setPlaying(false), (event) => jump(now - (event.movementX / ($("strip").clientWidth - 34)) * 6));
  document.addEventListener("keydown", (event) => {
    const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (event.target.closest("button, select, input, a, summary") || event.ctrlKey || event.metaKey || event.altKey || !(step || event.key === " ")) return;
    setPlaying(step ? false : !playing);
    if (step) jump(time[Math.min(last, Math.max(0, sampleAt(now) + step))]);
    event.preventDefault();
  });
  apnc.redraws.push(show);
  new ResizeObserver(show).observe($("robot"));

  apnc.player = { play: () => setPlaying(true), pause: () => setPlaying(false), seek: jump };
  show();
  setPlaying(!window.matchMedia("(prefers-reduced-motion: reduce)").matches);
}

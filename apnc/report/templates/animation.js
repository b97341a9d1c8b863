"use strict";
// Plays the walk: clock, controls, gait strip, and the cursor in the plots.
{
  const source = apnc.data.animation, time = apnc.time, last = source.count - 1;
  const $ = (id) => document.getElementById(id);
  const scene = new apnc.Scene($("robot"), source);
  const still = window.matchMedia("(prefers-reduced-motion: reduce)").matches;
  let now = time[source.opensAt || 0], playing = false, before = null;
  $("scrub").max = last;

  const sampleAt = (t) => {
    let low = 0, high = last;
    while (low < high) { const middle = (low + high + 1) >> 1; if (time[middle] <= t + 1e-6) low = middle; else high = middle - 1; }
    return low;
  };

  const drawStrip = (t) => {
    const canvas = $("strip"), c = canvas.getContext("2d"), ratio = window.devicePixelRatio || 1;
    const width = canvas.clientWidth, height = canvas.clientHeight, left = 34, span = 3, n = scene.n;
    canvas.width = Math.round(width * ratio); canvas.height = Math.round(height * ratio);
    c.setTransform(ratio, 0, 0, ratio, 0, 0);
    const row = (height - 18) / n, x = (s) => left + ((s - t + span) / (2 * span)) * (width - left);
    const from = sampleAt(t - span), to = sampleAt(t + span);
    c.font = "600 12px system-ui, sans-serif"; c.textBaseline = "middle"; c.textAlign = "left";
    for (let leg = 0; leg < n; leg++) {
      const y = leg * row;
      c.fillStyle = "#f1f3f6"; c.fillRect(left, y + 2, width - left, row - 4);
      c.fillStyle = "#111418";
      let begin = -1;
      for (let i = from; i <= to; i++) {
        const on = scene.stance[i * n + leg];
        if (on && begin < 0) begin = i;
        if (begin >= 0 && (!on || i === to)) {
          c.fillRect(Math.max(left, x(time[begin])), y + 2, x(time[i]) - Math.max(left, x(time[begin])), row - 4);
          begin = -1;
        }
      }
      c.fillStyle = scene.colours[leg]; c.fillText(scene.legs[leg], 4, y + row / 2);
    }
    c.font = "11px system-ui, sans-serif"; c.fillStyle = "#5b6673"; c.textAlign = "center";
    for (let s = Math.ceil(t - span); s <= t + span; s++) {
      if (s < time[0] - 1e-6 || s > time[last] + 1e-6 || x(s) < left + 10 || x(s) > width - 12) continue;
      c.fillText(s + " s", x(s), height - 7);
    }
    c.fillStyle = "#d55e00"; c.fillRect(x(t) - 1, 0, 2, height - 16);
  };

  const show = () => {
    const i = sampleAt(now);
    scene.draw(i);
    drawStrip(now);
    apnc.moveCursor(now);
    $("scrub").value = i;
    $("clock").textContent = `${now.toFixed(2)} / ${time[last].toFixed(1)} s`;
    const [x, y] = scene.vector(scene.position, i);
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
    if (on === playing) return;
    playing = on; before = null;
    $("play").textContent = on ? "Pause" : "Play";
    if (on) requestAnimationFrame(frame);
  };
  const jump = (t) => { now = Math.min(Math.max(t, time[0]), time[last]); before = null; show(); };
  apnc.seekListeners.push(jump);

  $("play").addEventListener("click", () => setPlaying(!playing));
  $("scrub").addEventListener("input", (event) => jump(time[Number(event.target.value)]));
  const zoom = (factor) => { scene.zoom = Math.min(4, Math.max(0.3, scene.zoom * factor)); show(); };
  $("in").addEventListener("click", () => zoom(1.25));
  $("out").addEventListener("click", () => zoom(0.8));
  for (const button of document.querySelectorAll("#views button")) {
    button.addEventListener("click", () => {
      scene.view(button.dataset.view, scene.rpy[3 * sampleAt(now) + 2]);
      document.querySelectorAll("#views button").forEach((b) => b.classList.toggle("on", b === button));
      show();
    });
  }

  const drag = (element, move) => {
    element.addEventListener("pointerdown", (event) => { element.setPointerCapture(event.pointerId); move(event, true); });
    element.addEventListener("pointermove", (event) => { if (element.hasPointerCapture(event.pointerId)) move(event, false); });
  };
  drag($("robot"), (event, first) => {
    if (first) return;
    scene.azimuth -= event.movementX * 0.008;
    scene.elevation = Math.min(Math.PI / 2, Math.max(0, scene.elevation + event.movementY * 0.008));
    document.querySelectorAll("#views button").forEach((b) => b.classList.remove("on"));
    show();
  });
  drag($("strip"), (event, first) => {
    if (first) setPlaying(false);
    else jump(now - (event.movementX / ($("strip").clientWidth - 34)) * 6);
  });
  document.addEventListener("keydown", (event) => {
    if (event.target.closest("button, select, input, a") || event.ctrlKey || event.metaKey || event.altKey) return;
    const steps = { ArrowLeft: -1, ArrowRight: 1 };
    if (event.key === " ") setPlaying(!playing);
    else if (event.key in steps) { setPlaying(false); jump(time[Math.min(last, Math.max(0, sampleAt(now) + steps[event.key]))]); }
    else return;
    event.preventDefault();
  });
  new ResizeObserver(show).observe($("robot"));

  apnc.player = { play: () => setPlaying(true), pause: () => setPlaying(false), seek: jump };
  show();
  $("play").textContent = "Play";
  if (!still) setPlaying(true);
}

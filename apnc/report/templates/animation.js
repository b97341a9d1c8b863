"use strict";
// Plays the walk: clock, controls, gait strip, and the cursor in the plots.
{
  const source = apnc.data.animation, time = apnc.time, last = source.count - 1;
  const $ = (id) => document.getElementById(id);
  const scene = new apnc.Scene($("robot"), source);
  let now = time[source.opensAt], playing = false, before = null;
  $("scrub").max = last;

  const sampleAt = (t) => scene.sampleAt(t);

  const show = () => {
    const i = sampleAt(now);
    scene.draw(i);
    apnc.drawStrip($("strip"), scene, now, now - 3, now + 3);
    apnc.moveCursor(now);
    $("scrub").value = i;
    $("clock").textContent = `${now.toFixed(2)} / ${time[last].toFixed(1)} s`;
    $("hud").textContent = apnc.pose(scene, i, now);
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

  apnc.lookAround(scene, show, () => sampleAt(now));
  $("play").addEventListener("click", () => setPlaying(!playing));
  $("scrub").addEventListener("input", (event) => jump(time[Number(event.target.value)]));
  apnc.drag($("strip"), () => setPlaying(false), (event) => jump(now - (event.movementX / ($("strip").clientWidth - 34)) * 6));
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

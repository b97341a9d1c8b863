"use strict";
// The live page: it takes samples from the walk, draws the newest, and sends what is asked for.
{
  const $ = (id) => document.getElementById(id), data = apnc.data;
  const scene = new apnc.LiveScene($("robot"), data.animation);
  const SHOVE = 0.45, FARTHEST = 0.9; // [m/s] of the button, and of the longest push with the mouse
  const SPAN = 6; // [s] of the gait strip
  let socket = null, paused = false, over = "", aim = null, arrow = null, dirty = true;

  const last = () => scene.count - 1;
  const send = (wish) => { if (socket && socket.readyState === WebSocket.OPEN) socket.send(JSON.stringify(wish)); };
  const say = (text) => { $("message").hidden = !text; $("message").textContent = text; };
  const state = (text, late = false) => { $("state").textContent = text; $("state").classList.toggle("late", late); };

  const show = () => { dirty = true; };
  const draw = () => {
    requestAnimationFrame(draw);
    if (!dirty || scene.count === 0) return;
    dirty = false;
    const i = last(), t = scene.time[i];
    scene.draw(i);
    if (aim) drawAim(i);
    if (arrow && t - arrow.t < 0.4) drawPush(i, arrow);
    apnc.drawStrip($("strip"), scene, t, t - SPAN, t);
    $("hud").textContent = apnc.pose(scene, i, t);
    $("clock").textContent = `${t.toFixed(2)} / ${data.duration.toFixed(1)} s`;
  };

  const line = (from, to, colour) => {
    scene.trace([from, to], colour, 4);
    const length = Math.hypot(to[0] - from[0], to[1] - from[1]) || 1, [ux, uy] = [(to[0] - from[0]) / length, (to[1] - from[1]) / length];
    scene.trace([[to[0] + 6 * ux, to[1] + 6 * uy], [to[0] - 9 * ux - 7 * uy, to[1] - 9 * uy + 7 * ux], [to[0] - 9 * ux + 7 * uy, to[1] - 9 * uy - 7 * ux]], null, 0, colour);
  };
  const drawAim = (i) => {
    const [x, y] = scene.project(scene.vector(scene.position, i));
    line([x, y], [x + aim[0], y + aim[1]], "#d55e00");
  };
  // 0.1 m for a change of the velocity by 0.1 m/s.
  const drawPush = (i, { x, y }) => {
    const at = scene.vector(scene.position, i), reach = 1 / data.mass;
    const [from, to] = [[at[0] - x * reach, at[1] - y * reach, at[2]], at].map((p) => scene.project(p));
    line(from, to, "#d55e00");
  };

  const speedOf = ([x, y]) => Math.min(FARTHEST, 0.004 * Math.hypot(x, y));
  const pushAlong = ([x, y], speed) => {
    const length = Math.hypot(x, y);
    if (length > 0) send({ push: [(x / length) * speed * data.mass, (y / length) * speed * data.mass] });
  };
  const shove = () => {
    const yaw = scene.count ? scene.rpy[3 * last() + 2] : 0, side = Math.random() < 0.5 ? 1 : -1;
    pushAlong([-side * Math.sin(yaw), side * Math.cos(yaw)], SHOVE);
  };
  const place = (event) => [event.offsetX, event.offsetY];
  let begun = null;
  $("robot").addEventListener("pointerdown", (event) => { begun = event.shiftKey ? place(event) : null; });
  const taken = () => begun !== null;
  apnc.lookAround(scene, show, last, taken);
  $("robot").addEventListener("pointermove", (event) => {
    if (!begun || !$("robot").hasPointerCapture(event.pointerId)) return;
    const [x, y] = place(event);
    aim = [x - begun[0], y - begun[1]];
    show();
  });
  const release = (event) => {
    if (begun && aim && event.type === "pointerup" && Math.hypot(...aim) > 5) pushAlong(scene.groundwards(aim), speedOf(aim));
    begun = aim = null;
    show();
  };
  for (const name of ("pointerup pointercancel").split(" ")) $("robot").addEventListener(name, release);

  const pause = (on) => { send({ pause: on }); };
  $("push").addEventListener("click", shove);
  $("play").addEventListener("click", () => pause(!paused));
  $("rate").addEventListener("change", () => send({ speed: $("rate").value === "" ? null : Number($("rate").value) }));
  document.addEventListener("keydown", (event) => {
    if (event.key !== " " || event.target.closest("button, select, input, a")) return;
    pause(!paused);
    event.preventDefault();
  });

  const choose = (speed) => {
    const value = speed === null ? "" : String(speed);
    if (![...$("rate").options].some((option) => option.value === value)) $("rate").add(new Option(`${value} ×`, value));
    if (document.activeElement !== $("rate")) $("rate").value = value;
  };
  const told = {
    ground: (lines) => { for (const [name, signal] of Object.entries(lines)) scene[name] = apnc.array(signal); },
    status: ({ speed, wanted, behind, paused: still, pushes }) => {
      paused = still;
      $("play").textContent = paused ? "Go on" : "Pause";
      choose(wanted);
      const late = wanted !== null && behind > 0.5;
      const now = speed === null ? "" : `${speed.toFixed(2)} × real time`;
      state(paused ? "paused" : late ? `${now}, ${behind.toFixed(1)} s behind` : now || "walking", late && !paused);
      if (pushes) $("pushed").title = `${pushes} in all`;
    },
    pushed: ([t, x, y]) => {
      arrow = { t, x, y };
      $("pushed").textContent = `pushed ${Math.hypot(x, y).toFixed(2)} N s at ${t.toFixed(1)} s`;
    },
    over: (words) => {
      over = words;
      state("over");
      say(`The walk is over: ${words}`);
      for (const id of ["play", "push", "rate"]) $(id).disabled = true;
    },
  };
  const take = (event) => {
    if (typeof event.data === "string") {
      for (const [name, content] of Object.entries(JSON.parse(event.data))) told[name](content);
    } else {
      const numbers = new Float64Array(event.data), width = scene.rowWidth;
      for (let at = 0; at < numbers.length; at += width) scene.append(numbers.subarray(at, at + width));
    }
    show();
  };
  const TAKEN = 4409;
  const connect = () => {
    socket = new WebSocket(data.socket);
    socket.binaryType = "arraybuffer";
    socket.addEventListener("open", () => say(""));
    socket.addEventListener("message", take);
    socket.addEventListener("close", (event) => {
      if (over) return;
      state("not connected", true);
      say(event.code === TAKEN ? "The walk is shown in another page. Close that one." : "The walk does not answer. It has ended, or its terminal is closed.");
      setTimeout(connect, 1000);
    });
  };
  apnc.redraws.push(show);
  new ResizeObserver(show).observe($("robot"));
  apnc.live = { scene, send, shove, pushAlong, paused: () => paused };
  choose(data.speed);
  connect();
  draw();
}

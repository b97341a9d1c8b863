"use strict";
// What the other scripts share: data, arrays, times and colours of the page.
const apnc = { data: JSON.parse(document.getElementById("data").textContent), seekListeners: [], redraws: [] };

apnc.unpack = (text, Type) => new Type(Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer);
// A signal: 32-bit floats, or 16-bit steps above the least value, with 65535 for a gap.
apnc.array = ({ f4, u2, least, step }) => (f4 === undefined
  ? Float32Array.from(apnc.unpack(u2, Uint16Array), (k) => (k === 65535 ? NaN : least + step * k))
  : apnc.unpack(f4, Float32Array));
apnc.time = apnc.data.time ? apnc.array(apnc.data.time) : new Float32Array();
apnc.begin = apnc.time[0] || 0;
apnc.end = apnc.time[apnc.time.length - 1] || 1;
// What the page opens on: all of a short run, the end of a long one.
apnc.window = [apnc.data.opensAt ?? apnc.begin, apnc.end];
apnc.now = apnc.window[0];
apnc.moveCursor = (t = apnc.now) => { apnc.now = t; };

// A dark page is printed light.
{
  const root = document.documentElement, preferred = window.matchMedia("(prefers-color-scheme: dark)");
  apnc.dark = () => preferred.matches && !root.classList.contains("light");
  apnc.colour = (name) => getComputedStyle(root).getPropertyValue(name);
  const redraw = () => apnc.redraws.forEach((f) => f());
  const opened = [];
  const light = (on) => {
    root.classList.toggle("light", on); root.classList.toggle("printed", on);
    if (on) opened.push(...document.querySelectorAll("details.card:not([open])"));
    for (const folded of on ? opened : opened.splice(0)) folded.open = on;
    redraw();
  };
  preferred.addEventListener("change", redraw);
  window.addEventListener("beforeprint", () => light(true));
  window.addEventListener("afterprint", () => light(false));
}

"use strict";
// Draws the figures; keeps those over time together and shows the current time in each.
const apnc = { data: JSON.parse(document.getElementById("data").textContent), seekListeners: [] };

apnc.unpack = (text, Type) => new Type(Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer);
apnc.time = apnc.unpack(apnc.data.time || "", Float32Array);
apnc.begin = apnc.time[0] || 0;
apnc.end = apnc.time[apnc.time.length - 1] || 1;
// What the page opens on: all of a short run, the end of a long one.
apnc.window = [apnc.data.opensAt ?? apnc.begin, apnc.end];

apnc.plots = apnc.data.figures.map(({ key, data, layout, overTime }) => {
  const element = document.getElementById("plot-" + key);
  if (overTime) {
    for (const trace of data) if (!trace.x) trace.x = apnc.time;
    layout.xaxis.range = [...apnc.window];
  }
  const config = { responsive: true, displaylogo: false, displayModeBar: "hover", modeBarButtonsToRemove: ["select2d", "lasso2d"] };
  Plotly.newPlot(element, data, layout, config);
  return { element, overTime };
});

{
  const linked = apnc.plots.filter((p) => p.overTime);
  const buttons = [...document.querySelectorAll("#windows button")];
  const mark = (name) => buttons.forEach((b) => b.classList.toggle("on", b.dataset.window === name));
  let busy = false;
  const setRange = (range, source) => {
    if (busy) return;
    busy = true;
    const others = linked.filter((p) => p.element !== source);
    const change = { "xaxis.range": [...range] };
    Promise.all(others.map((p) => Plotly.relayout(p.element, change))).finally(() => { busy = false; apnc.moveCursor(); });
  };
  for (const plot of linked) {
    plot.cursor = document.createElement("div");
    plot.cursor.className = "cursor";
    plot.element.parentElement.append(plot.cursor);
    plot.element.on("plotly_relayout", (event) => {
      if ("xaxis.autorange" in event) { setRange([apnc.begin, apnc.end], null); mark("all"); }
      else if ("xaxis.range[0]" in event) { setRange([event["xaxis.range[0]"], event["xaxis.range[1]"]], plot.element); mark(null); }
    });
    plot.element.addEventListener("click", (event) => {
      const { xaxis, _size: size } = plot.element._fullLayout;
      const box = plot.element.getBoundingClientRect();
      const x = event.clientX - box.left - size.l;
      if (x >= 0 && x <= size.w && event.clientY - box.top > size.t) apnc.seekListeners.forEach((f) => f(xaxis.p2d(x)));
    });
  }

  const ranges = {
    all: () => [apnc.begin, apnc.end],
    first: () => [apnc.begin, Math.min(apnc.end, apnc.begin + 10)],
    last: () => [Math.max(apnc.begin, apnc.end - 10), apnc.end],
    around: () => [apnc.now - 2.5, apnc.now + 2.5],
  };
  for (const button of buttons) {
    button.addEventListener("click", () => { setRange(ranges[button.dataset.window](), null); mark(button.dataset.window); });
  }
  mark(apnc.data.opensAt ? "last" : "all");

  apnc.now = apnc.window[0];
  // A styled element instead of a plotly shape: moving a shape redraws the whole plot.
  apnc.moveCursor = (t = apnc.now) => {
    apnc.now = t;
    for (const { element, cursor } of linked) {
      const { xaxis, _size: size } = element._fullLayout;
      const x = xaxis.d2p(t);
      const shown = x >= 0 && x <= size.w;
      cursor.style.display = shown ? "block" : "none";
      if (!shown) continue;
      cursor.style.transform = `translateX(${size.l + x}px)`;
      cursor.style.top = size.t + "px";
      cursor.style.height = size.h + "px";
    }
  };
}

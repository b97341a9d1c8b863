"use strict";
// Draws each figure when it is scrolled to, or printed; keeps those over time together and shows the
// current time in each.
{
  const PRINTED_PX = 680; // width of a sheet of paper
  const config = { responsive: true, displaylogo: false, displayModeBar: "hover", modeBarButtonsToRemove: ["select2d", "lasso2d"] };
  let range = [...apnc.window], busy = false;

  // Data and layout of a figure in the colours of the page, with its arrays unpacked.
  const made = ({ data, layout, overTime }) => {
    const dark = apnc.dark() ? apnc.data.dark : {};
    const copy = JSON.parse(JSON.stringify({ data, layout }), (_, value) => {
      if (typeof value === "string") return dark[value] ?? value;
      return value && (value.f4 ?? value.u2) !== undefined ? apnc.array(value) : value;
    });
    if (overTime) {
      for (const trace of copy.data) if (!trace.x) trace.x = apnc.time;
      copy.layout.xaxis.range = [...range];
    }
    return copy;
  };
  const place = ({ element, cursor }) => {
    const { xaxis, _size: size } = element._fullLayout;
    const x = xaxis.d2p(apnc.now);
    const shown = x >= 0 && x <= size.w;
    cursor.style.display = shown ? "block" : "none";
    if (!shown) return;
    cursor.style.transform = `translateX(${size.l + x}px)`;
    cursor.style.top = size.t + "px";
    cursor.style.height = size.h + "px";
  };

  apnc.plots = apnc.data.figures.map((figure) => ({ ...figure, element: document.getElementById("plot-" + figure.key), drawn: null }));
  const linked = () => apnc.plots.filter((p) => p.overTime && p.drawn);
  apnc.moveCursor = (t = apnc.now) => { apnc.now = t; linked().forEach(place); };

  const buttons = [...document.querySelectorAll("#windows button")];
  const mark = (name) => buttons.forEach((b) => b.classList.toggle("on", b.dataset.window === name));
  const setRange = (wanted, source) => {
    if (busy) return;
    busy = true;
    range = [...wanted];
    const others = linked().filter((p) => p.element !== source);
    Promise.all(others.map((p) => Plotly.relayout(p.element, { "xaxis.range": [...range] }))).finally(() => { busy = false; apnc.moveCursor(); });
  };

  const follow = (plot) => {
    plot.element.on("plotly_relayout", (event) => {
      if ("xaxis.autorange" in event) { setRange([apnc.begin, apnc.end], null); mark("all"); }
      else if ("xaxis.range[0]" in event) { setRange([event["xaxis.range[0]"], event["xaxis.range[1]"]], plot.element); mark(null); }
    });
    plot.element.on("plotly_afterplot", () => place(plot));
    place(plot);
  };
  for (const plot of apnc.plots.filter((p) => p.overTime)) {
    plot.cursor = document.createElement("div");
    plot.cursor.className = "cursor";
    plot.element.parentElement.append(plot.cursor);
    plot.element.addEventListener("click", (event) => {
      if (!plot.drawn) return;
      const { xaxis, _size: size } = plot.element._fullLayout;
      const box = plot.element.getBoundingClientRect();
      const x = event.clientX - box.left - size.l;
      if (x >= 0 && x <= size.w && event.clientY - box.top > size.t) apnc.seekListeners.forEach((f) => f(xaxis.p2d(x)));
    });
  }
  // What a plot was drawn as; another look is drawn anew.
  const look = () => `${apnc.dark()} ${document.documentElement.classList.contains("printed")}`;
  const draw = (plot) => {
    if (!window.Plotly) { apnc.plotly.then(() => draw(plot), () => {}); return; }
    if (plot.drawn === look()) return;
    const { data, layout } = made(plot);
    if (document.documentElement.classList.contains("printed")) layout.width = PRINTED_PX;
    if (plot.drawn) Plotly.purge(plot.element); // else it keeps the width of the paper
    plot.drawn = look();
    Plotly.newPlot(plot.element, data, layout, config);
    if (plot.overTime) follow(plot);
  };
  apnc.drawAll = () => apnc.plots.forEach(draw);
  apnc.redraws.push(() => {
    if (document.documentElement.classList.contains("printed")) apnc.drawAll();
    else apnc.plots.filter((p) => p.drawn).forEach(draw);
  });

  const near = new IntersectionObserver((entries) => {
    for (const { isIntersecting, target } of entries) {
      if (!isIntersecting) continue;
      near.unobserve(target);
      draw(apnc.plots.find((p) => p.element === target));
    }
  }, { rootMargin: "200px" });
  apnc.plots.forEach((p) => near.observe(p.element));

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
}

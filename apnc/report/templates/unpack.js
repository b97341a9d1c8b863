"use strict";
// Unpacks plotly.js and runs it. apnc.plotly is fulfilled once it has run.
apnc.plotly = (async () => {
  const packed = new Blob([apnc.unpack(apnc.data.plotly, Uint8Array)]);
  const script = document.createElement("script");
  script.textContent = await new Response(packed.stream().pipeThrough(new DecompressionStream("deflate"))).text();
  document.head.append(script);
})();
apnc.plotly.catch(reportError);

// Starts the engine of a page before its charts are read: it is compiled, and computes the case of
// the page, at the same time. What it says is kept until the page listens.
"use strict";

const railcrackStarted = (() => {
  const data = /** @type {WhatIfData} */ (
    JSON.parse(document.getElementById("what-if-data")?.textContent ?? "")
  );
  const url = URL.createObjectURL(new Blob([data.worker], { type: "text/javascript" }));
  const worker = new Worker(url);
  URL.revokeObjectURL(url);
  /** @type {any[]} */
  const said = [];
  worker.onmessage = ({ data: message }) => said.push(message);
  worker.postMessage({ packed: data.module });
  worker.postMessage({ id: 1, text: data.case });
  return { data, worker, said };
})();

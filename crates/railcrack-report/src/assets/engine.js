// The engine: railcrack compiled to WebAssembly, for a worker of the page, and for tests.
"use strict";

/**
 * The engine of an instance of the module. `begin` takes the text of a case; then `step` computes one
 * growth step after another. `draw` takes a chart and gives its figure.
 * @param {WebAssembly.Instance} instance
 */
function openEngine(instance) {
  const exports = /** @type {EngineExports} */ (/** @type {unknown} */ (instance.exports));
  const [encoder, decoder] = [new TextEncoder(), new TextDecoder()];
  /** @param {"begin" | "step" | "summary" | "decide" | "tables" | "draw"} name @param {string} [text] @returns {EngineAnswer} */
  function ask(name, text) {
    if (text !== undefined) {
      const bytes = encoder.encode(text);
      const place = exports.input(bytes.length);
      new Uint8Array(exports.memory.buffer, place, bytes.length).set(bytes);
    }
    const code = exports[name]();
    const bytes = new Uint8Array(exports.memory.buffer, exports.output(), exports.output_length());
    return { code, value: JSON.parse(decoder.decode(bytes)) };
  }
  return {
    /** @param {string} text */
    begin: (text) => ask("begin", text),
    step: () => ask("step"),
    summary: () => ask("summary"),
    decide: () => ask("decide"),
    tables: () => ask("tables"),
    /** @param {DrawnChart} chart */
    draw: (chart) => ask("draw", JSON.stringify(chart)),
  };
}

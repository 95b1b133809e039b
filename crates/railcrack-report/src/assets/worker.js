// A worker of the page: computes the lives of the cases that the page sends, one growth step at a
// time. What comes while a life is computed waits for its end, unless that takes long.
"use strict";

(() => {
  /**
   * A life that takes longer than this (ms) gives way to the next one; after one that did, the
   * longer time counts, so that on a slow machine lives are seen while one drags.
   */
  const [PATIENCE, LONG_PATIENCE] = [700, 4000];

  /** @typedef {ReturnType<typeof openEngine>} Engine */
  /** @type {Engine | null} */
  let engine = null;
  /** @type {EngineRequest | null} */
  let asked = null;
  let isBusy = false;
  let hasGivenWay = false;

  /** @param {object} message */
  const tell = (message) => postMessage(message);

  /** Lets messages in: a timer would wait for milliseconds. @returns {Promise<void>} */
  const breath = () =>
    new Promise((done) => {
      const { port1, port2 } = new MessageChannel();
      port1.onmessage = () => {
        port1.close();
        done();
      };
      port2.postMessage(0);
    });

  /** The module that the page has in packed form, compiled while it is unpacked. @param {Packed} packed */
  function compiled(packed) {
    const deflated = Uint8Array.from(atob(packed), (letter) => letter.charCodeAt(0));
    const stream = new Blob([deflated]).stream().pipeThrough(new DecompressionStream("deflate"));
    const headers = { "Content-Type": "application/wasm" };
    return WebAssembly.compileStreaming(new Response(stream, { headers }));
  }

  /** @param {Engine} engine @param {number} id @param {string} text */
  async function life(engine, id, text) {
    const from = performance.now();
    const begun = engine.begin(text);
    if (begun.code === 2) return tell({ id, errors: begun.value.errors });
    tell({ id, begun: begun.value, ms: performance.now() - from });
    for (let code = 0; code === 0; ) {
      await breath();
      if (asked && performance.now() - from > (hasGivenWay ? LONG_PATIENCE : PATIENCE)) {
        hasGivenWay = true;
        return tell({ id, abandoned: true });
      }
      const before = performance.now();
      const answer = engine.step();
      code = answer.code;
      if (code === 2) return tell({ id, errors: answer.value.errors });
      tell({ id, step: answer.value, ms: performance.now() - before });
    }
    hasGivenWay = false;
    tell({ id, summary: engine.summary().value, ms: performance.now() - from });
  }

  /** @param {Engine} engine @param {number} id @param {"decide" | "tables"} about */
  function more(engine, id, about) {
    const from = performance.now();
    const { code, value } = engine[about]();
    tell(code === 2 ? { id, errors: value.errors } : { id, about, value, ms: performance.now() - from });
  }

  async function serve() {
    isBusy = true;
    while (asked && engine) {
      const { id, text, about } = asked;
      asked = null;
      try {
        if (text !== undefined) await life(engine, id, text);
        else if (about) more(engine, id, about);
      } catch (error) {
        // The module has stopped in the middle of something: the page begins another worker.
        tell({ id, failed: String(error) });
      }
    }
    isBusy = false;
  }

  /** @param {WebAssembly.Module} module */
  function open(module) {
    engine = openEngine(new WebAssembly.Instance(module, {}));
    if (asked && !isBusy) serve();
  }

  addEventListener("message", ({ data }) => {
    if (data instanceof WebAssembly.Module) open(data);
    else if (data.packed)
      compiled(data.packed).then(
        (module) => {
          // For another worker in place of this one.
          tell({ module });
          open(module);
        },
        (reason) => tell({ closed: String(reason.message ?? reason) }),
      );
    else asked = data;
    if (asked && engine && !isBusy) serve();
  });
})();

// "What if": the case of the page computed in the page, again and again while its values change.
"use strict";

railcrack.viewer("what-if-engine", "What if", "the program computes the same case", () => {
  const { button, element, say, within, words } = railcrack;

  const data = /** @type {WhatIfData} */ (railcrack.pageData("what-if-data"));
  const place = element("what-if-engine");
  const editor = element("what-if-case", HTMLTextAreaElement);
  const [readout, banner] = [element("what-if-readout"), element("what-if-verdict")];
  const errorList = element("what-if-errors");

  // ---- The text of a case -----------------------------------------------------------------------

  /** The sections called `name`. @param {string[]} lines @param {string} name @returns {CaseLines[]} */
  function sectionsOf(lines, name) {
    const headers = lines.flatMap((line, at) => {
      const header = /^\s*\[\[?\s*([\w.]+)\s*\]\]?/.exec(line);
      return header ? [{ at, name: header[1] }] : [];
    });
    return headers.flatMap((header, i) =>
      header.name === name ? [{ from: header.at, to: headers[i + 1]?.at ?? lines.length }] : [],
    );
  }

  /** The line of `key` in a section; -1 without one. @param {string[]} lines @param {CaseLines} section @param {string} key */
  function lineOf(lines, { from, to }, key) {
    const own = lines.slice(from + 1, to).findIndex((line) => new RegExp(`^\\s*${key}\\s*=`).test(line));
    return own < 0 ? -1 : from + 1 + own;
  }

  /** What `key` is in the first section called `name`; undefined where it is not given. */
  /** @param {string} text @param {string} name @param {string} key @returns {string | undefined} */
  function valueIn(text, name, key) {
    const lines = text.split("\n");
    const section = sectionsOf(lines, name)[0];
    const line = section ? lineOf(lines, section, key) : -1;
    if (line < 0) return undefined;
    const value = /=\s*("[^"]*"|[^#\s]+)/.exec(lines[line])?.[1];
    return value?.replace(/^"(.*)"$/, "$1");
  }

  /**
   * `text` with `key` of every section called `name` set to `value`; those that lack the key get it
   * where there is no other, and so does a section of this name.
   * @param {string} text @param {string} name @param {string} key @param {string} value
   */
  function withValue(text, name, key, value) {
    const lines = text.split("\n");
    const sections = sectionsOf(lines, name);
    if (!sections.length) return `${text.trimEnd()}\n\n[${name}]\n${key} = ${value}\n`;
    const known = sections.some((section) => lineOf(lines, section, key) >= 0);
    for (const section of sections.reverse()) {
      const line = lineOf(lines, section, key);
      if (line >= 0) lines[line] = lines[line].replace(/=\s*("[^"]*"|[^#\s]+)/, `= ${value}`);
      else if (!known) lines.splice(section.from + 1, 0, `${key} = ${value}`);
    }
    return lines.join("\n");
  }

  /** `text` without the sections called `name`. @param {string} text @param {string} name */
  function withoutSection(text, name) {
    const lines = text.split("\n");
    for (const { from, to } of sectionsOf(lines, name).reverse()) lines.splice(from, to - from);
    return lines.join("\n");
  }

  // ---- Controls ---------------------------------------------------------------------------------

  /** A round step of about a hundredth of `span`. @param {number} span */
  const stepOf = (span) => 10 ** Math.floor(Math.log10(span / 60));

  /** From a quarter of `value` to twice as much. @param {number} value @returns {[number, number, number]} */
  const around = (value) => {
    const step = stepOf(2 * value);
    /** @param {number} end */
    const round = (end) => Math.round(end / step) * step;
    return [round(value / 4), round(2 * value), step];
  };

  /** @param {number} low @param {number} high @param {number} step @returns {Dial["range"]} */
  const between = (low, high, step) => () => [low, high, step];
  const LOADS = ["peak_pressure_mpa", "line_load_n_per_mm", "wheel_load_kn"];
  const WEAR = { section: "maintenance", keys: ["wear_mm_per_mgt"], absent: "0", needs: "traffic" };
  /** @type {Dial[]} */
  const DIALS = [
    { name: "Load", units: ["MPa", "N/mm", "kN"], section: "contact", keys: LOADS, range: around },
    { name: "Friction, wheel", section: "contact", keys: ["friction"], range: between(-0.5, 0.5, 0.005) },
    { name: "Friction, faces", section: "crack", keys: ["friction"], range: between(0, 1, 0.01) },
    { name: "Length", units: ["mm"], section: "crack", keys: ["length_mm"], range: around },
    { name: "Angle", units: ["\u00b0"], section: "crack", keys: ["angle_deg"], range: between(5, 90, 1) },
    { name: "Wear", units: ["mm/MGT"], ...WEAR, range: (value) => [0, Math.max(0.1, 2 * value), 0.001] },
  ];

  /** Water in the cracks: words of the case file and of the page. */
  const WATER = { none: "dry", mouth: "from the mouth", trapped: "trapped" };

  const controls = element("what-if-controls", HTMLFormElement);
  /** What the controls have set: keys of the case with their values. @type {Map<string, string>} */
  let set = new Map();
  /** Whether the text was edited by hand. */
  let isEdited = false;

  /** @param {string} text */
  const waterOf = (text) =>
    sectionsOf(text.split("\n"), "fluid").length ? (valueIn(text, "fluid", "model") ?? "") : "none";

  /** @param {string} text @param {string} name @param {string} value */
  function applied(text, name, value) {
    if (name === "fluid") {
      if (value === waterOf(text)) return text;
      const dry = withoutSection(text, "fluid").trimEnd();
      return value === "none" ? `${dry}\n` : `${dry}\n\n[fluid]\nmodel = "${value}"\n`;
    }
    const [section, key] = name.split(".");
    return withValue(text, section, key, value);
  }

  /** @param {string} name @param {string} value */
  function change(name, value) {
    set.set(name, value);
    editor.value = applied(editor.value, name, value);
    compute();
  }

  /** A slider for `dial`; null where the case has no such value. @param {Dial} dial */
  function slider(dial) {
    const text = data.case;
    const has = (/** @type {string} */ name) => sectionsOf(text.split("\n"), name).length > 0;
    if (dial.needs && !has(dial.needs)) return null;
    const key = dial.keys.find((name) => valueIn(text, dial.section, name) !== undefined);
    const used = key ?? (dial.absent === undefined ? undefined : dial.keys[0]);
    if (!used) return null;
    const first = Number(valueIn(text, dial.section, used) ?? dial.absent);
    if (!Number.isFinite(first)) return null;
    const [low, high, step] = dial.range(first);
    const [label, output] = [document.createElement("label"), document.createElement("output")];
    const input = document.createElement("input");
    const name = `${dial.section}.${used}`;
    Object.assign(input, { type: "range", id: `what-if-${name.replace(".", "-")}` });
    // Steps are counted from the value of the case, at which the slider stands exactly.
    const least = first - Math.floor((first - low) / step + 1e-9) * step;
    const places = Math.max(0, 2 - Math.floor(Math.log10(step) + 1e-9));
    Object.assign(input, { min: String(least), max: String(high), step: String(step) });
    const unit = dial.units?.[dial.keys.indexOf(used)] ?? "";
    /** @param {number} value */
    const show = (value) => {
      const shown = `${words(value)}${unit && unit !== "\u00b0" ? "\u00a0" : ""}${unit}`;
      output.textContent = shown;
      input.setAttribute("aria-valuetext", shown);
    };
    input.addEventListener("input", () => {
      const value = Number(Number(input.value).toFixed(places));
      show(value);
      // A number of TOML with a fraction, however whole it is.
      change(name, Number.isInteger(value) ? value.toFixed(1) : String(value));
    });
    label.append(dial.name, output, input);
    controls.append(label);
    return () => {
      const value = Number(valueIn(editor.value, dial.section, used) ?? dial.absent);
      if (!Number.isFinite(value)) return;
      input.value = String(value);
      show(value);
    };
  }

  /** The menu of water in the cracks. */
  function water() {
    const label = document.createElement("label");
    const menu = Object.assign(document.createElement("select"), { id: "what-if-fluid" });
    for (const [value, name] of Object.entries(WATER)) menu.add(new Option(name, value));
    menu.addEventListener("change", () => change("fluid", menu.value));
    label.append("Water in the crack", menu);
    controls.append(label);
    return () => {
      menu.value = waterOf(editor.value);
    };
  }

  const follow = [...DIALS.map(slider), water()].filter((item) => item !== null);
  /** The controls as the text has their values. */
  const followText = () => {
    for (const one of follow) one();
  };

  const stopButton = Object.assign(button("Stop", stop), { id: "what-if-stop", disabled: true });
  controls.append(stopButton);
  controls.addEventListener("submit", (event) => event.preventDefault());

  addEventListener("beforeprint", () => {
    element("what-if-printed").textContent = editor.value;
  });

  // ---- The engine -------------------------------------------------------------------------------

  /** @type {Life | null} */
  let now = null;
  /** The last life that was computed to its end. @type {Life | null} */
  let whole = null;
  /** The life of the case of the page. @type {Life | null} */
  let first = null;
  /** @type {Worker | null} */
  let worker = null;
  /** @type {WebAssembly.Module | null} */
  let module = null;
  /** Whether something was computed, or is about to be. */
  let hasBegun = false;
  /** Buttons that save a table of the last life, and its file. */
  const TABLES = { "what-if-growth": "growth.csv", "what-if-sif": "sif.csv" };
  let id = 0;
  /** Where an answer was last given, ms. */
  let heard = 0;
  /** Answers to what was asked about the last life. @type {((value: any) => void) | null} */
  let answer = null;

  /** A worker that answers nothing for so long (ms) is replaced by another one. */
  const SILENT = 1500;
  /** A text at rest for so long (ms) goes into the address, and has its whole decision made. */
  const REST = 600;

  function startWorker() {
    worker?.terminate();
    const url = URL.createObjectURL(new Blob([data.worker], { type: "text/javascript" }));
    worker = new Worker(url);
    URL.revokeObjectURL(url);
    worker.onmessage = ({ data: message }) => hear(message);
    worker.postMessage(module ?? { packed: data.module });
    heard = performance.now();
  }

  /** @param {string} state */
  function isNow(state) {
    place.dataset.state = state;
    stopButton.disabled = state !== "computing" && state !== "deciding";
    // The tables are those of a session that waits.
    for (const name of Object.keys(TABLES)) element(name, HTMLButtonElement).disabled = state !== "done";
  }

  let resting = 0;
  /** Whether the case at first is computed before that of the address. */
  let isOpening = false;
  function compute(text = editor.value) {
    clearTimeout(resting);
    if (!hasBegun) return;
    // What is compiled says nothing.
    const isSilent = module && place.dataset.state === "computing" && performance.now() - heard > SILENT;
    if (!worker || isSilent || place.dataset.state === "deciding") startWorker();
    id += 1;
    heard = performance.now();
    isNow("computing");
    worker?.postMessage({ id, text });
    resting = setTimeout(remember, REST);
  }

  function stop() {
    const { state } = place.dataset;
    if (state !== "computing" && state !== "deciding") return;
    startWorker();
    isNow("stopped");
    readout.textContent =
      state === "deciding"
        ? "Stopped: the decision is that of this life alone, without the lives along other paths."
        : "Stopped: the curves are those of the steps that were computed.";
  }

  /** @param {any} message */
  function hear(message) {
    heard = performance.now();
    if (message.module) module = message.module;
    else if (message.closed) {
      isNow("failed");
      readout.textContent = `The engine does not start: ${message.closed}. A browser of 2023 or later is required.`;
    } else if (message.failed) {
      startWorker();
      isNow("failed");
      readout.textContent = `The engine stopped: ${message.failed}`;
    } else if (message.errors) refuse(message.errors);
    else if (message.begun) {
      errorList.hidden = true;
      place.dataset.slowest = "0";
      now = { case: message.begun, steps: [], summary: null };
    } else if (message.step && now) {
      now.steps.push(message.step);
      place.dataset.slowest = String(Math.max(Number(place.dataset.slowest), message.ms));
      redraw();
    } else if (message.about === "decide") decided(message.value, message.ms);
    else if (message.about) answer?.(message.value);
    else if (message.summary && now) over(now, message);
  }

  /** A life is computed to its end. @param {Life} life @param {any} message */
  function over(life, message) {
    life.summary = message.summary;
    whole = life;
    first ??= life;
    place.dataset.life = String(message.ms);
    place.dataset.lives = String(Number(place.dataset.lives ?? 0) + 1);
    if (message.id === id) isNow("done");
    tell(message.ms);
    redraw();
    if (isOpening) {
      isOpening = false;
      compute();
    }
  }

  /** Fills a list, which is hidden while it is empty. @param {HTMLElement} place @param {string[]} texts */
  function list(place, texts) {
    const items = texts.map((textContent) => Object.assign(document.createElement("li"), { textContent }));
    place.replaceChildren(...items);
    place.hidden = !texts.length;
  }

  /** @param {{ message: string, line: number | null, help: string | null }[]} errors */
  function refuse(errors) {
    isNow("refused");
    /** @param {typeof errors[number]} error */
    const text = ({ message, line, help }) =>
      `${line ? `line ${line}: ` : ""}${message}${help ? ` (${help})` : ""}`;
    list(errorList, errors.map(text));
    readout.textContent = "The case is not computed: its errors are listed below the charts.";
  }

  /** What a text at rest has done: its address, and the rest of its decision. */
  function remember() {
    if (place.dataset.state === "computing") {
      resting = setTimeout(remember, REST);
      return;
    }
    writeAddress();
    if (place.dataset.state !== "done" || !whole?.summary.decision) return;
    isNow("deciding");
    tell(Number(place.dataset.life));
    worker?.postMessage({ id, about: "decide" });
  }

  /** @param {any} summary @param {number} ms */
  function decided(summary, ms) {
    if (place.dataset.state !== "deciding" || !whole) return;
    whole.summary = summary;
    isNow("done");
    place.dataset.decided = "true";
    place.dataset.deciding = String(ms);
    tell(Number(place.dataset.life));
  }

  // ---- Words ------------------------------------------------------------------------------------

  const OUTSIDE = "Outside of what the model describes";
  /** @type {Record<string, string>} */
  const LEVELS = { ok: "OK", act: "Act", unknown: "Not known", stop: "Stop", outside: OUTSIDE };
  /** @param {Life} life */
  const lifeWords = ({ summary }) => {
    const failure = summary.decision?.failure;
    if (failure?.mgt != null) return `failure (${failure.mode}) after ${words(failure.mgt)} MGT`;
    const end = String(summary.stop).replaceAll("-", " ");
    const after =
      summary.million_gross_tonnes === null
        ? `${words(summary.load_cycles)} load cycles`
        : `${words(summary.million_gross_tonnes)} MGT`;
    return `${end} after ${after}`;
  };

  /** @param {number} ms */
  function tell(ms) {
    if (!whole) return;
    const { summary, steps } = whole;
    const verdict = summary.decision?.verdict;
    banner.hidden = false;
    banner.className = `decision ${verdict?.level ?? "act"}`;
    within(banner, "strong").textContent = verdict ? LEVELS[verdict.level] : "Life";
    within(banner, "span").textContent = `${verdict ? (verdict.reasons[0]?.text ?? "") : lifeWords(whole)}.`;
    const { paths, act_on, calibration } = summary.decision ?? {};
    /** @param {number | null} mgt */
    const life = (mgt) => (mgt === null ? "no failure" : `${words(mgt)} MGT`);
    const says = [
      act_on && `inspection interval ${life(act_on.interval_mgt)}, P(missed) ${words(act_on.probability)}`,
      paths &&
        `straight ahead ${life(paths.straight)}, as computed ${life(paths.nominal)}, limit path ${life(paths.limit)}`,
      calibration,
    ];
    for (const { step, text } of summary.warnings) says.push(`warning, step ${step}: ${text}`);
    list(element("what-if-says"), says.filter(Boolean));
    const tip = steps[0]?.tips[0];
    const before = first && first !== whole ? ` As at first: ${lifeWords(first)}.` : "";
    const rest = place.dataset.state === "deciding" ? " The rest of the decision is being computed." : "";
    say(
      readout,
      `Computed here and now: ${steps.length} steps in ${words(Math.round(ms))} ms, ${lifeWords(whole)}; ` +
        `first step ΔK_{I} = ${words(tip?.delta_ki_mpa_sqrt_m ?? 0)}, ΔK_{II} = ${words(tip?.delta_kii_mpa_sqrt_m ?? 0)} MPa√m.${before}${rest}`,
    );
  }

  // ---- Charts -----------------------------------------------------------------------------------

  /** Tips whose curves a chart shows at most. */
  const MOST_TIPS = 6;
  /** The lives on the charts: the first one, and that of now above it. @returns {[Life | null, boolean][]} */
  const shownLives = () => [
    [first === now ? null : first, true],
    [now?.steps.length ? now : whole, false],
  ];
  /** The curves of both lives, of each by crack or tip. @param {(life: Life) => Pair[][]} of @returns {DrawnCurve[]} */
  const curvesOf = (of) =>
    shownLives().flatMap(([life, isFirst]) =>
      (life ? of(life) : []).map((points, tip) => ({
        points,
        name: isFirst ? data.first : "now",
        colour: isFirst ? null : tip,
      })),
    );
  /** K of the first passage. @param {"ki_mpa_sqrt_m" | "kii_mpa_sqrt_m"} name */
  const history = (name) =>
    curvesOf(({ steps, case: { half_width_mm } }) => {
      const [step] = steps;
      const mouth = step?.cracks[0][0][0] ?? 0;
      const xs = step?.passage?.xc_mm.map((xc) => (xc - mouth) / half_width_mm) ?? [];
      return (step?.passage?.tips ?? [])
        .slice(0, MOST_TIPS)
        .map((tip) => xs.map((x, i) => [x, tip[name][i]]));
    });
  /** Depths that the case names, as lines across traffic. @param {DrawnCurve[]} lives @returns {DrawnCurve[]} */
  const limits = (lives) => {
    const across = railcrack.ends(lives.flatMap(({ points }) => points.map(([x]) => x)));
    const named = ["detectable", "critical"].map((name) => {
      const depth = Number(valueIn(editor.value, "inspection", `${name}_depth_mm`));
      return {
        name: `${name} depth`,
        colour: null,
        points: across.map((x) => /** @type {Pair} */ ([x, depth])),
      };
    });
    return named.filter(({ points }) => points[0][1] > 0);
  };

  /** What the charts show. @returns {DrawnChart[]} */
  function drawings() {
    const depths = curvesOf(({ steps }) => [
      steps.map((step) => [step.mgt ?? step.load_cycles, Math.max(...step.tips.map((tip) => tip.depth_mm))]),
    ]);
    const paths = curvesOf(
      ({ steps }) => steps.at(-1)?.cracks.map((crack) => crack.map(([x, y]) => [x, -y])) ?? [],
    );
    return [
      { kind: "kii", curves: history("kii_mpa_sqrt_m") },
      { kind: "ki", curves: history("ki_mpa_sqrt_m") },
      { kind: now?.steps[0]?.mgt == null ? "depth" : "depth-mgt", curves: [...limits(depths), ...depths] },
      { kind: "path", curves: paths },
    ];
  }
  /** The engine of the page itself draws, while that of the worker computes. @type {ReturnType<typeof openEngine> | null} */
  let drawer = null;
  let frame = 0;
  /** Draws in the next frame, once. */
  function redraw() {
    frame ||= requestAnimationFrame(async () => {
      if (!drawer && module) drawer = openEngine(await WebAssembly.instantiate(module, {}));
      frame = 0;
      for (const drawing of drawings()) {
        if (!(drawer && drawing.curves.some(({ points }) => points.length))) continue;
        const id = `what-if-${drawing.kind.replace("-mgt", "")}`;
        // The program's own figure, whose texts are escaped.
        element(id).outerHTML = drawer.draw(drawing).value;
        railcrack.tools(railcrack.chartOf(element(id)).figure);
      }
    });
  }

  // ---- Text, files, address ---------------------------------------------------------------------

  editor.addEventListener("input", () => {
    isEdited = true;
    set = new Map();
    followText();
    compute();
  });
  addEventListener("keydown", ({ key }) => {
    if (key === "Escape") stop();
  });

  element("what-if-save").addEventListener("click", () =>
    railcrack.download("case.toml", "text/plain", editor.value),
  );
  element("what-if-load").addEventListener("change", async () => {
    const file = element("what-if-load", HTMLInputElement).files?.[0];
    if (!file) return;
    editor.value = await file.text();
    editor.dispatchEvent(new Event("input"));
  });
  element("what-if-reset").addEventListener("click", () => {
    editor.value = data.case;
    set = new Map();
    isEdited = false;
    followText();
    compute();
  });
  for (const [name, table] of Object.entries(TABLES))
    element(name).addEventListener("click", () => {
      if (place.dataset.state !== "done") return;
      answer = (tables) => {
        answer = null;
        railcrack.download(table, "text/csv", tables[table]);
      };
      worker?.postMessage({ id, about: "tables" });
    });

  /** What the address begins with: other fragments are sections of the page. */
  const MARK = "#what-if&";

  /** What the sliders have set goes into the address; an edited text is saved as a file instead. */
  function writeAddress() {
    const fragment =
      isEdited || !set.size ? "" : MARK + [...set].map(([name, value]) => `${name}=${value}`).join("&");
    if (fragment) window.history.replaceState(null, "", fragment);
    else if (location.hash.startsWith(MARK)) window.history.replaceState(null, "", "#what-if");
  }

  function readAddress() {
    let text = data.case;
    set = new Map();
    isEdited = false;
    if (location.hash.startsWith(MARK))
      for (const [name, value] of new URLSearchParams(location.hash.slice(MARK.length)))
        if (/^[\w.]+$/.test(name) && /^[\w.+-]+$/.test(value)) {
          text = applied(text, name, value);
          set.set(name, value);
        }
    editor.value = text;
    followText();
  }
  addEventListener("hashchange", () => {
    if (!location.hash.startsWith(MARK)) return;
    readAddress();
    compute();
  });

  readAddress();

  const sight = new IntersectionObserver((seen) => {
    if (!seen.some((entry) => entry.isIntersecting)) return;
    sight.disconnect();
    readout.textContent = "The engine is being unpacked.";
    hasBegun = true;
    // An address with other values: the case at first is computed before it.
    isOpening = editor.value !== data.case;
    compute(isOpening ? data.case : editor.value);
  });
  sight.observe(place);
});

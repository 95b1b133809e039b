// "What if": the case of the page computed in the page, again and again while its values change.
"use strict";

railcrack.viewer("what-if-engine", "What if", "the program computes the same case", async () => {
  const { aired, ends, element, linear, picture, say, sized, toScale, unpack, words } = railcrack;
  const { within, button } = railcrack;

  const started = typeof railcrackStarted === "undefined" ? null : railcrackStarted;
  const data = started?.data ?? /** @type {WhatIfData} */ (railcrack.pageData("what-if-data"));
  const place = element("what-if-engine");
  const editor = element("what-if-case", HTMLTextAreaElement);
  const readout = element("what-if-readout");
  const banner = element("what-if-verdict");
  const errorList = element("what-if-errors");

  // ---- The text of a case -----------------------------------------------------------------------

  /**
   * The lines of a section, from its header on, as places in the text.
   * @typedef {{ from: number, to: number }} Lines
   */

  /** The sections called `name`. @param {string[]} lines @param {string} name @returns {Lines[]} */
  function sectionsOf(lines, name) {
    const headers = lines.flatMap((line, at) => {
      const header = /^\s*\[\[?\s*([\w.]+)\s*\]\]?/.exec(line);
      return header ? [{ at, name: header[1] }] : [];
    });
    return headers.flatMap((header, i) =>
      header.name === name ? [{ from: header.at, to: headers[i + 1]?.at ?? lines.length }] : [],
    );
  }

  /** The line of `key` in a section; -1 without one. @param {string[]} lines @param {Lines} section @param {string} key */
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

  /**
   * A value of the case that a slider sets: the first of `keys` that the case has, or the only one
   * where the case may lack it.
   * @typedef {object} Dial
   * @property {string} name
   * @property {string} unit
   * @property {string} section
   * @property {string[]} keys
   * @property {string} [absent] Its value where the case lacks the key.
   * @property {string} [needs] A section without which it means nothing.
   * @property {(value: number) => [number, number, number]} range Ends and step.
   */

  /** A round step of about a hundredth of `span`. @param {number} span */
  const stepOf = (span) => 10 ** Math.floor(Math.log10(span / 60));

  /** From a quarter of `value` to twice as much. @param {number} value @returns {[number, number, number]} */
  const around = (value) => {
    const step = stepOf(2 * value);
    /** @param {number} end */
    const round = (end) => Math.round(end / step) * step;
    return [round(value / 4), round(2 * value), step];
  };

  /** @type {Dial[]} */
  const DIALS = [
    {
      name: "Load",
      unit: "",
      section: "contact",
      keys: ["peak_pressure_mpa", "line_load_n_per_mm", "wheel_load_kn"],
      range: around,
    },
    {
      name: "Friction, wheel",
      unit: "",
      section: "contact",
      keys: ["friction"],
      range: (value) => [value < 0 ? -0.5 : Math.min(0, -0.5), 0.5, 0.005],
    },
    {
      name: "Friction, faces",
      unit: "",
      section: "crack",
      keys: ["friction"],
      range: () => [0, 1, 0.01],
    },
    { name: "Length", unit: "mm", section: "crack", keys: ["length_mm"], range: around },
    { name: "Angle", unit: "\u00b0", section: "crack", keys: ["angle_deg"], range: () => [5, 90, 1] },
    {
      name: "Wear",
      unit: "mm/MGT",
      section: "maintenance",
      keys: ["wear_mm_per_mgt"],
      absent: "0",
      needs: "traffic",
      range: (value) => [0, Math.max(0.1, 2 * value), 0.001],
    },
  ];

  const UNITS = /** @type {Record<string, string>} */ ({
    peak_pressure_mpa: "MPa",
    line_load_n_per_mm: "N/mm",
    wheel_load_kn: "kN",
  });

  /** Water in the cracks: words of the case file and of the page. @type {[string, string][]} */
  const WATER = [
    ["none", "dry"],
    ["mouth", "from the mouth"],
    ["trapped", "trapped"],
  ];

  const controls = element("what-if-controls", HTMLFormElement);
  /** What the controls have set: keys of the case with their values. @type {Map<string, string>} */
  let set = new Map();
  /** Whether the text was edited by hand. */
  let isEdited = false;

  /** @param {string} text */
  function waterOf(text) {
    return sectionsOf(text.split("\n"), "fluid").length ? (valueIn(text, "fluid", "model") ?? "") : "none";
  }

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
    const label = document.createElement("label");
    const output = document.createElement("output");
    const input = document.createElement("input");
    const name = `${dial.section}.${used}`;
    input.type = "range";
    input.id = `what-if-${name.replace(".", "-")}`;
    // The slider stands exactly at the value of the case.
    const places = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
    Object.assign(input, { min: String(low), max: String(high), step: "any" });
    const unit = UNITS[used] ?? dial.unit;
    /** @param {number} value */
    const show = (value) => {
      const shown = `${words(value)}${unit && unit !== "\u00b0" ? "\u00a0" : ""}${unit}`;
      output.textContent = shown;
      input.setAttribute("aria-valuetext", shown);
    };
    input.addEventListener("input", () => {
      const value = Number((Math.round(Number(input.value) / step) * step).toFixed(places));
      show(value);
      // A number of TOML with a fraction, however whole it is.
      change(name, Number.isInteger(value) ? value.toFixed(1) : String(value));
    });
    // Without steps of its own, a slider would move by a hundredth of its way.
    input.addEventListener("keydown", (event) => {
      const ways = /** @type {Record<string, number>} */ ({
        ArrowLeft: -1,
        ArrowDown: -1,
        ArrowRight: 1,
        ArrowUp: 1,
        PageDown: -10,
        PageUp: 10,
      });
      const way = ways[event.key];
      if (!way) return;
      event.preventDefault();
      input.value = String(Math.max(low, Math.min(high, Number(input.value) + way * step)));
      input.dispatchEvent(new Event("input"));
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
    const menu = document.createElement("select");
    menu.id = "what-if-fluid";
    for (const [value, name] of WATER) menu.add(new Option(name, value));
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

  const stopButton = button("Stop", stop);
  stopButton.id = "what-if-stop";
  stopButton.disabled = true;
  {
    const row = document.createElement("div");
    row.className = "buttons";
    const hint = document.createElement("span");
    hint.className = "hint";
    hint.textContent = "Keys: arrows and Page Up, Page Down on a slider; Escape stops";
    row.append(stopButton, hint);
    controls.append(row);
    controls.addEventListener("submit", (event) => event.preventDefault());
  }

  addEventListener("beforeprint", () => {
    element("what-if-printed").textContent = editor.value;
  });

  // ---- The engine -------------------------------------------------------------------------------

  /** A life, as far as it is computed. @typedef {{ case: WhatIfCase, steps: WhatIfStep[], summary: any }} Life */
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

  /** @param {{ message: string, line: number | null, help: string | null }[]} errors */
  function refuse(errors) {
    isNow("refused");
    errorList.replaceChildren(
      ...errors.map(({ message, line, help }) => {
        const item = document.createElement("li");
        item.textContent = `${line ? `line ${line}: ` : ""}${message}${help ? ` (${help})` : ""}`;
        return item;
      }),
    );
    errorList.hidden = false;
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

  const LEVELS = /** @type {Record<string, string>} */ ({
    ok: "OK",
    act: "Act",
    stop: "Stop",
    outside: "Outside of what the model describes",
  });
  const MODES = /** @type {Record<string, string>} */ ({
    depth: "the critical depth",
    length: "the critical length",
    fracture: "fracture",
    spall: "a spall",
    detached: "the loss of a piece",
  });

  /** @param {Life} life */
  const lifeWords = ({ summary }) => {
    const failure = summary.decision?.failure;
    if (failure?.mgt != null) return `${MODES[failure.mode]} after ${words(failure.mgt)} MGT`;
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
    const interval = summary.decision?.inspection?.interval_mgt;
    within(banner, "span").textContent = verdict
      ? `${verdict.reasons[0]?.text ?? ""}.${interval ? ` Inspection interval: ${words(interval)} MGT.` : ""}`
      : `${lifeWords(whole)}.`;
    const [step] = steps;
    const tip = step?.tips[0];
    const before = first && first !== whole ? ` As at first: ${lifeWords(first)}.` : "";
    const rest = place.dataset.state === "deciding" ? " The rest of the decision is being computed." : "";
    say(
      readout,
      `Computed here and now: ${steps.length} steps in ${words(Math.round(ms))} ms, ${lifeWords(whole)}; ` +
        `first step ΔK_{I} = ${words(tip?.delta_ki_mpa_sqrt_m ?? 0)}, ΔK_{II} = ${words(tip?.delta_kii_mpa_sqrt_m ?? 0)} MPa√m.${before}${rest}`,
    );
  }

  // ---- Charts -----------------------------------------------------------------------------------

  const MARGIN = { top: 12, right: 14, bottom: 40, left: 52 };
  const charts = {
    kii: picture("what-if-kii"),
    ki: picture("what-if-ki"),
    depth: picture("what-if-depth"),
    path: picture("what-if-path"),
  };
  /** Tips whose curves a chart shows at most. */
  const MOST_TIPS = 6;

  /** @typedef {{ x: number, y: number, z: number, was: boolean }} LifePoint */

  /** The lives on the charts: the one of now, and the first one behind it. @returns {[Life | null, boolean][]} */
  const shownLives = () => [
    [first === now ? null : first, true],
    [now?.steps.length ? now : whole, false],
  ];

  /** @param {(life: Life) => { x: number, y: number, z: number }[]} of @returns {LifePoint[]} */
  const pointsOf = (of) =>
    shownLives().flatMap(([life, was]) => (life ? of(life).map((point) => ({ ...point, was })) : []));

  /** @param {LifePoint[]} points */
  const curves = (points) =>
    [true, false].map((was) =>
      Plot.line(
        points.filter((point) => point.was === was),
        {
          x: "x",
          y: "y",
          z: "z",
          stroke: was ? "var(--quiet)" : (/** @type {LifePoint} */ { z }) => `var(--c${z % 9})`,
          strokeWidth: was ? 1.5 : 2.2,
          strokeDasharray: was ? "5 4" : undefined,
        },
      ),
    );

  /** @param {"ki_mpa_sqrt_m" | "kii_mpa_sqrt_m"} name */
  const historyPoints = (name) =>
    pointsOf(({ steps, case: { half_width_mm } }) => {
      const [step] = steps;
      const passage = step?.passage;
      if (!passage) return [];
      const mouth = step.cracks[0][0][0];
      return passage.tips
        .slice(0, MOST_TIPS)
        .flatMap((tip, z) =>
          tip[name].map((y, i) => ({ x: (passage.xc_mm[i] - mouth) / half_width_mm, y, z })),
        );
    });

  /** @param {"ki" | "kii"} name */
  function drawHistory(name) {
    const chart = charts[name];
    const points = historyPoints(`${name}_mpa_sqrt_m`);
    if (!(chart.width && points.length)) return;
    chart.show(
      Plot.plot({
        ...sized(chart.width, 240, MARGIN),
        x: linear("x_{c}/a"),
        y: linear(`K_{${name === "ki" ? "I" : "II"}} (MPa√m)`),
        ariaLabel: `History of K ${name.slice(1).toUpperCase()} over the first passage`,
        marks: [Plot.ruleY([0], { stroke: "var(--line)" }), ...curves(points)],
      }),
    );
  }

  /** @param {WhatIfStep} step */
  const trafficOf = (step) => step.mgt ?? step.load_cycles;

  function drawDepth() {
    const chart = charts.depth;
    const points = pointsOf(({ steps }) =>
      steps.map((step) => ({
        x: trafficOf(step),
        y: Math.max(...step.tips.map((tip) => tip.depth_mm)),
        z: 0,
      })),
    );
    if (!(chart.width && points.length)) return;
    const limits = ["detectable_depth_mm", "critical_depth_mm"].flatMap((key) => {
      const value = Number(valueIn(editor.value, "inspection", key));
      return Number.isFinite(value) && value > 0 ? [{ y: value, name: key.split("_")[0] }] : [];
    });
    const title = now?.steps[0]?.mgt == null ? "Load cycles" : "Million gross tonnes";
    chart.show(
      Plot.plot({
        ...sized(chart.width, 240, MARGIN),
        x: linear(title),
        y: { ...linear("Depth (mm)"), zero: true, reverse: true },
        ariaLabel: "Depth of the deepest tip over traffic",
        marks: [
          Plot.ruleY(limits, { y: "y", stroke: "var(--c1)", strokeDasharray: "2 3" }),
          Plot.text(limits, {
            y: "y",
            text: "name",
            frameAnchor: "right",
            dx: -4,
            dy: -7,
            textAnchor: "end",
            fill: "var(--quiet)",
          }),
          ...curves(points),
          Plot.dot(
            points.filter(({ was }) => !was),
            { x: "x", y: "y", r: 2.5, fill: "var(--c0)" },
          ),
        ],
      }),
    );
  }

  function drawPath() {
    const chart = charts.path;
    const points = pointsOf(({ steps }) =>
      (steps.at(-1)?.cracks ?? []).flatMap((crack, z) => crack.map(([x, y]) => ({ x, y: -y, z }))),
    );
    if (!(chart.width && points.length)) return;
    const [, deepest] = ends(points.map(({ y }) => y));
    const inside = chart.width - MARGIN.left - MARGIN.right;
    const across = aired(points.map(({ x }) => x));
    const fit = toScale(across, [-0.05 * deepest, 1.1 * deepest], inside, { most: 190, least: 120 });
    chart.show(
      Plot.plot({
        ...sized(chart.width, fit.height + MARGIN.top + MARGIN.bottom, MARGIN),
        x: linear("x (mm)", fit.x),
        y: linear("Depth (mm)", [fit.y[1], fit.y[0]]),
        ariaLabel: "Cracks after the last step, to scale",
        marks: [Plot.ruleY([0], { stroke: "var(--ink)", strokeWidth: 2 }), ...curves(points)],
      }),
    );
  }

  const drawAll = () => {
    drawHistory("kii");
    drawHistory("ki");
    drawDepth();
    drawPath();
  };
  let frame = 0;
  /** Draws in the next frame, once. */
  const redraw = () => {
    frame ||= requestAnimationFrame(() => {
      frame = 0;
      drawAll();
    });
  };
  for (const chart of Object.values(charts)) {
    chart.follow(drawAll);
    chart.explain([
      { name: "now", colour: "var(--c0)" },
      { name: data.first, colour: "var(--quiet)", dashes: "5 4" },
    ]);
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

  /** @param {string} name @param {string} text */
  function save(name, text) {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([text], { type: "text/plain" }));
    link.download = name;
    link.click();
    URL.revokeObjectURL(link.href);
  }

  element("what-if-copy").addEventListener("click", () => {
    editor.select();
    navigator.clipboard?.writeText(editor.value).catch(() => document.execCommand("copy"));
  });
  element("what-if-save").addEventListener("click", () => save("case.toml", editor.value));
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
        save(table, tables[table]);
      };
      worker?.postMessage({ id, about: "tables" });
    });

  /** What the address begins with: other fragments are sections of the page. */
  const MARK = "#what-if&";

  /** Bytes as letters of an address. @param {Uint8Array} bytes */
  const lettered = (bytes) =>
    btoa(String.fromCharCode(...bytes))
      .replaceAll("+", "-")
      .replaceAll("/", "_")
      .replaceAll("=", "");

  async function writeAddress() {
    let fragment = "";
    if (isEdited) {
      const stream = new Blob([editor.value]).stream().pipeThrough(new CompressionStream("deflate"));
      fragment = `${MARK}case=${lettered(new Uint8Array(await new Response(stream).arrayBuffer()))}`;
    } else if (set.size) fragment = MARK + [...set].map(([name, value]) => `${name}=${value}`).join("&");
    if (fragment) history.replaceState(null, "", fragment);
    else if (location.hash.startsWith(MARK)) history.replaceState(null, "", "#what-if");
  }

  async function readAddress() {
    let text = data.case;
    set = new Map();
    isEdited = false;
    if (location.hash.startsWith(MARK)) {
      for (const [name, value] of new URLSearchParams(location.hash.slice(MARK.length))) {
        if (name === "case") {
          const bytes = await unpack(value.replaceAll("-", "+").replaceAll("_", "/"));
          text = new TextDecoder().decode(bytes);
          isEdited = true;
        } else if (/^[\w.]+$/.test(name) && /^[\w.+-]+$/.test(value)) {
          text = applied(text, name, value);
          set.set(name, value);
        }
      }
    }
    editor.value = text;
    followText();
  }
  addEventListener("hashchange", async () => {
    if (!location.hash.startsWith(MARK)) return;
    await readAddress();
    compute();
  });

  editor.value = data.case;
  followText();
  await readAddress();

  function start() {
    readout.textContent = "The engine is being unpacked.";
    hasBegun = true;
    // An address with other values: the case at first is computed before it.
    isOpening = editor.value !== data.case;
    if (!started) {
      compute(isOpening ? data.case : editor.value);
      return;
    }
    worker = started.worker;
    id = 1;
    isNow("computing");
    resting = setTimeout(remember, REST);
    worker.onmessage = ({ data: message }) => hear(message);
    for (const message of started.said) hear(message);
  }
  if (started) start();
  else {
    const sight = new IntersectionObserver((seen) => {
      if (!seen.some((entry) => entry.isIntersecting)) return;
      sight.disconnect();
      start();
    });
    sight.observe(place);
  }
});

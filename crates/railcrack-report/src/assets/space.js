// The explorer of a crack in space: sliders for growth step, wheel position and point of the front.
"use strict";

(async () => {
  const { words, singles, legend, scale, typeset, onWidth, tools } = railcrack;
  const find = (id) => document.getElementById(id);
  const data = JSON.parse(find("space-data").textContent);
  const { wheel, positions, steps } = data;
  const MODES = [["ki", "K_{I}", "var(--c0)"], ["kii", "K_{II}", "var(--c1)"], ["kiii", "K_{III}", "var(--c2)"]];
  const count = positions.length;
  // By step, mode and point of the front: K over the wheel positions.
  const k = await Promise.all(steps.map(async (step) =>
    Object.fromEntries(await Promise.all(MODES.map(async ([name]) => [name, await Promise.all(step.front.map((point) => (point[name] ? singles(point[name]) : [])))])))));
  const state = { step: 0, position: 0, point: Math.floor(steps[0].front.length / 2) };
  state.position = d3.maxIndex(positions, (_, i) => Math.hypot(...MODES.map(([name]) => k[0][name][state.point][i] ?? 0)));
  const centre = () => data.origin + positions[state.position] * wheel.half_width;
  const signed = (value, digits) => value.toFixed(digits).replace(/^-(?=[0.]*$)/, "").replace("-", "\u2212");
  const widths = {};
  const style = { fontSize: "12px", overflow: "visible" };
  const show = (id, svg) => find(id).querySelector(".drawing").replaceChildren(typeset(svg));
  const closed = data.buried;
  const outline = (index) => (closed ? [...steps[index].front, steps[index].front[0]] : steps[index].front);
  const last = steps.length - 1;
  const MARGIN = { left: 56, right: 16, top: 12, bottom: 42 };

  /** Domains of one scale both ways on `width` pixels, and the height of the picture. */
  function toScale(xs, ys, width, most) {
    const inside = width - MARGIN.left - MARGIN.right;
    const air = (values) => { const [a, b] = d3.extent(values); const more = 0.06 * ((b - a) || 1); return [a - more, b + more]; };
    let [x, y] = [air(xs), air(ys)];
    const middle = ([a, b], span) => [0.5 * (a + b - span), 0.5 * (a + b + span)];
    let perMm = inside / (x[1] - x[0]);
    if (perMm * (y[1] - y[0]) > most) { perMm = most / (y[1] - y[0]); x = middle(x, inside / perMm); }
    if (perMm * (y[1] - y[0]) < 120) y = middle(y, 120 / perMm);
    return { x, y, height: Math.round(perMm * (y[1] - y[0])) + MARGIN.top + MARGIN.bottom };
  }

  const axis = (title, domain) => ({ ...scale({ title, scale: "linear" }), domain, grid: false });

  const fronts = (x, y) => [
    Plot.line(outline(0), { x, y, stroke: "var(--quiet)", strokeDasharray: "2 3", strokeWidth: 1.6 }),
    Plot.line(outline(last), { x, y, stroke: "var(--quiet)", strokeWidth: 1 }),
    Plot.line(outline(state.step), { x, y, stroke: "var(--ink)", strokeWidth: 3 }),
  ];

  const chosen = (x, y) => Plot.dot([steps[state.step].front[state.point]], { x, y, r: 5, fill: "var(--c4)", stroke: "var(--ink)" });

  function drawAbove() {
    if (!widths.above) return;
    const xc = centre();
    const ellipse = d3.range(0, 73).map((i) => ({ x: xc + wheel.half_width * Math.cos(Math.PI * i / 36), z: wheel.lateral + wheel.lateral_half_width * Math.sin(Math.PI * i / 36) }));
    const all = [...outline(0), ...outline(last)];
    const wide = [wheel.lateral - wheel.lateral_half_width, wheel.lateral + wheel.lateral_half_width];
    const around = [d3.min(all, (p) => p.x) - wheel.half_width, d3.max(all, (p) => p.x) + wheel.half_width];
    const fit = toScale(around, [...all.map((p) => p.z), ...wide], widths.above, 420);
    const mouth = closed ? [] : [steps[state.step].front[0], steps[state.step].front.at(-1)];
    show("above", Plot.plot({
      width: widths.above, height: fit.height, marginLeft: MARGIN.left, marginRight: MARGIN.right, marginTop: MARGIN.top, marginBottom: MARGIN.bottom,
      x: axis("x (mm)", fit.x), y: axis("z, across the rail (mm)", fit.y), ariaLabel: "Crack from above with the contact ellipse", style,
      marks: [
        Plot.rect([0], { x1: fit.x[0], x2: fit.x[1], y1: fit.y[0], y2: fit.y[1], fill: "var(--rail)" }),
        Plot.line(ellipse, { x: "x", y: "z", fill: "var(--c1)", fillOpacity: 0.2, stroke: "var(--c1)", clip: true }),
        Plot.line(outline(state.step), { x: "x", y: "z", fill: "var(--c0)", fillOpacity: 0.12, stroke: "none" }),
        Plot.line(mouth, { x: "x", y: "z", stroke: "var(--ink)", strokeWidth: 1.4, strokeDasharray: "6 4" }),
        ...fronts("x", "z"), chosen("x", "z"),
      ],
    }));
  }

  function drawSide() {
    if (!widths.side) return;
    const xc = centre();
    const all = [...outline(0), ...outline(last)];
    const deepest = d3.max(all, (p) => p.depth);
    const load = 0.35 * Math.max(deepest, 0.5 * wheel.half_width);
    const around = [d3.min(all, (p) => p.x) - wheel.half_width, d3.max(all, (p) => p.x) + wheel.half_width];
    const fit = toScale(around, [-1.2 * load, deepest], widths.side, 420);
    const pressure = d3.range(0, 61).map((i) => ({ x: xc - wheel.half_width * Math.cos(Math.PI * i / 60), y: -load * Math.sin(Math.PI * i / 60) }));
    show("side", Plot.plot({
      width: widths.side, height: fit.height, marginLeft: MARGIN.left, marginRight: MARGIN.right, marginTop: MARGIN.top, marginBottom: MARGIN.bottom,
      x: axis("x (mm)", fit.x), y: { ...axis("Depth (mm)", [fit.y[1], fit.y[0]]), ticks: d3.ticks(0, fit.y[1], 5) }, ariaLabel: "Crack from the side below the wheel", style,
      marks: [
        Plot.rect([0], { x1: fit.x[0], x2: fit.x[1], y1: 0, y2: fit.y[1], fill: "var(--rail)" }),
        Plot.line([[fit.x[0], 0], [fit.x[1], 0]], { stroke: "var(--ink)", strokeWidth: 2 }),
        Plot.areaY(pressure, { x: "x", y1: 0, y2: "y", fill: "var(--c1)", fillOpacity: 0.3, stroke: "var(--c1)", clip: true }),
        Plot.line(outline(state.step), { x: "x", y: "depth", fill: "var(--c0)", fillOpacity: 0.12, stroke: "none" }),
        ...fronts("x", "depth"),
        chosen("x", "depth"),
      ],
    }));
  }

  function drawPlane() {
    if (!widths.plane) return;
    const down = (p) => p.depth / Math.sin(data.dip);
    // Along the mouth, which a strike turns away from z.
    const [sin, cos] = [Math.sin(data.strike), Math.cos(data.strike)];
    const along = (p) => (sin === 0 ? p.z : (p.z - data.middle[1]) * cos - (p.x - data.middle[0]) * sin);
    const all = [...outline(0), ...outline(last)];
    const fit = toScale(all.map(along), [0, ...all.map(down)], widths.plane, 380);
    const colour = (i) => `var(--s${Math.round(20 * (last ? i / last : 0.5))})`;
    show("plane", Plot.plot({
      width: widths.plane, height: fit.height, marginLeft: MARGIN.left, marginRight: MARGIN.right, marginTop: MARGIN.top, marginBottom: MARGIN.bottom,
      x: axis(sin === 0 ? "z, across the rail (mm)" : "Along the mouth (mm)", fit.x), y: axis("Down the dip (mm)", [fit.y[1], fit.y[0]]), ariaLabel: "Fronts in the plane of the crack", style,
      marks: [
        Plot.line([[fit.x[0], 0], [fit.x[1], 0]], { stroke: "var(--ink)", strokeWidth: 2 }),
        ...steps.map((_, i) => Plot.line(outline(i), { x: along, y: down, stroke: colour(i), strokeWidth: i === state.step ? 3.2 : 1.2 })),
        Plot.dot(steps[state.step].front, { x: along, y: down, r: 3, fill: "var(--ground)", stroke: "var(--ink)",
          title: (p) => `\u03c6 = ${words(p.phi)}\u00b0\nrate ${words(p.rate)} mm/cycle`, tip: { fill: "var(--ground)", fontSize: 12 } }),
        Plot.dot([steps[state.step].front[state.point]], { x: along, y: down, r: 5, fill: "var(--c4)", stroke: "var(--ink)" }),
      ],
    }));
  }

  const names = (id) => find(id).querySelector(".legends").replaceChildren(legend(MODES.map(([, name, colour]) => ({ name, colour }))));

  function drawAlong() {
    if (!widths.along) return;
    const front = steps[state.step].front;
    const now = MODES.flatMap(([name, , colour]) => {
      const values = k[state.step][name];
      const rows = front.map((p, q) => ({ phi: p.phi, k: values[q][state.position], low: d3.min(values[q]), high: d3.max(values[q]) }));
      return [
        Plot.areaY(rows, { x: "phi", y1: "low", y2: "high", fill: colour, fillOpacity: 0.12 }),
        Plot.line(rows, { x: "phi", y: "k", stroke: colour, strokeWidth: 2 }),
        Plot.dot(rows, { x: "phi", y: "k", r: 2.4, fill: colour, title: (r) => `\u03c6 = ${words(r.phi)}\u00b0\nK = ${words(r.k)} MPa\u221am\nfrom ${words(r.low)} to ${words(r.high)}`, tip: { fill: "var(--ground)", fontSize: 12 } }),
      ];
    });
    show("along", Plot.plot({
      width: widths.along, height: Math.min(380, Math.max(260, 0.6 * widths.along)), marginLeft: MARGIN.left, marginRight: MARGIN.right, marginTop: MARGIN.top, marginBottom: MARGIN.bottom,
      x: { ...scale({ title: "\u03c6 along the front (\u00b0)", scale: "linear" }), domain: [0, closed ? 360 : 180], ticks: d3.range(0, 361, 30) },
      y: scale({ title: "K (MPa\u221am)", scale: "linear" }), ariaLabel: "K along the front", style,
      marks: [
        Plot.frame({ stroke: "var(--line)" }), Plot.ruleY([0], { stroke: "var(--quiet)" }), ...now,
        Plot.ruleX([front[state.point].phi], { stroke: "var(--c4)", strokeDasharray: "4 3" }),
        closed ? null : Plot.ruleX([data.layer, 180 - data.layer], { stroke: "var(--quiet)", strokeDasharray: "2 4" }),
      ],
    }));
  }

  function drawHistory() {
    if (!widths.history) return;
    const curves = MODES.map(([name, , colour]) =>
      Plot.line(positions.map((x, i) => [x, k[state.step][name][state.point][i]]), { stroke: colour, strokeWidth: 2 }));
    show("history", Plot.plot({
      width: widths.history, height: 280, marginLeft: MARGIN.left, marginRight: MARGIN.right, marginTop: MARGIN.top, marginBottom: MARGIN.bottom,
      x: scale({ title: "Wheel position x_{c}/a", scale: "linear" }), y: scale({ title: "K (MPa\u221am)", scale: "linear" }),
      ariaLabel: "K at the chosen point of the front over the passage", style,
      marks: [Plot.frame({ stroke: "var(--line)" }), Plot.ruleY([0], { stroke: "var(--quiet)" }), ...curves, Plot.ruleX([positions[state.position]], { stroke: "var(--c4)", strokeDasharray: "4 3" })],
    }));
  }

  const DRAW = { above: drawAbove, side: drawSide, plane: drawPlane, along: drawAlong, history: drawHistory };

  function changed() {
    const [step, point] = [steps[state.step], steps[state.step].front[state.point]];
    find("step-value").textContent = `${step.step} of ${data.last_step}`;
    find("wheel-value").textContent = `${signed(positions[state.position], 2)} a, x = ${signed(centre(), 1)} mm`;
    find("front-value").textContent = `\u03c6 = ${words(point.phi)}\u00b0`;
    const now = MODES.map(([name, symbol]) => `${symbol.replace(/[_{}]/g, "")} ${signed(k[state.step][name][state.point][state.position] ?? 0, 2)}`).join(", ");
    const wanted = point.wanted === null ? "" : ` The direction criterion would kink by ${signed(point.wanted, 0)}\u00b0 there.`;
    find("readout").textContent = `Half axes ${words(step.depth)} mm down the dip and ${words(step.half_length)} mm along the surface, after ${words(step.cycles)} load cycles. `
      + `At \u03c6 = ${words(point.phi)}\u00b0: ${now} MPa\u221am; \u0394Keq ${words(point.delta_keq)} MPa\u221am, ${words(point.rate)} mm per cycle.${wanted}`;
    for (const [id, name] of [["step", "step"], ["wheel", "position"], ["front", "point"]]) find(id).value = state[name];
    for (const draw of Object.values(DRAW)) draw();
  }

  find("explorer").hidden = false;
  for (const [id, name, most] of [["step", "step", last], ["wheel", "position", count - 1], ["front", "point", steps[0].front.length - 1]]) {
    find(id).max = most;
    find(id).disabled = most === 0;
    find(id).addEventListener("input", (event) => { stop(); state[name] = +event.target.value; changed(); });
  }
  let playing = null;
  function stop() {
    if (playing !== null) cancelAnimationFrame(playing);
    playing = null;
    find("play").textContent = "Play the passage";
  }
  find("play").addEventListener("click", () => {
    if (playing !== null) return stop();
    if (state.position === count - 1) state.position = 0;
    find("play").textContent = "Stop";
    const [begun, from] = [performance.now(), state.position];
    const next = (now) => {
      state.position = Math.min(count - 1, from + Math.floor((now - begun) / 8000 * count));
      changed();
      if (state.position >= count - 1) stop();
      else playing = requestAnimationFrame(next);
    };
    playing = requestAnimationFrame(next);
  });
  names("along");
  names("history");
  changed();
  for (const [id, draw] of Object.entries(DRAW)) {
    onWidth(find(id).querySelector(".drawing"), (width) => { widths[id] = width; draw(); });
    tools(find(id));
  }
  find("explorer").dataset.ready = "true";
})().catch((reason) => {
  const note = document.createElement("p");
  note.className = "failure";
  note.textContent = `The explorer cannot be shown: ${reason.message}. It needs a browser of 2023 or later; the folder plots/ has pictures.`;
  document.getElementById("explorer").before(note);
  console.error(reason);
});

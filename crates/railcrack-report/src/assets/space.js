// The explorer of cracks in space: the crack, sliders for growth step, wheel position and point of
// its front.
"use strict";

(async () => {
  const { words, singles, legend, scale, typeset, onWidth, tools } = railcrack;
  const find = (id) => document.getElementById(id);
  const data = JSON.parse(find("space-data").textContent);
  const { wheel, positions, steps, cracks } = data;
  const MODES = [["ki", "K_{I}", "var(--c0)"], ["kii", "K_{II}", "var(--c1)"], ["kiii", "K_{III}", "var(--c2)"]];
  const count = positions.length;
  // By step, crack, mode and point of the front: K over the wheel positions.
  const of = (front, name) => Promise.all(front.map((point) => (point[name] ? singles(point[name]) : [])));
  const modes = async (crack) => Object.fromEntries(await Promise.all(MODES.map(async ([name]) => [name, await of(crack.front, name)])));
  const all = await Promise.all(steps.map((step) => Promise.all(step.cracks.map(modes))));
  const state = { step: 0, position: 0, crack: 0, point: 0 };
  const k = (step = state.step) => all[step][state.crack];
  const front = (index, crack = state.crack) => steps[index].cracks[crack].front;
  /** The deepest point of the chosen crack, and where K is largest there. */
  function choose(crack) {
    state.crack = crack;
    const points = front(0);
    state.point = d3.minIndex(points, (p) => Math.abs(p.phi - 90));
    state.position = d3.maxIndex(positions, (_, i) => Math.hypot(...MODES.map(([name]) => k(0)[name][state.point][i] ?? 0)));
  }
  choose(d3.maxIndex(cracks, (_, c) => d3.max(front(0, c), (p) => p.delta_keq)));
  const centre = () => data.origin + positions[state.position] * wheel.half_width;
  const signed = (value, digits) => value.toFixed(digits).replace(/^-(?=[0.]*$)/, "").replace("-", "\u2212");
  const widths = {};
  const style = { fontSize: "12px", overflow: "visible" };
  const show = (id, svg) => find(id).querySelector(".drawing").replaceChildren(typeset(svg));
  const closed = (crack = state.crack) => cracks[crack].buried;
  const outline = (index, crack = state.crack) => (closed(crack) ? [...front(index, crack), front(index, crack)[0]] : front(index, crack));
  const every = (draw) => cracks.flatMap((_, crack) => draw(crack));
  const everywhere = () => every((crack) => [...outline(0, crack), ...outline(last, crack)]);
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

  const weight = (crack) => (crack === state.crack ? 3 : 1.6);
  const fronts = (x, y) => every((crack) => [
    Plot.line(outline(0, crack), { x, y, stroke: "var(--quiet)", strokeDasharray: "2 3", strokeWidth: 1.6 }),
    Plot.line(outline(last, crack), { x, y, stroke: "var(--quiet)", strokeWidth: 1 }),
    Plot.line(outline(state.step, crack), { x, y, stroke: "var(--ink)", strokeWidth: weight(crack) }),
  ]);

  const chosen = (x, y) => Plot.dot([front(state.step)[state.point]], { x, y, r: 5, fill: "var(--c4)", stroke: "var(--ink)" });

  function drawAbove() {
    if (!widths.above) return;
    const xc = centre();
    const ellipse = d3.range(0, 73).map((i) => ({ x: xc + wheel.half_width * Math.cos(Math.PI * i / 36), z: wheel.lateral + wheel.lateral_half_width * Math.sin(Math.PI * i / 36) }));
    const all = everywhere();
    const wide = [wheel.lateral - wheel.lateral_half_width, wheel.lateral + wheel.lateral_half_width];
    const around = [d3.min(all, (p) => p.x) - wheel.half_width, d3.max(all, (p) => p.x) + wheel.half_width];
    const fit = toScale(around, [...all.map((p) => p.z), ...wide], widths.above, 420);
    const mouth = (crack) => (closed(crack) ? [] : [front(state.step, crack)[0], front(state.step, crack).at(-1)]);
    show("above", Plot.plot({
      width: widths.above, height: fit.height, marginLeft: MARGIN.left, marginRight: MARGIN.right, marginTop: MARGIN.top, marginBottom: MARGIN.bottom,
      x: axis("x (mm)", fit.x), y: axis("z, across the rail (mm)", fit.y), ariaLabel: "Crack from above with the contact ellipse", style,
      marks: [
        Plot.rect([0], { x1: fit.x[0], x2: fit.x[1], y1: fit.y[0], y2: fit.y[1], fill: "var(--rail)" }),
        Plot.line(ellipse, { x: "x", y: "z", fill: "var(--c1)", fillOpacity: 0.2, stroke: "var(--c1)", clip: true }),
        ...every((crack) => [
          Plot.line(outline(state.step, crack), { x: "x", y: "z", fill: "var(--c0)", fillOpacity: crack === state.crack ? 0.18 : 0.08, stroke: "none" }),
          Plot.line(mouth(crack), { x: "x", y: "z", stroke: "var(--ink)", strokeWidth: 1.4, strokeDasharray: "6 4" }),
        ]),
        ...fronts("x", "z"), chosen("x", "z"),
      ],
    }));
  }

  function drawSide() {
    if (!widths.side) return;
    const xc = centre();
    const all = everywhere();
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
        ...every((crack) => Plot.line(outline(state.step, crack), { x: "x", y: "depth", fill: "var(--c0)", fillOpacity: crack === state.crack ? 0.18 : 0.08, stroke: "none" })),
        ...fronts("x", "depth"),
        chosen("x", "depth"),
      ],
    }));
  }

  function drawPlane() {
    if (!widths.plane) return;
    const { dip, strike, middle } = cracks[state.crack];
    const down = (p) => p.depth / Math.sin(dip);
    // Along the mouth, which a strike turns away from z.
    const [sin, cos] = [Math.sin(strike), Math.cos(strike)];
    const along = (p) => (sin === 0 ? p.z : (p.z - middle[1]) * cos - (p.x - middle[0]) * sin);
    const all = [...outline(0), ...outline(last)];
    const fit = toScale(all.map(along), [0, ...all.map(down)], widths.plane, 380);
    const colour = (i) => `var(--s${Math.round(20 * (last ? i / last : 0.5))})`;
    show("plane", Plot.plot({
      width: widths.plane, height: fit.height, marginLeft: MARGIN.left, marginRight: MARGIN.right, marginTop: MARGIN.top, marginBottom: MARGIN.bottom,
      x: axis(sin === 0 ? "z, across the rail (mm)" : "Along the mouth (mm)", fit.x), y: axis("Down the dip (mm)", [fit.y[1], fit.y[0]]), ariaLabel: "Fronts in the plane of the crack", style,
      marks: [
        Plot.line([[fit.x[0], 0], [fit.x[1], 0]], { stroke: "var(--ink)", strokeWidth: 2 }),
        ...steps.map((_, i) => Plot.line(outline(i), { x: along, y: down, stroke: colour(i), strokeWidth: i === state.step ? 3.2 : 1.2 })),
        Plot.dot(front(state.step), { x: along, y: down, r: 3, fill: "var(--ground)", stroke: "var(--ink)",
          title: (p) => `\u03c6 = ${words(p.phi)}\u00b0\nrate ${words(p.rate)} mm/cycle`, tip: { fill: "var(--ground)", fontSize: 12 } }),
        Plot.dot([front(state.step)[state.point]], { x: along, y: down, r: 5, fill: "var(--c4)", stroke: "var(--ink)" }),
      ],
    }));
  }

  const names = (id) => find(id).querySelector(".legends").replaceChildren(legend(MODES.map(([, name, colour]) => ({ name, colour }))));

  function drawAlong() {
    if (!widths.along) return;
    const points = front(state.step);
    const now = MODES.flatMap(([name, , colour]) => {
      const values = k()[name];
      const rows = points.map((p, q) => ({ phi: p.phi, k: values[q][state.position], low: d3.min(values[q]), high: d3.max(values[q]) }));
      return [
        Plot.areaY(rows, { x: "phi", y1: "low", y2: "high", fill: colour, fillOpacity: 0.12 }),
        Plot.line(rows, { x: "phi", y: "k", stroke: colour, strokeWidth: 2 }),
        Plot.dot(rows, { x: "phi", y: "k", r: 2.4, fill: colour, title: (r) => `\u03c6 = ${words(r.phi)}\u00b0\nK = ${words(r.k)} MPa\u221am\nfrom ${words(r.low)} to ${words(r.high)}`, tip: { fill: "var(--ground)", fontSize: 12 } }),
      ];
    });
    show("along", Plot.plot({
      width: widths.along, height: Math.min(380, Math.max(260, 0.6 * widths.along)), marginLeft: MARGIN.left, marginRight: MARGIN.right, marginTop: MARGIN.top, marginBottom: MARGIN.bottom,
      x: { ...scale({ title: "\u03c6 along the front (\u00b0)", scale: "linear" }), domain: [0, closed() ? 360 : 180], ticks: d3.range(0, 361, 30) },
      y: scale({ title: "K (MPa\u221am)", scale: "linear" }), ariaLabel: "K along the front", style,
      marks: [
        Plot.frame({ stroke: "var(--line)" }), Plot.ruleY([0], { stroke: "var(--quiet)" }), ...now,
        Plot.ruleX([points[state.point].phi], { stroke: "var(--c4)", strokeDasharray: "4 3" }),
        closed() ? null : Plot.ruleX([data.layer, 180 - data.layer], { stroke: "var(--quiet)", strokeDasharray: "2 4" }),
      ],
    }));
  }

  function drawHistory() {
    if (!widths.history) return;
    const curves = MODES.map(([name, , colour]) =>
      Plot.line(positions.map((x, i) => [x, k()[name][state.point][i]]), { stroke: colour, strokeWidth: 2 }));
    show("history", Plot.plot({
      width: widths.history, height: 280, marginLeft: MARGIN.left, marginRight: MARGIN.right, marginTop: MARGIN.top, marginBottom: MARGIN.bottom,
      x: scale({ title: "Wheel position x_{c}/a", scale: "linear" }), y: scale({ title: "K (MPa\u221am)", scale: "linear" }),
      ariaLabel: "K at the chosen point of the front over the passage", style,
      marks: [Plot.frame({ stroke: "var(--line)" }), Plot.ruleY([0], { stroke: "var(--quiet)" }), ...curves, Plot.ruleX([positions[state.position]], { stroke: "var(--c4)", strokeDasharray: "4 3" })],
    }));
  }

  const DRAW = { above: drawAbove, side: drawSide, plane: drawPlane, along: drawAlong, history: drawHistory };

  function changed() {
    const [step, crack, point] = [steps[state.step], steps[state.step].cracks[state.crack], front(state.step)[state.point]];
    find("step-value").textContent = `${step.step} of ${data.last_step}`;
    find("wheel-value").textContent = `${signed(positions[state.position], 2)} a, x = ${signed(centre(), 1)} mm`;
    find("front-value").textContent = `\u03c6 = ${words(point.phi)}\u00b0`;
    const now = MODES.map(([name, symbol]) => `${symbol.replace(/[_{}]/g, "")} ${signed(k()[name][state.point][state.position] ?? 0, 2)}`).join(", ");
    const wanted = point.wanted === null ? "" : ` The direction criterion would kink by ${signed(point.wanted, 0)}\u00b0 there.`;
    const whose = cracks.length > 1 ? `Crack ${state.crack + 1}: half` : "Half";
    find("readout").textContent = `${whose} axes ${words(crack.depth)} mm down the dip and ${words(crack.half_length)} mm along the surface, after ${words(step.cycles)} load cycles. `
      + `At \u03c6 = ${words(point.phi)}\u00b0: ${now} MPa\u221am; \u0394Keq ${words(point.delta_keq)} MPa\u221am, ${words(point.rate)} mm per cycle.${wanted}`;
    find("front").max = front(state.step).length - 1;
    for (const [id, name] of [["step", "step"], ["wheel", "position"], ["front", "point"]]) find(id).value = state[name];
    for (const draw of Object.values(DRAW)) draw();
  }

  find("explorer").hidden = false;
  for (const [id, name, most] of [["step", "step", last], ["wheel", "position", count - 1], ["front", "point", front(0).length - 1]]) {
    find(id).max = most;
    find(id).disabled = most === 0;
    find(id).addEventListener("input", (event) => { stop(); state[name] = +event.target.value; changed(); });
  }
  const select = find("crack");
  select.replaceChildren(...cracks.map((_, crack) => new Option(`${crack + 1}`, crack, crack === state.crack, crack === state.crack)));
  select.closest("label").hidden = cracks.length < 2;
  select.addEventListener("change", () => { stop(); choose(+select.value); changed(); });
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

// The passage explorer: two sliders, the step of growth and the position of the wheel, and what follows them.
"use strict";

(async () => {
  const { words, plain, typeset, singles, quantised, unpack, legend, scale, ticks, onWidth, tools, charts } = railcrack;
  const find = (id) => document.getElementById(id);
  const data = JSON.parse(find("run-data").textContent);
  const a = data.half_width;
  const positions = data.xc_over_a;
  // The passage of the contact; a rail that bends has positions far beyond, of which the far charts have K.
  const [nearFirst, nearLast] = data.near;
  const nearDomain = () => d3.extent(windowOf(state.crack), (position) => positions[position]);
  const isNear = (position) => position >= windowOf(state.crack)[0] && position <= windowOf(state.crack)[1];
  const shown = data.steps;
  const faceStride = data.face_stride;
  // Beyond nine tips colours would repeat: then the chosen crack has one, and the others are quiet.
  const many = data.windows !== null || shown[0].tips.length > 9;
  /** The positions near a crack: of many, those that the page has of it. */
  const windowOf = (crack) => data.windows?.[crack - 1] ?? data.near;
  const crackColour = (crack) => {
    if (data.cracks.length === 1) return "var(--c0)";
    if (many) return crack === state.crack ? "var(--c0)" : "var(--quiet)";
    const first = shown[0].tips.findIndex((tip) => tip.crack === crack);
    return `var(--c${Math.max(first, 0) % 9})`;
  };
  /** Tips of one crack have colours of their own where there are enough. */
  const tipColour = (tip) => {
    if (many) return crackColour(tip.crack);
    return `var(--c${Math.max(shown[0].tips.findIndex((other) => other.crack === tip.crack && other.tip === tip.tip), 0) % 9})`;
  };
  const STATUS = ["open", "stick", "slip"];
  const STATUS_COLOURS = ["#e9ecef", "#0072b2", "#e69f00"];
  const KEPT_COLOURS = ["var(--c1)", "var(--c2)", "var(--c3)", "var(--c4)", "var(--c5)"];

  // ---- Decoding ------------------------------------------------------------------------------------------------

  const histories = await Promise.all(
    shown.map((step) =>
      Promise.all(step.tips.map(async (tip) => ({
        ki: tip.ki ? await over(tip.ki, tip.crack) : [],
        kii: tip.kii ? await over(tip.kii, tip.crack) : [],
        fluid: tip.fluid ? await Promise.all(tip.fluid.map((values) => over(values, tip.crack))) : null,
      }))),
    ),
  );
  /** Values over all positions; of one of many cracks they are those near to it. */
  async function over(packed, crack) {
    if (typeof packed === "string") return singles(packed);
    const whole = new Float64Array(positions.length).fill(NaN);
    whole.set(await quantised(packed, Infinity), windowOf(crack)[0]);
    return whole;
  }

  const decoded = new Map();

  /** The faces of a shown step, by crack. */
  function facesOf(index) {
    if (!decoded.has(index)) decoded.set(index, Promise.all((shown[index].faces ?? []).map(decodeFaces)));
    return decoded.get(index);
  }

  async function decodeFaces(faces) {
    const s = await singles(faces.s);
    const status = await unpack(faces.status);
    const row = status.length / s.length;
    const [opening, slip, pressure, shear] = await Promise.all(
      [faces.opening, faces.slip, faces.pressure, faces.shear].map((values) => quantised(values, row)),
    );
    return { crack: faces.crack, first: faces.first ?? 0, s, row, status, opening, slip, pressure, shear };
  }

  /** The place among the stored positions of the faces that is nearest to a position. */
  function faceColumn(faces, position) {
    if (position === positions.length - 1) return faces.row - 1;
    return Math.max(0, Math.min(Math.round((position - faces.first) / faceStride), faces.row - 1));
  }

  // ---- State ---------------------------------------------------------------------------------------------------

  const first = data.named?.[0] ?? 1;
  const state = { step: 0, position: loudest(0, many ? first : null), crack: first, kept: shown.length > 1 ? [shown.length - 1] : [] };

  /** The position with the largest |K| of a step, of one crack or of all. */
  function loudest(index, crack) {
    let [most, at] = [-1, 0];
    for (const { ki, kii } of histories[index].filter((_, i) => crack === null || shown[index].tips[i].crack === crack))
      for (let i = 0; i < ki.length; i++) {
        const size = Math.hypot(ki[i], kii[i]);
        if (size > most) [most, at] = [size, i];
      }
    return at;
  }

  const centre = () => data.origin + positions[state.position] * a;
  /** Fixed decimals, a true minus sign, no "\u22120.0". */
  const signed = (value, digits) => value.toFixed(digits).replace(/^-(?=[0.]*$)/, "").replace("-", "\u2212");

  /** Sets the text of an element, `K_{I}` with a lowered index. */
  function say(id, text) {
    const parts = text.split(/_\{([^}]*)\}/);
    find(id).replaceChildren(...parts.map((part, i) => {
      if (i % 2 === 0) return part;
      const index = document.createElement("sub");
      index.textContent = part;
      return index;
    }));
  }

  /** Pressure and volume of the fluid in a crack at the chosen step and position; null of a dry one. */
  function fluidOf(crack) {
    const tip = shown[state.step].tips.findIndex((tip) => tip.crack === crack);
    const fluid = tip < 0 ? null : histories[state.step][tip].fluid;
    return fluid && { pressure: fluid[0][state.position], volume: fluid[1][state.position] };
  }
  /** The largest pressure of fluid in the run. */
  const mostPressure = d3.max(histories.flat().flatMap(({ fluid }) => (fluid ? Array.from(fluid[0]) : []))) ?? 0;
  const isWet = histories.flat().some(({ fluid }) => fluid);
  const tension = (fluid) => (fluid && mostPressure > 0 ? Math.max(fluid.pressure, 0) / mostPressure : 0);

  // ---- Geometry ------------------------------------------------------------------------------------------------

  const polyline = (crack, index) => {
    if (shown[index].lines) return shown[index].lines[crack - 1];
    const [from, to] = shown[index].cracks[crack - 1];
    return data.cracks[crack - 1].points.slice(from, to + 1);
  };

  /** Point, tangent and normal (x2, the tangent turned by +90°) at the arc length `s`. */
  function frame(points, s) {
    let rest = s;
    for (let i = 0; i + 1 < points.length; i++) {
      const [dx, dy] = [points[i + 1][0] - points[i][0], points[i + 1][1] - points[i][1]];
      const length = Math.hypot(dx, dy);
      if (rest <= length || i + 2 === points.length) {
        const t = [dx / length, dy / length];
        return { at: [points[i][0] + rest * t[0], points[i][1] + rest * t[1]], t, n: [-t[1], t[0]] };
      }
      rest -= length;
    }
    return { at: points[0], t: [1, 0], n: [0, 1] };
  }

  const everyPoint = [...data.cracks.flatMap((crack) => crack.points), ...data.pieces.flatMap((piece) => piece.outline), ...shown.flatMap((step) => (step.lines ?? []).flat())];

  // ---- Drawing -------------------------------------------------------------------------------------------------

  const widths = {};
  const show = (id, svg) => find(id).querySelector(".drawing").replaceChildren(typeset(svg));
  const style = { fontSize: "12px", overflow: "visible" };

  /** The part of the rail on the picture of the paths: of many cracks, the surroundings of the chosen one. */
  function viewOf(points, least) {
    const [left, right] = d3.extent(points, (p) => p[0]);
    const deepest = -d3.min(points, (p) => p[1]);
    const beside = Math.max(least, 0.12 * (right - left));
    const across = right - left + 2 * beside;
    return { x: [left - beside, right + beside], load: 0.1 * across, depth: Math.max(1.15 * deepest, 0.16 * across) };
  }
  const wholeView = viewOf(everyPoint, 1.4 * a);
  const pathOf = (crack) => shown[state.step].whole?.[crack - 1] ?? data.cracks[crack - 1].points;
  const viewNow = () => (data.windows ? viewOf(pathOf(state.crack), 2.2 * a) : wholeView);
  const sceneMargin = { top: 6, right: 14, bottom: 40, left: 56 };
  const MOST_HEIGHT = 520;

  /** Size of the picture of the paths, and what it shows, at one scale both ways. */
  function sceneSize(width) {
    const view = viewNow();
    const inside = width - sceneMargin.left - sceneMargin.right;
    let x = view.x;
    const y = view.depth + 1.75 * view.load;
    let perMm = inside / (x[1] - x[0]);
    if (perMm * y > MOST_HEIGHT) {
      perMm = MOST_HEIGHT / y;
      const middle = 0.5 * (x[0] + x[1]);
      x = [middle - 0.5 * inside / perMm, middle + 0.5 * inside / perMm];
    }
    return { x, y: [view.depth, -1.75 * view.load], height: Math.round(perMm * y) + sceneMargin.top + sceneMargin.bottom };
  }

  const depthAxis = (domain, label) => ({ ...scale({ title: label, scale: "linear" }), domain });

  function drawScene() {
    if (!widths.scene) return;
    const { x, y, height } = sceneSize(widths.scene);
    const view = viewNow();
    const isSeen = (points) => !many || (d3.max(points, (p) => p[0]) >= x[0] && d3.min(points, (p) => p[0]) <= x[1]);
    const xc = centre();
    // Closer together at the edges, where the pressure rises steeply.
    const pressure = d3.range(0, 61).map((i) => ({ x: xc - a * Math.cos(Math.PI * i / 60), y: -view.load * Math.sin(Math.PI * i / 60) }));
    const away = xc + a < x[0] ? -1 : xc - a > x[1] ? 1 : 0;
    const mu = data.friction ?? 0;
    const reach = 0.6 * a;
    const from = Math.min(Math.max(xc, x[0] + (mu < 0 ? reach : 0)), x[1] - (mu > 0 ? reach : 0));
    const arrow = { x1: from, x2: from + Math.sign(mu) * reach, y: -1.12 * view.load };
    const name = data.peak_pressure ? `p_{0} = ${words(data.peak_pressure)} MPa` : "wheel";
    const label = mu ? `${name}, friction ${signed(mu, 3).replace(/0+$/, "")}` : name;
    const marks = [
      Plot.rect([0], { x1: x[0], x2: x[1], y1: 0, y2: y[0], fill: "var(--rail)" }),
      Plot.line([[x[0], 0], [x[1], 0]], { stroke: "var(--ink)", strokeWidth: 2 }),
    ];
    const now = shown[state.step].step;
    // What a step encloses is there at the start of the next one; of the last step, at its end.
    const isThere = ({ step }) => now >= step || now === data.last_step;
    const allPieces = data.pieces.filter(isThere);
    const pieces = allPieces.filter(({ outline }) => isSeen(outline));
    for (const { outline, area, kind, crack } of pieces) {
      const corners = [...outline, outline[0]].map(([px, py]) => [px, -py]);
      marks.push(Plot.line(corners, { fill: "var(--c4)", fillOpacity: 0.3, stroke: "var(--c4)", strokeDasharray: "4 3", className: "piece", clip: many }));
      const middle = d3.polygonCentroid(corners);
      if (middle[0] < x[0] || middle[0] > x[1]) continue;
      marks.push(Plot.dot([middle], { r: 7, fill: "transparent", tip: { fill: "var(--ground)", fontSize: 12 },
        title: () => `${kind} at crack ${crack}\n${words(area)} mm\u00b2` }));
      marks.push(Plot.text([`${kind} ${words(area)} mm\u00b2`], { x: middle[0], y: middle[1], fill: "var(--ink)", stroke: "var(--rail)", strokeWidth: 4 }));
    }
    data.cracks.forEach((crack, i) => {
      const depths = (points) => points.map(([px, py]) => [px, -py]);
      const whole = shown[state.step].whole ? shown[state.step].whole[i] : crack.points;
      if (!isSeen(whole)) return;
      marks.push(Plot.line(depths(whole), { stroke: crackColour(i + 1), strokeWidth: 1.6, strokeDasharray: "2 3", clip: many }));
      const now = polyline(i + 1, state.step);
      marks.push(Plot.line(depths(now), { stroke: data.cracks.length === 1 ? "var(--ink)" : crackColour(i + 1), strokeWidth: 3, clip: many }));
    });
    if (isWet) marks.push(...data.cracks.flatMap((_, i) => fluidIn(i + 1)));
    marks.push(Plot.dot(shown[state.step].tips.filter((tip) => !many || (tip.x > x[0] && tip.x < x[1] && -tip.y < y[0])), {
      x: "x", y: (tip) => -tip.y, r: 4, fill: "var(--ground)", stroke: "var(--ink)", strokeWidth: 1.5,
      channels: { crack: "crack", length: "length" },
      title: (tip) => `crack ${tip.crack}, tip ${tip.tip}\nx = ${words(tip.x)} mm, depth ${words(-tip.y)} mm\nlength ${words(tip.length)} mm`,
      tip: { fill: "var(--ground)", fontSize: 12 },
    }));
    marks.push(Plot.dot(data.junctions.filter((junction) => isThere(junction) && isSeen([[junction.x, junction.y]])), {
      x: "x", y: (junction) => -junction.y, r: 5, symbol: "diamond", fill: "var(--ink)",
      title: ({ crack, onto, x, y }) => `crack ${crack} has joined crack ${onto}\nx = ${words(x)} mm, depth ${words(-y)} mm`,
      tip: { fill: "var(--ground)", fontSize: 12 },
    }));
    if (!away) {
      marks.push(Plot.areaY(pressure, { x: "x", y1: 0, y2: "y", fill: "var(--c1)", fillOpacity: 0.3, stroke: "var(--c1)", clip: true }));
      marks.push(Plot.ruleX([xc], { y1: 0, y2: -view.load, stroke: "var(--c1)", strokeDasharray: "3 3" }));
      if (mu) marks.push(Plot.arrow([arrow], { x1: "x1", x2: "x2", y1: "y", y2: "y", stroke: "var(--c1)", strokeWidth: 2, headLength: 9, clip: true }));
      // The label ends within the picture: half its width, from the usual one of letters.
      const perMm = (widths.scene - sceneMargin.left - sceneMargin.right) / (x[1] - x[0]);
      const half = Math.min(3.5 * plain(label).length / perMm, 0.5 * (x[1] - x[0]));
      const middle = Math.min(Math.max(xc, x[0] + half), x[1] - half);
      // Above the arrow by the height of the letters, whatever the scale.
      marks.push(Plot.text([label], { x: middle, y: arrow.y, dy: mu ? -13 : -6, fill: "var(--c1)" }));
    } else {
      marks.push(Plot.text([away < 0 ? `\u2190 wheel at x = ${signed(xc, 1)} mm` : `wheel at x = ${signed(xc, 1)} mm \u2192`], {
        x: away < 0 ? x[0] : x[1], y: -0.6 * view.load, dx: -8 * away, textAnchor: away < 0 ? "start" : "end", fill: "var(--c1)",
      }));
    }
    const svg = Plot.plot({
      width: widths.scene, height,
      marginTop: sceneMargin.top, marginRight: sceneMargin.right, marginBottom: sceneMargin.bottom, marginLeft: sceneMargin.left,
      x: { ...scale({ title: "x (mm)", scale: "linear" }), domain: x, grid: false },
      y: { ...depthAxis(y, "Depth (mm)"), grid: false, ticks: d3.ticks(0, y[0], Math.max(2, Math.round((height - 60) / 55))) },
      ariaLabel: "Cracks to scale below the wheel", style, marks,
    });
    svg.dataset.centre = xc;
    if (isWet) svg.dataset.fluid = data.cracks.map((_, i) => fluidOf(i + 1)?.pressure ?? 0).join(" ");
    svg.dataset.pieces = allPieces.length;
    show("scene", svg);
  }

  /** The fluid in a crack: the stronger its colour, the higher its pressure. */
  function fluidIn(crack) {
    const fluid = fluidOf(crack);
    const share = tension(fluid);
    if (!(share > 0)) return [];
    const points = polyline(crack, state.step);
    const length = d3.sum(d3.pairs(points, (p, q) => Math.hypot(q[0] - p[0], q[1] - p[1])));
    const parts = data.fluid_falls ? 24 : 1;
    const place = (s) => { const { at } = frame(points, s); return [at[0], -at[1]]; };
    const part = (k) => {
      // With the kinks of the crack between the ends of the part.
      const line = parts === 1 ? points.map(([px, py]) => [px, -py]) : [place(k * length / parts), place((k + 1) * length / parts)];
      const here = data.fluid_falls ? share * (1 - (k + 0.5) / parts) : share;
      return Plot.line(line, { stroke: "var(--c5)", strokeWidth: 4 + 5 * here, strokeOpacity: 0.15 + 0.85 * here, strokeLinecap: "round", className: "fluid" });
    };
    return d3.range(parts).map(part);
  }

  function drawResidual() {
    if (!data.residual || !widths.scene) return;
    const { y, height } = sceneSize(widths.scene);
    const rows = data.residual.depth.map((depth, i) => ({ depth, sxx: data.residual.sxx[i] }));
    // Zero beyond the last row, as the computation takes it.
    const last = rows[rows.length - 1];
    if (last.depth < y[0]) rows.push({ depth: last.depth, sxx: 0 }, { depth: y[0], sxx: 0 });
    const svg = Plot.plot({
      width: 240, height, marginTop: sceneMargin.top, marginBottom: sceneMargin.bottom, marginLeft: 12, marginRight: 12,
      x: { ...scale({ title: "\u03c3_{xx} (MPa)", scale: "linear" }), ticks: 3, nice: true },
      y: { domain: y, axis: null },
      ariaLabel: "Residual stress by depth, beside the cracks at the same scale", style,
      marks: [
        Plot.rect([0], { x1: d3.min(rows, (r) => r.sxx), x2: d3.max(rows, (r) => r.sxx), y1: 0, y2: y[0], fill: "var(--rail)" }),
        Plot.ruleX([0], { y1: 0, y2: y[0], stroke: "var(--quiet)" }),
        Plot.line(rows, { x: "sxx", y: "depth", stroke: "var(--c0)", strokeWidth: 1.8, clip: true }),
        Plot.tip(rows.filter((r) => r.depth <= y[0]), Plot.pointerY({ x: "sxx", y: "depth", fill: "var(--ground)", fontSize: 12,
          title: (r) => `depth ${words(r.depth)} mm\n\u03c3xx = ${words(r.sxx)} MPa` })),
      ],
    });
    show("residual", svg);
  }

  /** Curves of a K chart: this step, and those that are kept. */
  function kCurves(mode) {
    const several = shown[0].tips.length > 1;
    const curve = (index, colour, dashed, name) =>
      shown[index].tips.map((tip, i) => ({
        name: several ? `${tipName(tip)}, step ${shown[index].step}` : name,
        colour: several ? tipColour(tip) : colour,
        dashed,
        tip,
        step: shown[index].step,
        first: windowOf(tip.crack)[0],
        points: Array.from(histories[index][i][mode], (k, p) => ({ x: positions[p], k, at: p })).slice(windowOf(tip.crack)[0], windowOf(tip.crack)[1] + 1),
      }));
    const kept = state.kept.filter((index) => index !== state.step);
    const curves = [
      ...kept.flatMap((index, i) => curve(index, KEPT_COLOURS[i % KEPT_COLOURS.length], true, `step ${shown[index].step}`)),
      ...curve(state.step, "var(--c0)", false, `step ${shown[state.step].step}`),
    ];
    if (!many) return curves;
    // Of the quiet cracks this step only, below the chosen one.
    const isChosen = (curve) => curve.tip.crack === state.crack;
    const [from, to] = nearDomain();
    const meets = ({ points }) => points.length && d3.max(points, (p) => p.x) >= from && d3.min(points, (p) => p.x) <= to;
    return [...curves.filter((curve) => !isChosen(curve) && !curve.dashed && meets(curve)), ...curves.filter(isChosen)];
  }

  const tipName = (tip) => (shown[0].tips.some((other) => other.tip > 1) ? `crack ${tip.crack}, tip ${tip.tip}` : `crack ${tip.crack}`);

  /** The same scale in all steps, so that steps compare. */
  const extents = Object.fromEntries(["ki", "kii"].map((mode) => {
    const [low, high] = d3.extent(histories.flat().flatMap((tip) => Array.from(tip[mode])));
    const air = 0.05 * ((high - low) || 1);
    return [mode, [Math.min(low, 0) - air, Math.max(high, 0) + air]];
  }));
  // A K_I that is hardly there gets the scale of something, not that of noise.
  const largest = d3.max(Object.values(extents).flat(), Math.abs);
  if (extents.ki[1] - extents.ki[0] < 0.1 * largest) extents.ki = [-0.01 * largest, 0.1 * largest];

  const kCharts = {};

  function drawK(mode) {
    const width = widths[mode];
    if (!width) return;
    const name = mode === "ki" ? "K_{I}" : "K_{II}";
    const curves = kCurves(mode);
    const [from, to] = nearDomain();
    const all = curves.flatMap(({ points, name }) => points.map((point) => ({ ...point, name }))).filter(({ x }) => !many || (x >= from && x <= to));
    const svg = Plot.plot({
      width, height: 300, marginLeft: 56, marginBottom: 44, marginTop: 10,
      x: { ...scale({ title: "Wheel position x_{c}/a", scale: "linear" }), domain: nearDomain() },
      y: { ...scale({ title: `${name} (MPa\u221am)`, scale: "linear" }), domain: extents[mode] },
      ariaLabel: `${mode === "ki" ? "K I" : "K II"} against the wheel position`, style,
      marks: [
        Plot.frame({ stroke: "var(--line)" }),
        Plot.ruleY([0], { stroke: "var(--quiet)" }),
        ...curves.map(({ points, colour, dashed }) => Plot.line(points, { x: "x", y: "k", stroke: colour, strokeOpacity: colour === "var(--quiet)" ? 0.45 : 1,
          strokeWidth: dashed ? 1.4 : colour === "var(--quiet)" ? 1 : 2.2, strokeDasharray: dashed ? "5 4" : null, clip: many })),
        Plot.tip(all, Plot.pointer({ x: "x", y: "k", fill: "var(--ground)", fontSize: 12,
          title: (d) => `${d.name}\nx_c/a = ${words(d.x)}\n${mode === "ki" ? "K_I" : "K_II"} = ${words(d.k)} MPa\u221am` })),
      ],
    });
    show(mode, svg);
    const chosen = many ? curves.filter((curve) => curve.tip.crack === state.crack) : curves;
    const others = many ? [{ name: "other cracks", colour: "var(--quiet)" }] : [];
    // Of several tips the colours are explained once, and a kept step by its dashes.
    const now = shown[state.step].step;
    const tips = chosen.filter((curve) => !curve.dashed).map((curve) => ({ ...curve, name: tipName(curve.tip) }));
    const entries = shown[0].tips.length > 1
      ? [...tips, ...others, ...[...new Set(chosen.filter((curve) => curve.dashed).map((curve) => curve.step))]
        .map((step) => ({ name: `step ${step}`, colour: "var(--quiet)", dashed: true })), { name: `step ${now}`, colour: "var(--quiet)" }]
      : chosen;
    find(mode).querySelector(".legends").replaceChildren(legend(entries));
    kCharts[mode] = { svg, curves: chosen.filter((curve) => !curve.dashed) };
    markK(mode);
  }

  /** Puts the wheel on a K chart: a line, and a ring on each curve of this step. */
  function markK(mode) {
    const chart = kCharts[mode];
    if (!chart) return;
    const [x, y] = ["x", "y"].map((name) => chart.svg.scale(name));
    const at = x.apply(positions[state.position]);
    if (!isNear(state.position)) {
      d3.select(chart.svg).selectAll("g.marks").remove();
      return;
    }
    const group = d3.select(chart.svg).selectAll("g.marks").data([0]).join("g").attr("class", "marks").attr("pointer-events", "none");
    group.selectAll("line").data([at]).join("line").attr("x1", at).attr("x2", at)
      .attr("y1", y.range[0]).attr("y2", y.range[1]).attr("stroke", "var(--c1)").attr("stroke-dasharray", "3 3");
    group.selectAll("circle").data(chart.curves).join("circle").attr("cx", at)
      .attr("cy", (curve) => y.apply(curve.points[state.position - curve.first]?.k ?? 0))
      .attr("data-x", positions[state.position]).attr("data-y", (curve) => curve.points[state.position - curve.first]?.k)
      .attr("r", 5).attr("fill", "var(--ground)").attr("stroke", (curve) => curve.colour).attr("stroke-width", 2.5);
  }

  /** 1, 2 or 5 times a power of ten, at most `value`. */
  const roundDown = (value) => {
    const decade = 10 ** Math.floor(Math.log10(value));
    return (value / decade >= 5 ? 5 : value / decade >= 2 ? 2 : 1) * decade;
  };

  function drawDeformed(faces) {
    if (!widths.deformed) return;
    if (!faces) {
      const some = data.named ? ` This page has those of cracks ${d3.sort(data.named).join(", ")} in growth steps ${shown.filter((step) => step.faces).map(({ step }) => step).join(" and ")}; faces.csv has more.` : "";
      find("deformed").querySelector(".drawing").replaceChildren(`No data of the crack faces in this step.${some}`);
      for (const part of [".legends", "figcaption"]) find("deformed").querySelector(part).replaceChildren();
      return;
    }
    const points = polyline(faces.crack, state.step);
    const column = faceColumn(faces, state.position);
    const length = d3.sum(d3.pairs(points, (p, q) => Math.hypot(q[0] - p[0], q[1] - p[1])));
    // One magnification for the whole passage, so that its pictures compare.
    const most = d3.max(faces.opening, (v, i) => Math.hypot(v, faces.slip[i])) || 0;
    const magnified = most > 0 ? roundDown(0.07 * length / most) : 1;
    const buried = points[0][1] < -1e-9;
    const jump = (i) => [faces.slip[i * faces.row + column], faces.opening[i * faces.row + column]];
    const stations = Array.from(faces.s, (s, i) => ({ s, jump: jump(i), status: faces.status[i * faces.row + column] }));
    // The jump ends at a tip; at a mouth it goes on.
    if (stations[0].s > 0) stations.unshift({ s: 0, jump: buried ? [0, 0] : stations[0].jump });
    if (stations[stations.length - 1].s < length) stations.push({ s: length, jump: [0, 0] });
    const face = (side) => stations.map(({ s, jump: [slip, opening] }) => {
      const { at, t, n } = frame(points, s);
      const move = 0.5 * side * magnified;
      return [at[0] + move * (slip * t[0] + opening * n[0]), -(at[1] + move * (slip * t[1] + opening * n[1]))];
    });
    const [plus, minus] = [face(1), face(-1)];
    const fluid = fluidOf(faces.crack);
    const contact = stations.filter(({ status }) => status > 0).map(({ s, status }) => ({ p: frame(points, s).at, status, s }));
    const [left, right] = d3.extent(points, (p) => p[0]);
    const bottom = -d3.min(points, (p) => p[1]);
    const top = buried ? -d3.max(points, (p) => p[1]) : 0;
    const air = 0.09 * length;
    const margins = sceneMargin.left + sceneMargin.right;
    let x = [left - air, right + air];
    const y = [bottom + air, buried ? Math.max(top - air, -air) : -air];
    let perMm = (widths.deformed - margins) / (x[1] - x[0]);
    if (perMm * (y[0] - y[1]) > 400) {
      perMm = 400 / (y[0] - y[1]);
      const half = 0.5 * (widths.deformed - margins) / perMm;
      x = [0.5 * (left + right) - half, 0.5 * (left + right) + half];
    }
    const height = Math.round(perMm * (y[0] - y[1])) + 46;
    const surface = y[1] < 0 ? 0 : y[1];
    const svg = Plot.plot({
      width: widths.deformed, height, marginTop: 6, marginRight: sceneMargin.right, marginBottom: 40, marginLeft: sceneMargin.left,
      x: { ...scale({ title: "x (mm)", scale: "linear" }), domain: x, grid: false },
      y: { ...depthAxis(y, "Depth (mm)"), grid: false, ticks: d3.ticks(Math.max(0, y[1]), y[0], Math.max(2, Math.round(height / 60))) },
      ariaLabel: "Deformed crack", style,
      marks: [
        Plot.rect([0], { x1: x[0], x2: x[1], y1: surface, y2: y[0], fill: "var(--rail)" }),
        Plot.line([...plus, ...[...minus].reverse()], { fill: "var(--ground)", stroke: "none" }),
        fluid ? Plot.line([...plus, ...[...minus].reverse()], { fill: "var(--c5)", fillOpacity: 0.15 + 0.85 * tension(fluid), stroke: "none", className: "fluid" }) : null,
        buried ? null : Plot.line([[x[0], 0], [x[1], 0]], { stroke: "var(--ink)", strokeWidth: 1.5 }),
        Plot.line(points.map(([px, py]) => [px, -py]), { stroke: "var(--quiet)", strokeDasharray: "2 3" }),
        Plot.line(plus, { stroke: "var(--c0)", strokeWidth: 2.2 }),
        Plot.line(minus, { stroke: "var(--c1)", strokeWidth: 2.2 }),
        Plot.dot(contact, { x: (d) => d.p[0], y: (d) => -d.p[1], r: 3.5, symbol: (d) => (d.status === 1 ? "square" : "diamond"),
          fill: (d) => STATUS_COLOURS[d.status], stroke: "var(--ground)", strokeWidth: 0.8 }),
      ],
      symbol: { range: ["square", "diamond"], type: "identity" },
      color: { type: "identity" },
    });
    show("deformed", svg);
    find("deformed").querySelector(".legends").replaceChildren(legend([
      { name: "+ face", colour: "var(--c0)" },
      { name: "\u2212 face", colour: "var(--c1)" },
      { name: "undeformed", colour: "var(--quiet)", dashed: true },
      { name: "stick", colour: STATUS_COLOURS[1], dots: "only" },
      { name: "slip", colour: STATUS_COLOURS[2], dots: "only" },
      ...(fluid ? [{ name: "fluid, the stronger the higher its pressure", colour: "var(--c5)" }] : []),
    ]));
    const openings = stations.map(({ jump }) => jump[1]);
    const slips = stations.map(({ jump }) => Math.abs(jump[0]));
    find("deformed-caption").textContent =
      `Crack ${faces.crack}. Displacement jump magnified ${words(magnified)} times, half of it drawn on each face. ` +
      `At this position the largest opening is ${microns(d3.max(openings))}, the largest slip ${microns(d3.max(slips))}` +
      `${fluid ? `, and the pressure of the fluid ${signed(fluid.pressure, 1)} MPa${data.fluid_falls ? " at the mouth" : ""}` : ""}.`;
  }

  // ---- Face maps -----------------------------------------------------------------------------------------------

  const maps = {};

  /** An image of the faces: a pixel for each stored position, rows even in arc length. */
  function mapImage(faces, length, colour) {
    const rows = 240;
    const [from, to] = nearColumns(faces);
    const across = to - from + 1;
    const canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = [across, rows];
    const context = canvas.getContext("2d");
    const image = context.createImageData(across, rows);
    const backwards = positions[0] > positions[positions.length - 1];
    for (let j = 0; j < rows; j++) {
      // The top row is the largest arc length.
      const point = nearestPoint(faces, length * (rows - 0.5 - j) / rows);
      for (let i = 0; i < across; i++) {
        const { r, g, b } = colour(point * faces.row + (backwards ? to - i : from + i));
        image.data.set([r, g, b, 255], 4 * (j * across + i));
      }
    }
    context.putImageData(image, 0, 0);
    return canvas.toDataURL("image/png");
  }

  /** The first and the last column of the faces within the passage of the contact. */
  const nearColumns = (faces) => (data.windows ? [0, faces.row - 1] : [Math.ceil(nearFirst / faceStride), faceColumn(faces, nearLast)]);

  /** A jump in micrometres: hundredths are known, no more. */
  const microns = (mm) => `${signed(1e3 * mm, 2)} \u00b5m`;

  const nearestPoint = (faces, s) => {
    const right = Math.min(d3.bisectLeft(faces.s, s), faces.s.length - 1);
    const left = Math.max(right - 1, 0);
    return s - faces.s[left] < faces.s[right] - s ? left : right;
  };

  function drawMap(id, faces, colour, ariaLabel) {
    const width = widths[id];
    if (!width || !faces) return;
    const length = d3.sum(d3.pairs(polyline(faces.crack, state.step), (p, q) => Math.hypot(q[0] - p[0], q[1] - p[1])));
    const url = mapImage(faces, length, colour);
    const image = (index, { x, y }) => {
      const [left, right] = nearDomain().map(x);
      return d3.create("svg:image").attr("href", url).attr("x", left).attr("y", y(length)).attr("width", right - left)
        .attr("height", y(0) - y(length)).attr("preserveAspectRatio", "none").attr("style", "image-rendering: pixelated").node();
    };
    const svg = Plot.plot({
      width, height: 250, marginLeft: 56, marginBottom: 44, marginTop: 8,
      x: { ...scale({ title: "Wheel position x_{c}/a", scale: "linear" }), domain: nearDomain(), grid: false },
      y: { ...scale({ title: "Arc length s (mm)", scale: "linear" }), domain: [0, length], grid: false },
      ariaLabel, style, marks: [image, Plot.frame({ stroke: "var(--line)" })],
    });
    show(id, svg);
    maps[id] = { svg, faces };
    const place = (event) => {
      const [px, py] = d3.pointer(event, svg);
      const [x, y] = [svg.scale("x").invert(px), svg.scale("y").invert(py)];
      if (!(y >= 0 && y <= length)) return null;
      return { position: d3.leastIndex(positions, (p) => Math.abs(p - x)), point: nearestPoint(faces, y) };
    };
    svg.style.cursor = "crosshair";
    svg.addEventListener("pointermove", (event) => {
      const there = place(event);
      if (there) say("face-value", faceText(faces, there.position, there.point));
    });
    svg.addEventListener("click", (event) => {
      const there = place(event);
      if (there) moveTo({ position: there.position });
    });
    markMap(id);
  }

  function faceText(faces, position, point) {
    const column = faceColumn(faces, position);
    const at = point * faces.row + column;
    return `x_{c}/a = ${signed(positions[position], 3)}, s = ${words(faces.s[point])} mm: ${STATUS[faces.status[at]]}, ` +
      `pressure ${words(faces.pressure[at])} MPa, shear ${words(faces.shear[at])} MPa, ` +
      `opening ${microns(faces.opening[at])}, slip ${microns(faces.slip[at])}`;
  }

  function markMap(id) {
    const map = maps[id];
    if (!map) return;
    const [x, y] = ["x", "y"].map((name) => map.svg.scale(name));
    const at = x.apply(positions[state.position]);
    d3.select(map.svg).selectAll("line.here").data(isNear(state.position) ? [at] : []).join("line").attr("class", "here").attr("pointer-events", "none")
      .attr("x1", at).attr("x2", at).attr("y1", y.range[0]).attr("y2", y.range[1])
      .attr("data-x", positions[state.position]).attr("stroke", "#d55e00").attr("stroke-width", 2);
  }

  const statusRgb = STATUS_COLOURS.map((colour) => d3.rgb(colour));
  const pressureColour = (part) => d3.rgb(d3.interpolateViridis(1 - part));

  function drawMaps(faces) {
    find("face-value").hidden = !faces;
    if (!faces) {
      for (const id of ["face-status", "face-pressure"]) {
        delete maps[id];
        for (const part of [".legends", ".drawing"]) find(id).querySelector(part).replaceChildren();
      }
      return;
    }
    drawMap("face-status", faces, (at) => statusRgb[faces.status[at]], "Status of the crack faces");
    find("face-status").querySelector(".legends").replaceChildren(
      legend(STATUS.map((name, i) => ({ name, colour: STATUS_COLOURS[i], box: true }))),
    );
    const most = d3.max(faces.pressure) || 1;
    const table = d3.range(256).map((i) => pressureColour(i / 255));
    drawMap("face-pressure", faces, (at) =>
      faces.status[at] === 0 ? statusRgb[0] : table[Math.max(0, Math.min(255, Math.round(255 * faces.pressure[at] / most)))],
      "Contact pressure on the crack faces");
    find("face-pressure").querySelector(".legends").replaceChildren(legend([
      { name: "open", colour: STATUS_COLOURS[0], box: true },
      { name: `pressure, 0 to ${words(most)} MPa`, colours: d3.range(9).map((i) => pressureColour(i / 8).formatHex()) },
    ]));
  }

  // ---- Everything that follows the sliders -----------------------------------------------------------------------

  let asked = 0;

  async function stepChanged() {
    const turn = ++asked;
    const all = await facesOf(state.step);
    // A later step has been asked for meanwhile.
    if (turn !== asked) return;
    state.faces = all.find((faces) => faces.crack === state.crack) ?? null;
    for (const mode of ["ki", "kii"]) drawK(mode);
    drawMaps(state.faces);
    for (const tip of shown[state.step].tips) tip.name = tipName(tip);
    const tips = shown[state.step].tips;
    const marked = data.windows ? tips.filter((tip) => tip.crack === state.crack) : tips;
    charts.get("length-cycles")?.mark(marked.map((tip) => ({ x: tip.cycles, y: tip.length })));
    charts.get("rate-length")?.mark(marked.map((tip) => ({ x: tip.length, y: tip.rate })));
    positionChanged();
  }

  function positionChanged() {
    drawScene();
    for (const mode of ["ki", "kii"]) markK(mode);
    drawDeformed(state.faces);
    for (const id of ["face-status", "face-pressure"]) markMap(id);
    labels();
  }

  function labels() {
    const step = shown[state.step];
    const tip = step.tips.find((tip) => tip.crack === state.crack) ?? step.tips[0];
    const tonnes = data.axle_load ? `, ${words(tip.cycles * data.axle_load / 1e6)} MGT` : "";
    const stepText = `${step.step} of ${data.last_step}: ${data.cracks.length > 1 ? `crack ${tip.crack} ` : ""}${signed(tip.length, 2)} mm, ${words(tip.cycles)} cycles${tonnes}`;
    const wheelText = `x_{c}/a = ${signed(positions[state.position], 3)} (x_{c} = ${signed(centre(), 2)} mm)`;
    find("step-value").textContent = stepText;
    say("wheel-value", wheelText);
    find("crack").value = state.crack;
    find("step").value = state.step;
    find("wheel").value = state.position;
    find("step").setAttribute("aria-valuetext", `step ${stepText}`);
    find("wheel").setAttribute("aria-valuetext", plain(wheelText));
    const name = (tip) => (data.cracks.length > 1 || step.tips.length > 1 ? tipName(tip) : "");
    const k = step.tips.map((tip, i) => {
      const { ki, kii } = histories[state.step][i];
      const fluid = fluidOf(tip.crack);
      const wet = fluid ? `, fluid p = ${signed(fluid.pressure, 1)} MPa, V = ${words(fluid.volume)} mm\u00b2` : "";
      if (Number.isNaN(ki[state.position])) return `${name(tip)}: the wheel is too far away for K`;
      return `${name(tip) && `${name(tip)}: `}K_{I} = ${signed(ki[state.position] ?? 0, 3)}, K_{II} = ${signed(kii[state.position] ?? 0, 3)} MPa\u221am${wet}`;
    });
    const shownK = k.length <= 4 ? k.join("; ") : k[Math.max(0, step.tips.indexOf(tip))];
    const whose = name(tip) || "the crack";
    const direction = tip.kink === null ? `${whose} is not loaded and does not kink` : `${whose} kinks by ${signed(tip.kink, 1)}\u00b0 at the end of the step`;
    const rival = tip.rival === null ? "" : ` (secondary maximum at ${signed(tip.rival, 1)}\u00b0, ${signed(tip.ratio, 3)} times the chosen one)`;
    const joined = data.junctions.filter(({ crack, step: from }) => crack === state.crack && step.step >= from);
    const event = joined.length && !step.tips.some((tip) => tip.crack === state.crack) ? `Crack ${state.crack} has joined crack ${joined[0].onto}. ` : "";
    say("readout", `${event}${shownK}. ${direction[0].toUpperCase()}${direction.slice(1)}${rival}${tip.stop ? `; stop: ${tip.stop}` : ""}.`);
    find("keep").disabled = state.kept.includes(state.step);
    find("clear").hidden = state.kept.length === 0;
  }

  function moveTo(change) {
    const before = { ...state };
    Object.assign(state, change);
    state.step = Math.max(0, Math.min(state.step, shown.length - 1));
    state.position = Math.max(0, Math.min(state.position, positions.length - 1));
    if (state.step !== before.step || state.crack !== before.crack) stepChanged();
    else if (state.position !== before.position) positionChanged();
  }

  // ---- Controls --------------------------------------------------------------------------------------------------

  find("explorer").hidden = false;
  if (isWet) find("scene").querySelector("figcaption").append(" Wide and blue: fluid in the cracks, the wider the higher its pressure.");
  find("step").max = shown.length - 1;
  find("wheel").max = positions.length - 1;
  find("step").disabled = shown.length < 2;
  find("step").addEventListener("input", (event) => moveTo({ step: +event.target.value }));
  find("wheel").addEventListener("input", (event) => moveTo({ position: +event.target.value }));
  find("keep").hidden = find("clear").hidden = shown.length < 2;
  find("keep").addEventListener("click", () => {
    state.kept = [...state.kept, state.step].slice(-KEPT_COLOURS.length);
    stepChanged();
  });
  find("clear").addEventListener("click", () => {
    state.kept = [];
    stepChanged();
  });
  if (data.cracks.length > 1) {
    find("which").hidden = false;
    data.cracks.forEach((_, i) => find("crack").append(new Option(`${i + 1}`, `${i + 1}`)));
    if (data.windows) {
      // One crack for the whole page; the wheel goes where its |K| is largest.
      find("crack").addEventListener("change", (event) => railcrack.crack.choose(+event.target.value));
      railcrack.crack.follow((crack) => crack !== state.crack && moveTo({ crack, position: loudest(state.step, crack) }));
      state.crack = railcrack.crack.now;
      state.position = loudest(state.step, state.crack);
    } else find("crack").addEventListener("change", (event) => moveTo({ crack: +event.target.value }));
  }

  let playing = null;
  function stop() {
    cancelAnimationFrame(playing);
    playing = null;
    find("play").textContent = "Play the passage";
  }
  find("play").addEventListener("click", () => {
    if (playing !== null) return stop();
    if (state.position === positions.length - 1) moveTo({ position: 0 });
    find("play").textContent = "Stop";
    const [begun, from] = [performance.now(), state.position];
    // The whole passage in eight seconds.
    const next = (now) => {
      moveTo({ position: from + Math.floor((now - begun) / 8000 * positions.length) });
      if (state.position >= positions.length - 1) stop();
      else playing = requestAnimationFrame(next);
    };
    playing = requestAnimationFrame(next);
  });

  // The page's own keys, where no control wants them.
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    if (event.target.closest("input, select, textarea, summary, pre, a, button")) {
      // On a slider the browser moves it itself; up and down change the step from the wheel's slider, too.
      if (event.target.id !== "wheel" || !["ArrowUp", "ArrowDown"].includes(event.key)) return;
    }
    const inView = find("explorer").getBoundingClientRect();
    if (inView.bottom < 0 || inView.top > innerHeight) return;
    const change = {
      ArrowLeft: { position: state.position - 1 },
      ArrowRight: { position: state.position + 1 },
      ArrowUp: { step: state.step + 1 },
      ArrowDown: { step: state.step - 1 },
    }[event.key];
    if (!change) return;
    event.preventDefault();
    moveTo(change);
  });

  const again = {
    scene: () => { drawScene(); drawResidual(); },
    ki: () => drawK("ki"),
    kii: () => drawK("kii"),
    deformed: () => drawDeformed(state.faces),
    "face-status": () => drawMaps(state.faces),
    "face-pressure": () => drawMaps(state.faces),
  };
  find("residual").hidden = !data.residual;
  await stepChanged();
  for (const [id, draw] of Object.entries(again)) {
    onWidth(find(id).querySelector(".drawing"), (width) => {
      widths[id] = width;
      draw();
    });
    tools(find(id));
  }
  if (data.residual) tools(find("residual"));
  find("explorer").dataset.ready = "true";
})().catch((reason) => {
  const note = document.createElement("p");
  note.className = "failure";
  note.textContent = `The explorer cannot be shown: ${reason.message}. It needs a browser of 2023 or later; the folder plots/ has pictures.`;
  document.getElementById("explorer").before(note);
  console.error(reason);
});

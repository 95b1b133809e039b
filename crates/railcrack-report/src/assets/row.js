// The map of a row of cracks at their places along the rail, in the colour of a quantity; one is chosen.
"use strict";

railcrack.viewer("row-map", "The map", "plots/row.svg has a picture", async () => {
  const { chart, crack, element, leastIndex, menu, plain, range, shade, shape, signed, singles, words } =
    railcrack;
  const data = /** @type {RowData} */ (railcrack.pageData("row-data"));
  const count = data.mouth.length;
  const all = range(count);
  const lastStep = data.steps.length - 1;
  const packed = [data.length, data.depth, data.keq, data.rate].map(singles);
  const [length, depth, keq, rate] = await Promise.all(packed);
  const [stops, pathEnds] = [await railcrack.unpack(data.stop), await railcrack.levels(data.ends)];
  // Where nothing is removed from the rail, the explorer has the paths.
  const paths =
    data.paths ?? /** @type {RunData} */ (railcrack.pageData("run-data")).cracks.map(({ points }) => points);
  const distinctions = new Map(data.named);
  const state = { step: lastStep, up: "depth", colour: lastStep > 0 ? "growth" : "length" };

  // ---- Quantities -------------------------------------------------------------------------------

  /** The value of crack `i` in a step. @param {ArrayLike<number>} values @param {number} step @param {number} i */
  const at = (values, step, i) => values[step * count + i];

  /** A crack below the surface of a step, as points along the rail and in depth. @param {number} step @param {number} i */
  function line(step, i) {
    const place = 2 * (step * count + i);
    const points = paths[i].slice(pathEnds[place], pathEnds[place + 1] + 1);
    return points.map(([x, y]) => /** @type {Pair} */ ([x, -y - data.removed[step]]));
  }
  /** Angle of the deeper end below the horizontal, degrees; not a number for a single point. @param {number} step @param {number} i */
  function angle(step, i) {
    const points = line(step, i);
    if (points.length < 2) return Number.NaN;
    const [tip, before] = points[0][1] > points[points.length - 1][1] ? points : points.reverse();
    return (Math.atan2(tip[1] - before[1], Math.abs(tip[0] - before[0])) * 180) / Math.PI;
  }

  /** What a crack has in a step, by the end of the name of its chart. @type {Record<string, RowQuantity>} */
  const QUANTITIES = {
    length: { name: "length", unit: "mm", of: (step, i) => at(length, step, i) },
    growth: {
      name: "growth since step 0",
      unit: "mm",
      of: (step, i) => at(length, step, i) - at(length, 0, i),
    },
    rate: { name: "growth rate", unit: "mm per cycle", of: (step, i) => at(rate, step, i) },
    keq: { name: "\u0394K_{eq}", unit: "MPa\u221am", of: (step, i) => at(keq, step, i) },
  };
  /** The axis of a quantity, over all steps. @param {string} name */
  const axisOf = (name) => chart(`row-${name}`).y;
  /** @param {string} name @param {number} value */
  const isDrawable = (name, value) => Number.isFinite(value) && (!axisOf(name).log || value > 0);

  /** @param {number} step @param {number} i */
  function colourOf(step, i) {
    if (state.colour === "stop") return `var(--c${at(stops, step, i) % 9})`;
    const [value, axis] = [QUANTITIES[state.colour].of(step, i), axisOf(state.colour)];
    if (!isDrawable(state.colour, value)) return "var(--quiet)";
    return shade((axis.at(value) - axis.start) / (axis.end - axis.start));
  }

  // ---- Drawing ----------------------------------------------------------------------------------

  const NAMES = ["depth", ...Object.keys(QUANTITIES)];
  /** Where the cracks are on the chart in view, pixels. @type {Pair[]} */
  let places = [];

  /** The path of a crack on its chart. @param {number} i @param {Attributes} style */
  function drawPath(i, style) {
    const [figure, path] = [chart("row-depth"), line(state.step, i)];
    const [x, y] = path[Math.floor(path.length / 2)] ?? [data.mouth[i], 0];
    places[i] = [figure.x.at(x), figure.y.at(y)];
    const drawn = figure.line(path, { class: "crack", "stroke-width": 2.2, ...style });
    const isChosen = i === crack.chosen - 1;
    return isChosen ? [figure.line(path, { stroke: "var(--ink)", "stroke-width": 6 }), drawn] : [drawn];
  }
  /** The value of a crack on the chart of a quantity, from that in step 0. @param {number} i @param {Attributes} style */
  function drawValue(i, style) {
    const [figure, x, { of }] = [chart(`row-${state.up}`), data.mouth[i], QUANTITIES[state.up]];
    const ends = [of(0, i), of(state.step, i)].filter((value) => isDrawable(state.up, value));
    const points = ends.map((value) => /** @type {Pair} */ ([x, value]));
    const last = points[points.length - 1];
    places[i] = [figure.x.at(x), last ? figure.y.at(last[1]) : figure.y.start];
    if (!last) return [];
    const dot = i === crack.chosen - 1 ? { r: 5.5, "stroke-width": 2 } : { r: 3.6, "stroke-width": 0 };
    const ring = figure.dot(points[0], { r: 2, fill: "var(--ground)", stroke: "var(--quiet)" });
    const value = figure.dot(last, { class: "crack", fill: style.stroke, stroke: "var(--ink)", ...dot });
    return [figure.line(points, { ...style, "stroke-width": 1.8 }), ring, value];
  }

  function draw() {
    const figure = chart(`row-${state.up}`);
    for (const name of NAMES) chart(`row-${name}`).figure.hidden = name !== state.up;
    figure.background(false);
    places = new Array(count);
    // The chosen one above the others.
    const order = [...all.filter((i) => i !== crack.chosen - 1), crack.chosen - 1];
    const mark = state.up === "depth" ? drawPath : drawValue;
    const cracks = order.map((i) =>
      shape("g", { "data-crack": i + 1 }, ...mark(i, { stroke: colourOf(state.step, i) })),
    );
    figure.show("cracks", cracks);
    figure.svg.dataset.step = String(data.steps[state.step]);
    if (state.colour === "stop") {
      const present = new Set(all.map((i) => at(stops, state.step, i)));
      const entries = data.stops.map((name, i) => ({ name, colour: `var(--c${i % 9})` }));
      figure.explain(entries.filter((_, i) => present.has(i)));
    } else {
      const [{ name, unit }, { from, to }] = [QUANTITIES[state.colour], axisOf(state.colour)];
      figure.explain([{ name: `${name}, ${words(from)} to ${words(to)} ${unit}`, mark: "ramp" }]);
    }
    const perMm = [figure.x, figure.y].map(({ from, to, start, end }) =>
      Math.abs((end - start) / (to - from)),
    );
    const depths = state.up === "depth" ? ` Depth is exaggerated ${words(perMm[1] / perMm[0])} times.` : "";
    const rings = state.up !== "depth" && state.step > 0 ? " Rings: step 0." : "";
    const step = `${count} cracks in growth step ${data.steps[state.step]}`;
    figure.caption(`${step}; crack ${crack.chosen} is highlighted.${depths}${rings}`);
  }

  // ---- Words ------------------------------------------------------------------------------------

  /** What is known of a crack in the step. @param {number} i */
  function description(i) {
    const { step } = state;
    /** @param {string} name */
    const value = (name) => {
      const { of, unit } = QUANTITIES[name];
      return Number.isFinite(of(step, i)) ? `${words(of(step, i))} ${unit}` : "none";
    };
    const longer = all.filter((other) => at(length, step, other) > at(length, step, i)).length;
    const distinction = distinctions.has(i + 1) ? ` (${distinctions.get(i + 1)})` : "";
    const grown = step > 0 ? `, grown by ${value("growth")}` : "";
    const slope = angle(step, i);
    const inclined = Number.isFinite(slope) ? `, at ${signed(slope, 1)}\u00b0 below the horizontal` : "";
    const perMgt = (at(rate, step, i) * 1e6) / (data.axle_load ?? 1);
    const byTonnage = data.axle_load ? `, ${words(perMgt)} mm per million gross tonnes` : "";
    return (
      `Crack ${i + 1}${distinction} at x = ${words(data.mouth[i])} mm: ${value("length")} long, ` +
      `number ${longer + 1} of ${count} by length${grown}; tip ${words(at(depth, step, i))} mm deep${inclined}; ` +
      `\u0394Keq = ${value("keq")}; ${value("rate")}${byTonnage}; ${data.stops[at(stops, step, i)]}.`
    );
  }

  function show() {
    draw();
    const cycles = railcrack.traffic(data.cycles[state.step], data.axle_load);
    slider.show(state.step, `${data.steps[state.step]} of ${data.last_step}: ${cycles}`);
    chooseCrack.value = String(crack.chosen);
    element("row-readout").textContent = description(crack.chosen - 1);
  }

  /** @param {Partial<typeof state>} change */
  function moveTo(change) {
    Object.assign(state, change);
    state.step = Math.max(0, Math.min(state.step, lastStep));
    show();
  }

  // ---- Controls ---------------------------------------------------------------------------------

  const slider = railcrack.slider("row-step", lastStep, (step) => moveTo({ step }));
  const named = data.named.map(([value, words]) => ({ name: `${value}: ${words}`, value }));
  const others = all.filter((i) => !distinctions.has(i + 1)).map((i) => ({ name: `${i + 1}`, value: i + 1 }));
  const chooseCrack = menu("row-crack", [...named, ...others], (number) => crack.choose(+number));
  const byQuantity = Object.entries(QUANTITIES).map(([value, { name }]) => ({ name: plain(name), value }));
  menu("row-up", [{ name: "depth: the crack paths", value: "depth" }, ...byQuantity], (up) => moveTo({ up }));
  const colours = [...byQuantity, { name: "reason for stopping", value: "stop" }];
  menu("row-colour", colours, (colour) => moveTo({ colour })).value = state.colour;

  // Along the rail, whatever the order of the numbers.
  const along = all.toSorted((one, other) => data.mouth[one] - data.mouth[other]);
  /** @param {KeyboardEvent} event */
  function onKey(event) {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const place = along.indexOf(crack.chosen - 1);
    /** @type {Record<string, number>} */
    const toPlace = { ArrowLeft: place - 1, ArrowRight: place + 1, Home: 0, End: count - 1 };
    /** @type {Record<string, number>} */
    const toStep = { ArrowUp: state.step + 1, ArrowDown: state.step - 1 };
    if (event.key in toStep) moveTo({ step: toStep[event.key] });
    else if (!(event.key in toPlace)) return;
    else if (along[toPlace[event.key]] !== undefined) crack.choose(along[toPlace[event.key]] + 1);
    event.preventDefault();
    event.stopPropagation();
  }
  for (const name of NAMES) {
    const { figure, pointer, svg } = chart(`row-${name}`);
    const drawing = railcrack.within(figure, ".drawing");
    const label = "Map of the cracks: left and right arrows choose one, up and down the growth step";
    for (const [key, value] of Object.entries({ tabindex: "0", role: "group", "aria-label": label }))
      drawing.setAttribute(key, value);
    /** The crack under the pointer, or the nearest along the rail, then in height. @param {Event} event */
    const under = (event) => {
      const mark = event.target instanceof SVGElement && event.target.closest("g[data-crack]");
      if (mark instanceof SVGElement) return Number(mark.dataset.crack) - 1;
      const [px, py] = pointer(event);
      return leastIndex(places.map(([x, y]) => Math.abs(x - px) + 0.15 * Math.abs(y - py)));
    };
    svg.addEventListener("pointermove", (event) => {
      element("row-value").textContent = description(under(event));
    });
    svg.addEventListener("click", (event) => crack.choose(under(event) + 1));
    drawing.addEventListener("keydown", onKey);
  }
  // Below the maps, which its length must not move.
  element("row-map").append(element("row-value"));
  crack.followers.push(show);
  crack.choose(data.named[0]?.[0] ?? 1);
});

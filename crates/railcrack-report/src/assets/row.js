// The map of a row of cracks: each at its place along the rail, in the colour of a quantity; one of
// them is chosen.
"use strict";

railcrack.viewer("row-map", "The map", "plots/row.svg has a picture", async () => {
  const { crack, ends, levels, plain, signed, singles, ticks, tonnage, unpack, words } = railcrack;
  const data = /** @type {RowData} */ (railcrack.pageData("row-data"));
  const figure = railcrack.picture("row-figure");
  const [chooseCrack, chooseHeight, chooseColour] = ["row-crack", "row-up", "row-colour"].map((id) =>
    railcrack.element(id, HTMLSelectElement),
  );
  const [readout, underPointer] = [railcrack.element("row-readout"), railcrack.element("row-value")];
  const count = data.mouth.length;
  const all = d3.range(count);
  const lastStep = data.steps.length - 1;
  const [length, depth, keq, rate] = await Promise.all(
    [data.length, data.depth, data.keq, data.rate].map(singles),
  );
  const [stops, pathEnds] = [await unpack(data.stop), await levels(data.ends)];
  // Where nothing is removed from the rail, the explorer has the paths.
  const paths =
    data.paths ?? /** @type {RunData} */ (railcrack.pageData("run-data")).cracks.map(({ points }) => points);
  const distinctions = new Map(data.named);
  const state = { step: lastStep, up: "depth", colour: lastStep > 0 ? "growth" : "length" };

  // ---- Quantities -------------------------------------------------------------------------------

  /**
   * The value of crack `i` in a step.
   * @param {ArrayLike<number>} values
   * @param {number} step
   * @param {number} i
   */
  const at = (values, step, i) => values[step * count + i];

  /**
   * A crack below the surface of a step, as points along the rail and in depth.
   * @param {number} step
   * @param {number} i
   */
  function line(step, i) {
    const place = 2 * (step * count + i);
    const points = paths[i].slice(pathEnds[place], pathEnds[place + 1] + 1);
    return points.map(([x, y]) => /** @type {Pair} */ ([x, -y - data.removed[step]]));
  }

  /**
   * Angle of the deeper end below the horizontal, degrees; not a number for a single point.
   * @param {number} step
   * @param {number} i
   */
  function angle(step, i) {
    const points = line(step, i);
    if (points.length < 2) return Number.NaN;
    const inwards = points[0][1] > points[points.length - 1][1] ? points : points.reverse();
    const [tip, before] = inwards;
    return (Math.atan2(tip[1] - before[1], Math.abs(tip[0] - before[0])) * 180) / Math.PI;
  }

  /**
   * What a crack has in a step: title of its axis, name in menus and legends, unit.
   * @typedef {object} Quantity
   * @property {string} title
   * @property {string} name
   * @property {string} unit
   * @property {boolean} [log]
   * @property {boolean} [zero]
   * @property {(step: number, i: number) => number} of
   */

  /** @type {[string, Quantity][]} */
  const perTonnage = data.axle_load
    ? [
        [
          "mgt",
          {
            title: "Growth rate (mm per MGT)",
            name: "growth rate by tonnage",
            unit: "mm per million gross tonnes",
            log: true,
            of: (step, i) => (at(rate, step, i) * 1e6) / (data.axle_load ?? Number.NaN),
          },
        ],
      ]
    : [];
  /** @type {Map<string, Quantity>} */
  const quantities = new Map([
    ["length", { title: "Length (mm)", name: "length", unit: "mm", of: (step, i) => at(length, step, i) }],
    [
      "growth",
      {
        title: "Growth since step 0 (mm)",
        name: "growth since step 0",
        unit: "mm",
        zero: true,
        of: (step, i) => at(length, step, i) - at(length, 0, i),
      },
    ],
    [
      "rate",
      {
        title: "Growth rate (mm per cycle)",
        name: "growth rate",
        unit: "mm per cycle",
        log: true,
        of: (step, i) => at(rate, step, i),
      },
    ],
    ...perTonnage,
    [
      "keq",
      {
        title: "\u0394K_{eq} (MPa\u221am)",
        name: "\u0394K_{eq}",
        unit: "MPa\u221am",
        of: (step, i) => at(keq, step, i),
      },
    ],
    ["angle", { title: "Angle of the tip (\u00b0)", name: "angle of the tip", unit: "\u00b0", of: angle }],
  ]);

  /** @param {string} name */
  function quantityOf(name) {
    const found = quantities.get(name);
    if (!found) throw new Error(`no quantity ${name}`);
    return found;
  }

  /** @param {Quantity} quantity @param {number} value */
  const isDrawable = (quantity, value) => Number.isFinite(value) && (!quantity.log || value > 0);

  /** What each quantity spans in all steps, so that steps compare. */
  const spans = new Map(
    [...quantities.values()].map((quantity) => {
      const every = d3.range(lastStep + 1).flatMap((step) => all.map((i) => quantity.of(step, i)));
      const values = every.filter((value) => isDrawable(quantity, value));
      /** @type {Pair} */
      const none = quantity.log ? [1, 10] : [0, 1];
      return [
        quantity,
        values.length ? railcrack.extent(quantity.zero ? [0, ...values] : values, quantity.log) : none,
      ];
    }),
  );

  /**
   * The scale of a quantity.
   * @param {Quantity} quantity
   * @param {Pair} range
   */
  const scaleOf = (quantity, range) =>
    (quantity.log ? d3.scaleLog() : d3.scaleLinear()).domain(spans.get(quantity) ?? []).range(range);

  const STOP_COLOURS = data.stops.map((_, i) => `var(--c${i})`);

  /** @param {number} step @param {number} i */
  function colourOf(step, i) {
    if (state.colour === "stop") return STOP_COLOURS[at(stops, step, i)];
    const quantity = quantityOf(state.colour);
    const value = quantity.of(step, i);
    if (!isDrawable(quantity, value)) return "var(--quiet)";
    return `var(--s${Math.round(scaleOf(quantity, [0, 20]).clamp(true)(value))})`;
  }

  // ---- Drawing ----------------------------------------------------------------------------------

  const points = data.paths
    ? d3.range(lastStep + 1).flatMap((step) => all.flatMap((i) => line(step, i)))
    : paths.flat().map(([x, y]) => [x, -y]);
  const [left, right] = ends([...data.mouth, ...points.map((point) => point[0])]);
  const deepest = d3.max(points, (point) => point[1]) || 1;
  const margin = { left: 64, right: 16, top: 20, bottom: 26 };
  // Far enough apart to be seen and touched one by one, in as many lines as that takes.
  const APART = 9;
  /** The crack at a point of the drawing. @type {(x: number, y: number) => number | null} */
  let hit = () => null;

  /**
   * Times that depth is drawn larger than length: round, and as large as fits.
   * @param {number} perMm
   */
  function exaggeration(perMm) {
    const times = 130 / (deepest * perMm);
    return [20, 15, 10, 8, 6, 5, 4, 3, 2, 1].find((round) => round <= times) ?? Math.max(0.05, times);
  }

  /**
   * A part of the row on the map: its scales, in pixels from its upper left corner.
   * @typedef {object} Line
   * @property {number} number
   * @property {number} from
   * @property {number} to
   * @property {number} inside
   * @property {number} high
   * @property {d3.ScaleContinuousNumeric<number, number>} x
   * @property {d3.ScaleContinuousNumeric<number, number>} y
   * @property {d3.Selection<SVGGElement, undefined, null, undefined>} group
   */

  /**
   * Where a crack is on the map.
   * @typedef {{ i: number, line: number, x: number, y: number }} Target
   */

  /** @param {number} width */
  function draw(width) {
    const inside = width - margin.left - margin.right;
    const lines = Math.max(1, Math.min(12, Math.ceil((APART * count) / inside)));
    const air = 0.008 * (right - left) + 0.2;
    const span = (right - left + 2 * air) / lines;
    const perMm = inside / span;
    const quantity = state.up === "depth" ? null : quantityOf(state.up);
    const times = exaggeration(perMm);
    const high = quantity ? (lines > 1 ? 110 : 190) : Math.max(40, deepest * perMm * times * 1.06);
    const pitch = high + margin.top + margin.bottom;
    const y = quantity
      ? scaleOf(quantity, [high - 6, 6]).nice()
      : d3.scaleLinear([0, high / (perMm * times)], [0, high]);
    const height = lines * pitch + 20;
    const svg = d3
      .create("svg")
      .attr("width", width)
      .attr("height", height)
      .attr("viewBox", `0 0 ${width} ${height}`);
    svg.attr("role", "img").attr("aria-label", "The cracks by position along the rail");
    svg.attr("font-size", 12).attr("fill", "currentColor").style("display", "block");
    /** @type {Target[]} */
    const targets = [];
    for (const number of d3.range(lines)) {
      const from = left - air + number * span;
      const x = d3.scaleLinear([from, from + span], [0, inside]);
      const group = svg
        .append("g")
        .attr("transform", `translate(${margin.left},${number * pitch + margin.top})`);
      targets.push(...drawLine({ number, from, to: from + span, inside, high, x, y, group }, quantity));
    }
    const labels = [
      {
        name: "y",
        text: quantity?.title ?? "Depth (mm)",
        place: `translate(14,${0.5 * lines * pitch}) rotate(-90)`,
      },
      {
        name: "x",
        text: "x along the rail (mm)",
        place: `translate(${margin.left + 0.5 * inside},${height - 8})`,
      },
    ];
    for (const { name, text, place } of labels) {
      const label = svg.append("g").attr("aria-label", `${name}-axis label`).append("text");
      label.attr("transform", place).attr("text-anchor", "middle").text(text);
    }
    svg
      .attr("data-step", data.steps[state.step])
      .attr("data-rows", lines)
      .attr("data-times", quantity ? null : times);
    hit = (px, py) => {
      const line = Math.max(0, Math.min(lines - 1, Math.floor(py / pitch)));
      const [across, down] = [px - margin.left, py - line * pitch - margin.top];
      // Nearest along the rail, then in height.
      const near = targets.filter((target) => target.line === line);
      return d3.least(near, ({ x, y }) => Math.abs(x - across) + 0.15 * Math.abs(y - down))?.i ?? null;
    };
    figure.show(/** @type {SVGSVGElement} */ (svg.node()));
    explain(quantity, times, lines);
  }

  /**
   * Draws a part of the row; where its cracks are.
   * @param {Line} here
   * @param {Quantity | null} quantity
   */
  function drawLine(here, quantity) {
    const { number, from, to, inside, high, x, group } = here;
    const chosen = crack.now - 1;
    const ground = group.append("rect").attr("width", inside).attr("height", high);
    if (quantity) ground.attr("fill", "none").attr("stroke", "var(--line)");
    else ground.attr("fill", "var(--rail)");
    drawAxes(here, quantity);
    const id = `row-clip-${number}`;
    const clip = group.append("clipPath").attr("id", id).append("rect").attr("x", -1).attr("y", -3);
    clip.attr("width", inside + 2).attr("height", high + 6);
    const marks = group.append("g").attr("clip-path", `url(#${id})`);
    const cracks = all.filter((i) => {
      const [first, last] = quantity
        ? [data.mouth[i], data.mouth[i]]
        : ends(line(state.step, i).map(([x]) => x));
      return last >= from && first <= to;
    });
    if (!quantity) drawPieces(here, marks);
    /** @type {Target[]} */
    const targets = [];
    // The chosen one above the others.
    for (const i of d3.sort(cracks, (i) => Number(i === chosen))) {
      const mark = marks
        .append("g")
        .attr("data-crack", i + 1)
        .attr("fill", "none");
      mark.attr("stroke-linecap", "round").attr("stroke-linejoin", "round");
      targets.push(quantity ? drawValue(here, mark, i, quantity) : drawPath(here, mark, i));
    }
    const own = cracks.filter((i) => data.mouth[i] >= from && data.mouth[i] <= to);
    drawNumbers(group, x, own);
    return targets;
  }

  /** @typedef {d3.Selection<SVGGElement, undefined, null, undefined>} Group */

  /** Pieces of rail that cracks enclose. @param {Line} here @param {Group} marks */
  function drawPieces({ x, y }, marks) {
    const step = data.steps[state.step];
    for (const { outline } of data.pieces.filter((piece) => step >= piece.step || step === data.last_step)) {
      const corners = outline.map(([px, py]) => /** @type {Pair} */ ([x(px), y(-py)]));
      const piece = marks
        .append("path")
        .attr("class", "piece")
        .attr("d", `${d3.line()(corners)}Z`);
      piece.attr("fill", "var(--c4)").attr("fill-opacity", 0.3).attr("stroke", "var(--c4)");
      piece.attr("stroke-dasharray", "4 3");
    }
  }

  /**
   * The path of a crack.
   * @param {Line} here
   * @param {Group} mark
   * @param {number} i
   * @returns {Target}
   */
  function drawPath({ number, x, y }, mark, i) {
    const path = line(state.step, i).map(([px, py]) => /** @type {Pair} */ ([x(px), y(py)]));
    const isChosen = i === crack.now - 1;
    if (isChosen)
      mark.append("path").attr("d", d3.line()(path)).attr("stroke", "var(--ink)").attr("stroke-width", 6);
    const drawn = mark.append("path").attr("class", "crack").attr("d", d3.line()(path));
    drawn.attr("stroke", colourOf(state.step, i)).attr("stroke-width", isChosen ? 3 : 2.2);
    const [first, middle, last] = [path[0], path[Math.floor(path.length / 2)], path[path.length - 1]];
    return { i, line: number, x: 0.5 * (first[0] + last[0]), y: middle[1] };
  }

  /**
   * The value of a crack, from that in step 0.
   * @param {Line} here
   * @param {Group} mark
   * @param {number} i
   * @param {Quantity} quantity
   * @returns {Target}
   */
  function drawValue({ number, high, x, y }, mark, i, quantity) {
    const [first, value] = [quantity.of(0, i), quantity.of(state.step, i)];
    const [isFirst, isNow] = [isDrawable(quantity, first), isDrawable(quantity, value)];
    const [px, colour, isChosen] = [x(data.mouth[i]), colourOf(state.step, i), i === crack.now - 1];
    if (isFirst && isNow) {
      const change = mark
        .append("line")
        .attr("x1", px)
        .attr("x2", px)
        .attr("y1", y(first))
        .attr("y2", y(value));
      change.attr("stroke", colour).attr("stroke-width", 1.8);
    }
    if (isFirst && state.step > 0) {
      const ring = mark.append("circle").attr("cx", px).attr("cy", y(first)).attr("r", 2);
      ring.attr("fill", "var(--ground)").attr("stroke", "var(--quiet)");
    }
    if (isNow) {
      const dot = mark.append("circle").attr("class", "crack").attr("cx", px).attr("cy", y(value));
      dot.attr("r", isChosen ? 5.5 : 3.6).attr("fill", colour);
      dot.attr("stroke", isChosen ? "var(--ink)" : "none").attr("stroke-width", 2);
    }
    return { i, line: number, x: px, y: isNow ? y(value) : high };
  }

  /** @param {Line} here @param {Quantity | null} quantity */
  function drawAxes({ number, inside, high, x, y, group }, quantity) {
    /** @param {"x" | "y"} axis */
    const name = (axis) =>
      number === 0 || axis === "x" ? `${axis}-axis tick label` : `ticks of line ${number + 1}`;
    const across = group.append("g").attr("aria-label", name("x"));
    for (const tick of x.ticks(Math.max(2, Math.floor(inside / 70)))) {
      const mark = group.append("line").attr("x1", x(tick)).attr("x2", x(tick));
      mark
        .attr("y1", high)
        .attr("y2", high + 4)
        .attr("stroke", "currentColor");
      across
        .append("text")
        .attr("x", x(tick))
        .attr("y", high + 17)
        .attr("text-anchor", "middle")
        .text(ticks(tick));
    }
    const up = group.append("g").attr("aria-label", name("y"));
    for (const tick of quantity?.log
      ? logarithmicTicks(y.domain())
      : y.ticks(Math.max(2, Math.floor(high / 40)))) {
      const mark = group.append("line").attr("x1", 0).attr("x2", inside);
      mark.attr("y1", y(tick)).attr("y2", y(tick)).attr("stroke", "var(--line)");
      const label = quantity?.log ? railcrack.short(tick) : ticks(tick);
      up.append("text")
        .attr("x", -6)
        .attr("y", y(tick) + 4)
        .attr("text-anchor", "end")
        .text(label);
    }
    if (!quantity)
      group.append("line").attr("x2", inside).attr("stroke", "var(--ink)").attr("stroke-width", 2);
  }

  /** @param {number[]} domain */
  function logarithmicTicks(domain) {
    const values = railcrack.logarithmic(...ends(domain));
    return values.length > 6 ? values.filter(railcrack.isPowerOfTen) : values;
  }

  /**
   * Numbers of the chosen and the named cracks above the map, as far as there is room.
   * @param {Group} group
   * @param {Line["x"]} x
   * @param {number[]} own
   */
  function drawNumbers(group, x, own) {
    /** @type {{ at: number, half: number }[]} */
    const placed = [];
    const wanted = new Set([crack.now - 1, ...data.named.map(([number]) => number - 1)]);
    for (const i of wanted) {
      if (!own.includes(i)) continue;
      const [at, half] = [x(data.mouth[i]), 4 + 3.6 * `${i + 1}`.length];
      if (placed.some((other) => Math.abs(other.at - at) < other.half + half)) continue;
      placed.push({ at, half });
      const text = group.append("text").attr("x", at).attr("y", -5).attr("text-anchor", "middle");
      text.attr("font-weight", i === crack.now - 1 ? 700 : 400).text(i + 1);
    }
  }

  // ---- Words ------------------------------------------------------------------------------------

  /**
   * Legend and caption.
   * @param {Quantity | null} quantity
   * @param {number} times
   * @param {number} lines
   */
  function explain(quantity, times, lines) {
    if (state.colour === "stop") {
      const present = new Set(all.map((i) => at(stops, state.step, i)));
      const entries = data.stops.map((name, i) => ({ name, colour: STOP_COLOURS[i] }));
      figure.explain(entries.filter((_, i) => present.has(i)));
    } else {
      const coloured = quantityOf(state.colour);
      const [low, high] = spans.get(coloured) ?? [0, 1];
      const colours = d3.range(9).map((i) => `var(--s${Math.round(2.5 * i)})`);
      figure.explain([
        { name: `${coloured.name}, ${words(low)} to ${words(high)} ${coloured.unit}`, colours },
      ]);
    }
    const toScale = times === 1 ? " To scale." : ` Depth is exaggerated ${words(times)} times.`;
    const depths = quantity ? "" : toScale;
    const initial = quantity && state.step > 0 ? " Rings: step 0." : "";
    const folded = lines > 1 ? ` The row is split into ${lines} lines.` : "";
    figure.caption(
      `${count} cracks in growth step ${data.steps[state.step]}; crack ${crack.now} is highlighted, and numbers mark ` +
        `the cracks named in the curves.${depths}${initial}${folded}`,
    );
  }

  /** What is known of a crack in the step. @param {number} i */
  function description(i) {
    const step = state.step;
    /** @param {string} name */
    const value = (name) => {
      const { of, unit } = quantityOf(name);
      return Number.isFinite(of(step, i)) ? `${words(of(step, i))} ${unit}` : "none";
    };
    const longer = all.filter((other) => at(length, step, other) > at(length, step, i)).length;
    const distinction = distinctions.has(i + 1) ? ` (${distinctions.get(i + 1)})` : "";
    const grown = step > 0 ? `, grown by ${value("growth")}` : "";
    const slope = angle(step, i);
    const inclined = Number.isFinite(slope) ? `, at ${signed(slope, 1)}\u00b0 below the horizontal` : "";
    const byTonnage = data.axle_load ? `, ${value("mgt")}` : "";
    return (
      `Crack ${i + 1}${distinction} at x = ${words(data.mouth[i])} mm: ${value("length")} long, ` +
      `number ${longer + 1} of ${count} by length${grown}; tip ${words(at(depth, step, i))} mm deep${inclined}; ` +
      `\u0394Keq = ${value("keq")}; ${value("rate")}${byTonnage}; ${data.stops[at(stops, step, i)]}.`
    );
  }

  function show() {
    if (figure.width) draw(figure.width);
    const cycles = data.cycles[state.step];
    const tonnes = tonnage(cycles, data.axle_load);
    slider.show(
      state.step,
      `${data.steps[state.step]} of ${data.last_step}: ${words(cycles)} cycles${tonnes}`,
    );
    chooseCrack.value = String(crack.now);
    readout.textContent = description(crack.now - 1);
  }

  /** @param {Partial<typeof state>} change */
  function moveTo(change) {
    Object.assign(state, change);
    state.step = Math.max(0, Math.min(state.step, lastStep));
    show();
  }

  // ---- Controls ---------------------------------------------------------------------------------

  railcrack.element("row-map").hidden = false;
  const slider = railcrack.slider("row-step", lastStep, (step) => moveTo({ step }));
  /** @param {string} label @param {HTMLOptionElement[]} list */
  const group = (label, list) => {
    const made = Object.assign(document.createElement("optgroup"), { label });
    made.append(...list);
    return made;
  };
  /** @param {string} text @param {string | number} value */
  const option = (text, value) => new Option(plain(text), String(value));
  chooseCrack.append(
    group(
      "Named cracks",
      data.named.map(([number, name]) => option(`${number}: ${name}`, number)),
    ),
    group(
      "Other cracks",
      all.filter((i) => !distinctions.has(i + 1)).map((i) => option(`${i + 1}`, i + 1)),
    ),
  );
  const byQuantity = () => [...quantities].map(([key, { name }]) => option(name, key));
  chooseHeight.append(option("depth: the crack paths", "depth"), ...byQuantity());
  chooseColour.append(...byQuantity(), option("reason for stopping", "stop"));
  chooseColour.value = state.colour;
  chooseCrack.addEventListener("change", () => crack.choose(+chooseCrack.value));
  chooseHeight.addEventListener("change", () => moveTo({ up: chooseHeight.value }));
  chooseColour.addEventListener("change", () => moveTo({ colour: chooseColour.value }));
  const { drawing } = figure;
  /** @param {MouseEvent} event */
  const under = (event) => hit(...d3.pointer(event, drawing));
  drawing.style.cursor = "pointer";
  drawing.addEventListener("pointermove", (event) => {
    const i = under(event);
    if (i !== null) underPointer.textContent = description(i);
  });
  drawing.addEventListener("click", (event) => {
    const i = under(event);
    if (i !== null) crack.choose(i + 1);
  });
  // Along the rail, whatever the order of the numbers.
  const along = d3.sort(all, (i) => data.mouth[i]);
  drawing.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const place = along.indexOf(crack.now - 1);
    /** @type {Record<string, number>} */
    const places = { ArrowLeft: place - 1, ArrowRight: place + 1, Home: 0, End: count - 1 };
    /** @type {Record<string, number>} */
    const steps = { ArrowUp: state.step + 1, ArrowDown: state.step - 1 };
    if (event.key in steps) moveTo({ step: steps[event.key] });
    else if (!(event.key in places)) return;
    else if (along[places[event.key]] !== undefined) crack.choose(along[places[event.key]] + 1);
    event.preventDefault();
    event.stopPropagation();
  });
  crack.follow(show);
  crack.choose(data.named[0]?.[0] ?? 1);
  figure.follow(show);
});

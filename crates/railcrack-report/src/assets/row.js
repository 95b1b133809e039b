// The map of a row of many cracks: each by its place along the rail, in the colour of a quantity; one of them is chosen.
"use strict";

(async () => {
  const { words, plain, typeset, singles, levels, unpack, legend, onWidth, tools, ticks, crack } = railcrack;
  const find = (id) => document.getElementById(`row-${id}`);
  const data = JSON.parse(find("data").textContent);
  const count = data.mouth.length;
  const all = d3.range(count);
  const lasts = data.steps.length - 1;
  const [length, depth, keq, rate] = await Promise.all([data.length, data.depth, data.keq, data.rate].map(singles));
  const [stops, ends] = [await unpack(data.stop), await levels(data.ends, Infinity)];
  // Rails that nothing is removed of have the paths in the explorer.
  const paths = data.paths ?? JSON.parse(document.getElementById("run-data").textContent).cracks.map(({ points }) => points);
  const known = new Map(data.named);
  const state = { step: lasts, up: "depth", colour: lasts > 0 ? "growth" : "length" };

  const at = (values, step, i) => values[step * count + i];
  /** A crack below the surface of a step, as points along the rail and in depth. */
  function line(step, i) {
    const [from, to] = [ends[2 * (step * count + i)], ends[2 * (step * count + i) + 1]];
    return paths[i].slice(from, to + 1).map(([x, y]) => [x, -y - data.removed[step]]);
  }
  /** Angle of the deepest end below the horizontal, degrees; of a point none. */
  function angle(step, i) {
    const points = line(step, i);
    if (points.length < 2) return NaN;
    const [tip, before] = points[0][1] > points.at(-1)[1] ? [points[0], points[1]] : [points.at(-1), points.at(-2)];
    return Math.atan2(tip[1] - before[1], Math.abs(tip[0] - before[0])) * 180 / Math.PI;
  }
  const perMgt = data.axle_load ? [["mgt", { title: "Growth rate (mm per million gross tonnes)", short: "growth rate", unit: "mm per million gross tonnes", log: true, of: (step, i) => at(rate, step, i) * 1e6 / data.axle_load }]] : [];
  const quantities = new Map([
    ["length", { title: "Length (mm)", short: "length", unit: "mm", of: (step, i) => at(length, step, i) }],
    ["growth", { title: "Growth since step 0 (mm)", short: "growth since step 0", unit: "mm", zero: true, of: (step, i) => at(length, step, i) - at(length, 0, i) }],
    ["rate", { title: "Growth rate (mm per cycle)", short: "growth rate", unit: "mm per cycle", log: true, of: (step, i) => at(rate, step, i) }],
    ...perMgt,
    ["keq", { title: "\u0394K_{eq} (MPa\u221am)", short: "\u0394K_{eq}", unit: "MPa\u221am", of: (step, i) => at(keq, step, i) }],
    ["angle", { title: "Angle of the tip (\u00b0)", short: "angle of the tip", unit: "\u00b0", of: angle }],
  ]);
  const good = (quantity, value) => Number.isFinite(value) && (!quantity.log || value > 0);
  /** What a quantity spans in all steps, so that steps compare. */
  const spans = new Map([...quantities].map(([name, quantity]) => {
    const values = d3.range(lasts + 1).flatMap((step) => all.map((i) => quantity.of(step, i))).filter((value) => good(quantity, value));
    return [name, values.length ? railcrack.extent(quantity.zero ? [0, ...values] : values, quantity.log) : [quantity.log ? 1 : 0, quantity.log ? 10 : 1]];
  }));
  /** A scale of a quantity. */
  const scaleOf = (name, range) => (quantities.get(name).log ? d3.scaleLog() : d3.scaleLinear()).domain(spans.get(name)).range(range);
  const STOPS = data.stops.map((_, i) => `var(--c${i})`);
  function colourOf(step, i) {
    if (state.colour === "stop") return STOPS[at(stops, step, i)];
    const value = quantities.get(state.colour).of(step, i);
    return good(quantities.get(state.colour), value) ? `var(--s${Math.round(scaleOf(state.colour, [0, 20]).clamp(true)(value))})` : "var(--quiet)";
  }

  // ---- Drawing -------------------------------------------------------------------------------------------------

  const points = data.paths ? d3.range(lasts + 1).flatMap((step) => all.flatMap((i) => line(step, i))) : paths.flat().map(([x, y]) => [x, -y]);
  const [left, right] = d3.extent([...data.mouth, ...points.map((point) => point[0])]);
  const deepest = d3.max(points, (point) => point[1]) || 1;
  const margin = { left: 64, right: 16, top: 20, bottom: 26 };
  // Apart enough to be told and touched, in as many rows as that takes.
  const APART = 9;
  let hit = () => null;

  /** Times that depth is drawn larger than length: round, and as large as fits. */
  function exaggeration(perMm) {
    const times = 130 / (deepest * perMm);
    return [20, 15, 10, 8, 6, 5, 4, 3, 2, 1].find((round) => round <= times) ?? Math.max(0.05, times);
  }

  function draw(width) {
    const inside = width - margin.left - margin.right;
    const rows = Math.max(1, Math.min(12, Math.ceil(APART * count / inside)));
    const air = 0.008 * (right - left) + 0.2;
    const span = (right - left + 2 * air) / rows;
    const perMm = inside / span;
    const isDepth = state.up === "depth";
    const times = exaggeration(perMm);
    const high = isDepth ? Math.max(40, deepest * perMm * times * 1.06) : rows > 1 ? 110 : 190;
    const pitch = high + margin.top + margin.bottom;
    const quantity = quantities.get(state.up);
    const y = isDepth ? d3.scaleLinear([0, high / (perMm * times)], [0, high]) : scaleOf(state.up, [high - 6, 6]).nice();
    const svg = d3.create("svg").attr("width", width).attr("height", rows * pitch + 20).attr("viewBox", `0 0 ${width} ${rows * pitch + 20}`)
      .attr("role", "img").attr("aria-label", "The cracks by their place along the rail").attr("font-size", 12).attr("fill", "currentColor").style("display", "block");
    const chosen = crack.now - 1;
    const targets = [];
    for (let row = 0; row < rows; row++) {
      const from = left - air + row * span;
      const x = d3.scaleLinear([from, from + span], [0, inside]);
      const group = svg.append("g").attr("transform", `translate(${margin.left},${row * pitch + margin.top})`);
      if (isDepth) group.append("rect").attr("width", inside).attr("height", high).attr("fill", "var(--rail)");
      else group.append("rect").attr("width", inside).attr("height", high).attr("fill", "none").attr("stroke", "var(--line)");
      axis(group, row, x, y, inside, high, quantity);
      const id = `row-clip-${row}`;
      group.append("clipPath").attr("id", id).append("rect").attr("x", -1).attr("y", -3).attr("width", inside + 2).attr("height", high + 6);
      const marks = group.append("g").attr("clip-path", `url(#${id})`);
      const here = all.filter((i) => {
        const xs = isDepth ? line(state.step, i).map((point) => point[0]) : [data.mouth[i]];
        return d3.max(xs) >= from && d3.min(xs) <= from + span;
      });
      if (isDepth) {
        const now = data.steps[state.step];
        for (const { outline } of data.pieces.filter((piece) => now >= piece.step || now === data.last_step))
          marks.append("path").attr("d", `${d3.line()(outline.map(([px, py]) => [x(px), y(-py)]))}Z`).attr("fill", "var(--c4)").attr("fill-opacity", 0.3).attr("stroke", "var(--c4)").attr("stroke-dasharray", "4 3").attr("class", "piece");
      }
      // The chosen one above the others.
      for (const i of [...here.filter((i) => i !== chosen), ...here.filter((i) => i === chosen)]) {
        const colour = colourOf(state.step, i);
        const mark = marks.append("g").attr("data-crack", i + 1).attr("fill", "none").attr("stroke-linecap", "round").attr("stroke-linejoin", "round");
        if (isDepth) {
          const path = line(state.step, i).map(([px, py]) => [x(px), y(py)]);
          if (i === chosen) mark.append("path").attr("d", d3.line()(path)).attr("stroke", "var(--ink)").attr("stroke-width", 6);
          mark.append("path").attr("class", "crack").attr("d", d3.line()(path)).attr("stroke", colour).attr("stroke-width", i === chosen ? 3 : 2.2);
          const middle = path[Math.floor(path.length / 2)];
          targets.push({ i, row, x: 0.5 * (path[0][0] + path.at(-1)[0]), y: middle[1] });
        } else {
          const [first, value] = [0, state.step].map((step) => quantity.of(step, i));
          const px = x(data.mouth[i]);
          if (good(quantity, first) && good(quantity, value)) mark.append("line").attr("x1", px).attr("x2", px).attr("y1", y(first)).attr("y2", y(value)).attr("stroke", colour).attr("stroke-width", 1.8);
          if (good(quantity, first) && state.step > 0) mark.append("circle").attr("cx", px).attr("cy", y(first)).attr("r", 2).attr("fill", "var(--ground)").attr("stroke", "var(--quiet)");
          if (good(quantity, value)) mark.append("circle").attr("class", "crack").attr("cx", px).attr("cy", y(value)).attr("r", i === chosen ? 5.5 : 3.6).attr("fill", colour).attr("stroke", i === chosen ? "var(--ink)" : "none").attr("stroke-width", 2);
          targets.push({ i, row, x: px, y: good(quantity, value) ? y(value) : high });
        }
      }
      numbers(group, row, here, x, from, span);
    }
    const title = isDepth ? "Depth (mm)" : quantity.title;
    const middle = 0.5 * rows * pitch;
    svg.append("g").attr("aria-label", "y-axis label").append("text").attr("transform", `translate(14,${middle}) rotate(-90)`).attr("text-anchor", "middle").text(title);
    svg.append("g").attr("aria-label", "x-axis label").append("text").attr("x", margin.left + 0.5 * inside).attr("y", rows * pitch + 12).attr("text-anchor", "middle").text("x along the rail (mm)");
    svg.attr("data-step", data.steps[state.step]).attr("data-rows", rows).attr("data-times", isDepth ? times : null);
    hit = (px, py) => {
      const row = Math.max(0, Math.min(rows - 1, Math.floor(py / pitch)));
      const place = px - margin.left;
      // Nearest along the rail, then in height.
      return d3.least(targets.filter((target) => target.row === row), (target) => Math.abs(target.x - place) + 0.15 * Math.abs(target.y - (py - row * pitch - margin.top)))?.i ?? null;
    };
    find("figure").querySelector(".drawing").replaceChildren(typeset(svg.node()));
    explain(isDepth, times, rows);
  }

  function axis(group, row, x, y, inside, high, quantity) {
    const name = (axis) => (row === 0 || axis === "x" ? `${axis}-axis tick label` : `ticks of row ${row + 1}`);
    const across = group.append("g").attr("aria-label", name("x"));
    for (const tick of x.ticks(Math.max(2, Math.floor(inside / 70)))) {
      group.append("line").attr("x1", x(tick)).attr("x2", x(tick)).attr("y1", high).attr("y2", high + 4).attr("stroke", "currentColor");
      across.append("text").attr("x", x(tick)).attr("y", high + 17).attr("text-anchor", "middle").text(ticks(tick));
    }
    const up = group.append("g").attr("aria-label", name("y"));
    const values = quantity?.log ? logTicks(y.domain()) : y.ticks(Math.max(2, Math.floor(high / 40)));
    for (const tick of values) {
      group.append("line").attr("x1", 0).attr("x2", inside).attr("y1", y(tick)).attr("y2", y(tick)).attr("stroke", "var(--line)");
      up.append("text").attr("x", -6).attr("y", y(tick) + 4).attr("text-anchor", "end").text(quantity?.log ? railcrack.short(tick) : ticks(tick));
    }
    if (!quantity) group.append("line").attr("x2", inside).attr("stroke", "var(--ink)").attr("stroke-width", 2);
  }
  const logTicks = (domain) => {
    const [low, high] = d3.extent(domain);
    const values = railcrack.logarithmic(low, high);
    return values.length > 6 ? values.filter((value) => Number.isInteger(+Math.log10(value).toFixed(9))) : values;
  };

  /** Numbers of the chosen and the named cracks above the map, as far as there is room. */
  function numbers(group, row, here, x, from, span) {
    const placed = [];
    const wanted = [crack.now - 1, ...data.named.map(([number]) => number - 1)];
    for (const i of wanted.filter((i, k) => here.includes(i) && wanted.indexOf(i) === k)) {
      if (data.mouth[i] < from || data.mouth[i] > from + span) continue;
      const [at, half] = [x(data.mouth[i]), 4 + 3.6 * `${i + 1}`.length];
      if (placed.some((other) => Math.abs(other.at - at) < other.half + half)) continue;
      placed.push({ at, half });
      group.append("text").attr("x", at).attr("y", -5).attr("text-anchor", "middle").attr("font-weight", i === crack.now - 1 ? 700 : 400).text(i + 1);
    }
  }

  function explain(isDepth, times, rows) {
    const place = find("figure").querySelector(".legends");
    if (state.colour === "stop") {
      const there = new Set(all.map((i) => at(stops, state.step, i)));
      place.replaceChildren(legend(data.stops.map((name, i) => ({ name, colour: STOPS[i], there: there.has(i) })).filter(({ there }) => there)));
    } else {
      const quantity = quantities.get(state.colour);
      const [low, high] = spans.get(state.colour);
      const colours = d3.range(9).map((i) => `var(--s${Math.round(2.5 * i)})`);
      place.replaceChildren(legend([{ name: `${quantity.short}, ${words(low)} to ${words(high)} ${quantity.unit}`, colours }]));
    }
    const drawnTo = !isDepth ? "" : times === 1 ? " To scale." : ` Depth is drawn ${words(times)} times as large as length.`;
    const initial = isDepth || state.step === 0 ? "" : " Rings: step 0.";
    const folded = rows > 1 ? ` The row goes on in ${rows} lines.` : "";
    find("caption").textContent = `${count} cracks in growth step ${data.steps[state.step]}; crack ${crack.now} is marked, and numbers name the cracks of the curves.${drawnTo}${initial}${folded}`;
  }

  // ---- Words -----------------------------------------------------------------------------------------------------

  /** What is known of a crack in the step. */
  function tell(i) {
    const step = state.step;
    const value = (name) => { const quantity = quantities.get(name); const it = quantity.of(step, i); return Number.isFinite(it) ? `${words(it)} ${quantity.unit}` : "none"; };
    const longer = all.filter((other) => at(length, step, other) > at(length, step, i)).length;
    const name = known.has(i + 1) ? ` (${known.get(i + 1)})` : "";
    const mgt = data.axle_load ? `, ${value("mgt")}` : "";
    const grown = step > 0 ? `, grown by ${value("growth")}` : "";
    const keqNow = plain(value("keq"));
    return `Crack ${i + 1}${name} at x = ${words(data.mouth[i])} mm: ${value("length")} long, number ${longer + 1} of ${count} by length${grown}; ` +
      `tip ${words(at(depth, step, i))} mm deep${slope(step, i)}; \u0394Keq = ${keqNow}; ${value("rate")}${mgt}; ${data.stops[at(stops, step, i)]}.`;
  }

  const slope = (step, i) => (Number.isFinite(angle(step, i)) ? `, at ${angle(step, i).toFixed(1).replace("-", "\u2212")}\u00b0 below the horizontal` : "");

  function labels() {
    const tonnes = data.axle_load ? `, ${words(data.cycles[state.step] * data.axle_load / 1e6)} MGT` : "";
    const text = `${data.steps[state.step]} of ${data.last_step}: ${words(data.cycles[state.step])} cycles${tonnes}`;
    find("step-value").textContent = text;
    find("step").value = state.step;
    find("step").setAttribute("aria-valuetext", `step ${text}`);
    find("crack").value = crack.now;
    find("readout").textContent = tell(crack.now - 1);
  }

  let width = 0;
  function show() {
    if (width) draw(width);
    labels();
  }
  function moveTo(change) {
    Object.assign(state, change);
    state.step = Math.max(0, Math.min(state.step, lasts));
    show();
  }

  // ---- Controls --------------------------------------------------------------------------------------------------

  find("map").hidden = false;
  find("step").max = lasts;
  find("step").disabled = lasts < 1;
  find("step").addEventListener("input", (event) => moveTo({ step: +event.target.value }));
  const option = (name, value) => new Option(plain(name), value);
  const group = (label, list) => {
    const element = Object.assign(document.createElement("optgroup"), { label });
    element.append(...list);
    return element;
  };
  find("crack").append(
    group("Told from the others", data.named.map(([number, name]) => option(`${number}: ${name}`, number))),
    group("All", all.filter((i) => !known.has(i + 1)).map((i) => option(`${i + 1}`, i + 1))),
  );
  find("up").append(option("depth, as they lie", "depth"), ...[...quantities].map(([name, { short }]) => option(name === "mgt" ? "growth rate by tonnage" : short, name)));
  find("colour").append(...[...quantities].map(([name, { short }]) => option(name === "mgt" ? "growth rate by tonnage" : short, name)), option("why it has stopped", "stop"));
  find("colour").value = state.colour;
  find("crack").addEventListener("change", (event) => crack.choose(+event.target.value));
  find("up").addEventListener("change", (event) => moveTo({ up: event.target.value }));
  find("colour").addEventListener("change", (event) => moveTo({ colour: event.target.value }));
  const drawing = find("figure").querySelector(".drawing");
  const under = (event) => hit(...d3.pointer(event, drawing));
  drawing.style.cursor = "pointer";
  drawing.addEventListener("pointermove", (event) => {
    const i = under(event);
    if (i !== null) find("value").textContent = tell(i);
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
    const to = { ArrowLeft: place - 1, ArrowRight: place + 1, Home: 0, End: count - 1 }[event.key];
    const step = { ArrowUp: state.step + 1, ArrowDown: state.step - 1 }[event.key];
    if (to === undefined && step === undefined) return;
    event.preventDefault();
    event.stopPropagation();
    if (step !== undefined) moveTo({ step });
    else if (to >= 0 && to < count) crack.choose(along[to] + 1);
  });
  crack.follow(show);
  crack.choose(data.named[0]?.[0] ?? 1);
  onWidth(drawing, (now) => {
    width = now;
    show();
  });
  tools(find("figure"));
  find("map").dataset.ready = "true";
})().catch((reason) => {
  const note = document.createElement("p");
  note.className = "failure";
  note.textContent = `The map cannot be shown: ${reason.message}. It needs a browser of 2023 or later; plots/row.svg has a picture.`;
  document.getElementById("row-map").before(note);
  console.error(reason);
});

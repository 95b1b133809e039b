// What every page does: theme, charts from the data beside them, packed numbers, pictures to keep.
"use strict";

const railcrack = (() => {
  const fine = d3.format(".4~g");

  /** A number as people read it: 1 197 467, 0.0464, 2.47e-6. */
  function words(value) {
    const size = Math.abs(value);
    if (size >= 1e4 && size < 1e15) return d3.format(",.0f")(value).replaceAll(",", "\u00a0");
    if (value === 0 || (size >= 1e-3 && size < 1e4)) return fine(value).replace("-", "\u2212");
    return d3.format(".3~e")(value).replaceAll("-", "\u2212");
  }

  /** Puts `text` into `element`; a long name may be broken into lines after its dots and underscores. */
  function inParts(element, text) {
    const parts = text.split(/(?<=[A-Za-z\])][._])(?=[A-Za-z])/);
    element.append(...parts.flatMap((part, i) => (i ? [document.createElement("wbr"), part] : [part])));
    return element;
  }

  /** Marks of indices and powers left out: for places that take plain text only. */
  const plain = (text) => text.replace(/[_^]\{([^}]*)\}/g, "$1");

  /** Sets `K_{I}` in the texts of an SVG with a lowered index. */
  function typeset(svg) {
    for (const text of svg.querySelectorAll("text")) {
      if (text.children.length || !/[_^]\{/.test(text.textContent)) continue;
      const parts = text.textContent.split(/([_^]\{[^}]*\})/);
      text.textContent = "";
      let shift = 0;
      for (const part of parts) {
        const mark = /^([_^])\{(.*)\}$/.exec(part);
        const span = document.createElementNS("http://www.w3.org/2000/svg", "tspan");
        const wanted = mark ? (mark[1] === "_" ? 0.3 : -0.4) : 0;
        span.textContent = mark ? mark[2] : part;
        // The shift counts in the size of the surrounding letters, so it is taken back by the next part.
        span.setAttribute("dy", `${((wanted - shift) * 12).toFixed(2)}`);
        if (mark) span.setAttribute("font-size", "75%");
        shift = wanted;
        text.append(span);
      }
    }
    return svg;
  }

  /** Bytes of base64 text that holds deflated data. */
  async function unpack(text) {
    const deflated = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
    const stream = new Blob([deflated]).stream().pipeThrough(new DecompressionStream("deflate"));
    return new Uint8Array(await new Response(stream).arrayBuffer());
  }

  /** Numbers in single precision. */
  const singles = async (text) => new Float32Array((await unpack(text)).buffer);

  /** Whole numbers in rows of `row`: differences from one to the next, first low bytes, then high ones. */
  async function levels(data, row) {
    const bytes = await unpack(data);
    const count = bytes.length / 2;
    const values = new Uint16Array(count);
    let level = 0;
    for (let i = 0; i < count; i++) {
      const folded = bytes[i] | (bytes[count + i] << 8);
      const difference = (folded >> 1) ^ -(folded & 1);
      level = i % row === 0 ? difference & 0xffff : (level + difference) & 0xffff;
      values[i] = level;
    }
    return values;
  }

  /** Quantised numbers: low + step × level. */
  const quantised = async ({ low, step, data }, row) => Float64Array.from(await levels(data, row), (level) => low + step * level);

  /** Dashes by the look of a curve. */
  const DASHES = { dashed: "6 4", fine: "2 3", "dash-dot": "9 3 2 3" };

  // Ordered colours: viridis without its lightest part on white, without its darkest on black.
  {
    const list = (from, to) => d3.range(21).map((i) => `--s${i}: ${d3.color(d3.interpolateViridis(from + (to - from) * i / 20)).formatHex()};`).join(" ");
    const [light, dark] = [list(0, 0.86), list(0.36, 1)];
    const style = document.createElement("style");
    style.textContent = `:root, [data-theme="light"] { ${light} }
      @media (prefers-color-scheme: dark) { :root:not([data-theme="light"]) { ${dark} } }
      :root[data-theme="dark"] { ${dark} }
      @media print { :root, :root[data-theme="dark"] { ${light} } }`;
    document.head.append(style);
  }

  /** A list of names with the strokes that they stand for. */
  function legend(entries) {
    const list = document.createElement("ul");
    list.className = "legend";
    for (const { name, colour, colours, dashed, dashes, box, dots } of entries) {
      const item = document.createElement("li");
      const mark = d3.create("svg").attr("width", colours ? 108 : 26).attr("height", 12).attr("aria-hidden", "true");
      if (colours) mark.selectAll("rect").data(colours).join("rect").attr("x", (_, i) => 12 * i).attr("width", 12.5).attr("height", 12).attr("fill", String);
      else if (box) mark.append("rect").attr("x", 7).attr("width", 12).attr("height", 12).attr("fill", colour).attr("stroke", "var(--quiet)");
      else {
        if (dots !== "only")
          mark.append("line").attr("x2", 26).attr("y1", 6).attr("y2", 6).attr("stroke", colour).attr("stroke-width", 2)
            .attr("stroke-dasharray", dashes ?? (dashed ? "6 4" : null));
        if (dots) mark.append("circle").attr("cx", 13).attr("cy", 6).attr("r", 3).attr("fill", colour);
      }
      item.append(mark.node(), plain(name));
      list.append(item);
    }
    return list;
  }

  /** An axis title in the middle, round ticks. */
  function scale(axis) {
    const options = { label: axis.title, labelAnchor: "center", labelArrow: "none", grid: true };
    if (axis.scale === "log") Object.assign(options, { type: "log", grid: false });
    else options.tickFormat = ticks;
    if (axis.zero) options.zero = true;
    if (axis.range) options.domain = axis.scale === "depth" ? [axis.range[1], axis.range[0]] : axis.range;
    else if (axis.scale === "depth") options.reverse = true;
    return options;
  }

  /** Ticks of large numbers in thousands and millions. */
  const ticks = (value) =>
    (Math.abs(value) >= 1e4 ? d3.format("~s")(value) : fine(value)).replace("-", "\u2212");

  /** A tick of a logarithmic axis: 14, 4.5e−5. */
  const short = (value) => (value >= 1e-2 && value < 1e4 ? fine(value) : d3.format(".2~e")(value)).replace("-", "\u2212");

  /** Ticks of a logarithmic axis: powers of ten, over less than four decades also 2 and 5 times these; over less than a factor of 10, round numbers. */
  function logarithmic(low, high) {
    if (!(high >= 10 * low)) return d3.ticks(low, high, 4);
    const digits = high < 1e4 * low ? [1, 2, 5] : [1];
    const exponents = d3.range(Math.floor(Math.log10(low)), Math.ceil(Math.log10(high)) + 1);
    return exponents.flatMap((exponent) => digits.map((digit) => digit * 10 ** exponent)).filter((tick) => tick >= low && tick <= high);
  }

  /** Grid and axis of a logarithmic scale over data from `low` to `high`; the usual ones leave out labels by a rule of their own. */
  function logarithmicAxis(name, title, [low, high], width) {
    let values = logarithmic(low, high);
    // Labels along a narrow axis: powers of ten, or every other value.
    while (name === "x" && values.length > 2 && 64 * values.length > width) {
      const powers = values.filter((value) => Number.isInteger(+Math.log10(value).toFixed(9)));
      values = powers.length > 1 && powers.length < values.length ? powers : values.filter((_, i) => i % 2 === 0);
    }
    const options = { text: short, label: title, labelAnchor: "center", labelArrow: "none" };
    return name === "x"
      ? [Plot.gridX(values), Plot.axisX(values, options)]
      : [Plot.gridY(values), Plot.axisY(values, options)];
  }

  /** What an axis covers: `values`, widened where they are one and the same, so that it has more than one tick. */
  function extent(values, isLog) {
    const [low, high] = d3.extent(values);
    // Round-off is not a range.
    if (!(high - low <= 1e-9 * Math.max(Math.abs(low), Math.abs(high)))) return [low, high];
    if (isLog) return [0.5 * low, 2 * high];
    const half = 0.05 * Math.abs(low) || 0.5;
    return [low - half, high + half];
  }

  const drawn = [];

  /** Draws again whenever the width of `element` changes. */
  function onWidth(element, draw) {
    let before = 0;
    const look = () => {
      const width = Math.floor(element.clientWidth);
      if (width > 0 && Math.abs(width - before) > 1) {
        before = width;
        draw(width);
      }
    };
    drawn.push(look);
    new ResizeObserver(look).observe(element);
  }

  // On paper, figures are drawn for its width: scaled down from the screen, their letters would be too small.
  addEventListener("beforeprint", () => {
    document.documentElement.dataset.paper = "true";
    for (const look of drawn) look();
  });
  addEventListener("afterprint", () => {
    delete document.documentElement.dataset.paper;
    for (const look of drawn) look();
  });

  const charts = new Map();

  /** The crack of a row of many that the page is about: whatever shows one follows it. */
  const crack = {
    now: 1,
    followers: [],
    follow(follower) { this.followers.push(follower); },
    choose(number) {
      this.now = number;
      for (const chart of charts.values()) chart.pick(number);
      for (const follower of this.followers) follower(number);
    },
  };

  /** Brings out the curves called `name` on all charts that have several; none: all alike. */
  function bringOut(name) {
    if (!document.getElementById("choices")) return;
    for (const chart of charts.values()) chart.emphasise(name);
    for (const row of document.querySelectorAll("tr[data-name]")) row.classList.toggle("out", Boolean(name) && row.dataset.name === name);
  }

  /** Domains with the same scale both ways around `points` on `inside` pixels of width, and the height that they need. */
  function toScale(points, inside) {
    const around = (values) => {
      const [low, high] = d3.extent(values);
      const air = 0.06 * ((high - low) || 1);
      return [low - air, high + air];
    };
    let [x, y] = [around(points.map((point) => point.x)), around(points.map((point) => point.y))];
    const widened = ([low, high], span) => [0.5 * (low + high - span), 0.5 * (low + high + span)];
    let perUnit = inside / (x[1] - x[0]);
    let height = perUnit * (y[1] - y[0]);
    if (height > 480) {
      perUnit = 480 / (y[1] - y[0]);
      [x, height] = [widened(x, inside / perUnit), 480];
    } else if (height < 140) {
      [y, height] = [widened(y, 140 / perUnit), 140];
    }
    return { x, y, height };
  }

  /** Builds the chart of a figure from the data in it. */
  function chart(figure) {
    const data = JSON.parse(figure.querySelector("script").textContent);
    const place = figure.querySelector(".drawing");
    const log = { x: data.x.scale === "log", y: data.y.scale === "log" };
    const curves = data.curves.map((curve) => ({
      ...curve,
      stroke: `var(--${curve.colour})`,
      points: curve.x
        .map((x, i) => ({ x, y: curve.y[i], name: curve.name, note: curve.note, dot: curve.dots === true || (curve.dots && curve.dots.includes(i)) }))
        .filter(({ x, y }) => x !== null && y !== null && !(log.x && x <= 0) && !(log.y && y <= 0)),
    })).filter((curve) => curve.points.length);
    const self = { svg: null, marks: [], mark, choose, emphasise, pick, curves };
    const names = document.createElement("div");
    if (data.legend) place.before(names);
    let shown = curves;
    // The bundle of many cracks, and of it those that are picked.
    const isBundle = curves.some((curve) => curve.fine);
    let picked = [];

    function drawLegend() {
      if (!data.legend) return;
      // Cracks of one run share a name; what the dashes say, the switches say where curves have any.
      const key = ({ name, stroke, look, note }) => `${name} ${stroke} ${note ? "" : look}`;
      const named = [...new Map(shown.filter((curve) => curve.name).map((curve) => [key(curve), curve])).values()];
      const own = picked.some((curve) => curve.fine) ? [{ name: picked[0].note, colour: "var(--ink)" }] : [];
      names.replaceChildren(...(named.length ? [legend([...named.map(({ name, stroke, look, dots, note }) => ({
        name, colour: stroke, dashes: note ? null : DASHES[look], dots: look === "dots" ? "only" : dots === true,
      })), ...own])] : []));
    }

    const title = ({ x, y, name, note }) =>
      [name && plain(name), note && plain(note), `${plain(data.x.title)}: ${words(x)}`, `${plain(data.y.title)}: ${words(y)}`].filter(Boolean).join("\n");

    /** What the curves that are shown span; of none, what all do. */
    const points = () => (shown.length ? shown : curves).flatMap((curve) => curve.points);

    /** What the axis `name` covers of `all`; its zero counts. */
    const covered = (name, all) => extent([...all.map((point) => point[name]), ...(data[name].zero ? [0] : [])], log[name]);

    // Room for the ticks and the title beside them, from the usual width of digits.
    function room(all) {
      const [low, high] = data.y.range ?? covered("y", all);
      const letters = log.y ? 6 : d3.max(d3.ticks(low ?? 0, high ?? 1, 6), (value) => ticks(value).length) ?? 4;
      return 36 + 7.4 * Math.max(3, letters);
    }

    function draw(width) {
      const all = points();
      const axes = { x: scale(data.x), y: scale(data.y) };
      const margin = { left: room(all), right: 20, top: 22, bottom: 44 };
      let height = Math.round(Math.min(320, Math.max(230, 0.55 * width)));
      for (const name of ["x", "y"]) {
        // Values that are one and the same; otherwise the marks say what is covered.
        const [low, high] = covered(name, all);
        if (axes[name].domain || data.equal || !all.length || all.some((point) => point[name] === low || point[name] === high)) continue;
        axes[name].domain = axes[name].reverse ? [high, low] : [low, high];
        axes[name].reverse = false;
      }
      if (data.equal) {
        const fit = toScale(all, width - margin.left - margin.right);
        axes.x.domain = fit.x;
        axes.y.domain = data.y.scale === "depth" ? [fit.y[1], fit.y[0]] : fit.y;
        axes.y.reverse = false;
        height = Math.round(fit.height) + margin.top + margin.bottom;
      }
      const above = picked.map((curve) => ({ ...curve, stroke: curve.fine ? "var(--ink)" : curve.stroke, wide: true, fine: false }));
      const marks = [...shown, ...above].flatMap(({ points, stroke, look, wide, fine }) => [
        look === "dots" ? null : Plot.line(points, { x: "x", y: "y", stroke, strokeWidth: wide ? 3.2 : fine ? 1 : 1.8, strokeOpacity: fine ? 0.45 : 1, strokeDasharray: DASHES[look] ?? null, clip: true }),
        points.some((point) => point.dot) ? Plot.dot(points.filter((point) => point.dot), { x: "x", y: "y", fill: stroke, r: 2.6, clip: true }) : null,
      ]);
      const corners = ({ x, y }) => [...x, x[0]].map((x, i) => ({ x, y: y[i % y.length] }));
      const areas = (data.areas ?? []).map((area) => Plot.line(corners(area), { x: "x", y: "y", fill: "var(--c4)", fillOpacity: 0.3, stroke: "var(--c4)", strokeDasharray: "4 3", className: "area" }));
      const notes = (data.notes ?? []).map(({ at, words }) => Plot.text([at], { x: "0", y: "1", text: () => plain(words), dy: -8 }));
      const inset = (axis) => (axis.range || data.equal ? 0 : 7);
      const under = shown.flatMap((curve) => curve.points);
      const svg = Plot.plot({
        width,
        height,
        marginLeft: margin.left,
        marginRight: margin.right,
        marginBottom: margin.bottom,
        marginTop: margin.top,
        ...axes,
        // Points at the ends are not cut off by the frame.
        insetLeft: inset(data.x),
        insetRight: inset(data.x),
        insetTop: inset(data.y),
        insetBottom: inset(data.y),
        ariaLabel: plain(data.caption),
        style: { fontSize: "12px", overflow: "visible" },
        marks: [
          Plot.frame({ stroke: "var(--line)" }),
          // The running surface.
          data.equal && data.y.scale === "depth" ? Plot.ruleY([0], { stroke: "var(--ink)", strokeWidth: 2 }) : null,
          ...["x", "y"].flatMap((name) => (log[name] && all.length ? logarithmicAxis(name, data[name].title, covered(name, all), width - margin.left) : [])),
          ...areas,
          ...marks,
          ...notes,
          Plot.tip(under, Plot.pointer({ x: "x", y: "y", title, fill: "var(--ground)", fontSize: 12, lineWidth: 32 })),
        ],
      });
      self.svg = typeset(svg);
      // The pointer on a curve brings it out everywhere on the page.
      svg.addEventListener("input", () => bringOut(svg.value?.name));
      place.replaceChildren(svg);
      drawMarks();
    }

    /** Shows the curves whose value of every group is on. */
    function choose(on) {
      shown = curves.filter((curve) => curve.choices.every((value, group) => on[group]?.has(value) ?? true));
      drawLegend();
      if (self.svg) draw(Math.floor(place.clientWidth));
    }

    /** Brings a crack of a bundle above the others. */
    function pick(number) {
      if (!isBundle) return;
      picked = curves.filter((curve) => new RegExp(`^crack ${number}(,|$)`).test(curve.note));
      drawLegend();
      if (self.svg) draw(Math.floor(place.clientWidth));
    }

    /** Lets all curves step back but those called `name`. */
    function emphasise(name) {
      if (!self.svg) return;
      const has = shown.some((curve) => curve.name === name);
      const lines = shown.filter((curve) => curve.look !== "dots");
      self.svg.querySelectorAll("g[aria-label=line]:not(.area)").forEach((group, i) => {
        group.style.opacity = has && lines[i]?.name !== name ? 0.25 : 1;
      });
    }

    function drawMarks() {
      if (!self.svg) return;
      const [x, y] = ["x", "y"].map((name) => self.svg.scale(name));
      d3.select(self.svg).selectAll("g.marks").data([0]).join("g").attr("class", "marks").attr("pointer-events", "none")
        .selectAll("circle").data(self.marks.filter((mark) => (!log.x || mark.x > 0) && (!log.y || mark.y > 0))).join("circle")
        .attr("cx", (mark) => x.apply(mark.x)).attr("cy", (mark) => y.apply(mark.y))
        .attr("data-x", (mark) => mark.x).attr("data-y", (mark) => mark.y)
        .attr("r", 6).attr("fill", "none").attr("stroke", "var(--ink)").attr("stroke-width", 2);
    }

    /** Rings around points that something else on the page points to. */
    function mark(points) {
      self.marks = points;
      drawMarks();
    }

    drawLegend();
    onWidth(place, draw);
    tools(figure);
    charts.set(figure.id, self);
    return self;
  }

  /** The SVG of a figure as a file of its own: colours resolved, on white. */
  function file(figure) {
    const svg = figure.querySelector(".drawing svg");
    const light = document.createElement("div");
    light.dataset.theme = "light";
    document.body.append(light);
    const style = getComputedStyle(light);
    const copy = svg.cloneNode(true);
    copy.setAttribute("xmlns", "http://www.w3.org/2000/svg");
    copy.style.background = "#ffffff";
    copy.style.fontFamily = "Helvetica, Arial, sans-serif";
    const text = new XMLSerializer().serializeToString(copy)
      .replace(/var\((--[\w-]+)\)/g, (all, name) => style.getPropertyValue(name).trim() || all)
      .replaceAll("currentColor", style.getPropertyValue("--ink").trim());
    light.remove();
    return { text, width: svg.clientWidth || +svg.getAttribute("width"), height: svg.clientHeight || +svg.getAttribute("height") };
  }

  function download(name, url) {
    const link = document.createElement("a");
    link.href = url;
    link.download = name;
    link.click();
  }

  /** The figure as PNG at three times the size of the screen. */
  async function png(figure) {
    const { text, width, height } = file(figure);
    const image = new Image();
    image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(text)}`;
    await image.decode();
    const canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = [3 * width, 3 * height];
    canvas.getContext("2d").drawImage(image, 0, 0, canvas.width, canvas.height);
    return canvas.toDataURL("image/png");
  }

  /** Buttons that keep a figure as a file. */
  function tools(figure) {
    const name = figure.dataset.name || figure.id;
    const bar = document.createElement("div");
    bar.className = "tools";
    const button = (label, action) => {
      const element = document.createElement("button");
      element.type = "button";
      element.textContent = label;
      element.title = `Save this figure as ${label}`;
      element.setAttribute("aria-label", `Save figure ${name} as ${label}`);
      element.addEventListener("click", action);
      bar.append(element);
    };
    button("SVG", () => download(`${name}.svg`, `data:image/svg+xml;charset=utf-8,${encodeURIComponent(file(figure).text)}`));
    button("PNG", async () => download(`${name}.png`, await png(figure)));
    figure.append(bar);
  }

  /** The button that changes between the system's theme, light and dark. */
  function theme() {
    const button = document.getElementById("theme");
    const root = document.documentElement;
    const names = { auto: "Theme: as the system", light: "Theme: light", dark: "Theme: dark" };
    const show = (name) => {
      if (name === "auto") delete root.dataset.theme;
      else root.dataset.theme = name;
      button.textContent = names[name];
    };
    // A page from a file may have no memory: then it begins anew each time.
    const memory = (action) => { try { return action(localStorage); } catch { return null; } };
    let now = memory((store) => store.getItem("railcrack-theme"));
    if (!(now in names)) now = "auto";
    show(now);
    button.hidden = false;
    button.addEventListener("click", () => {
      const order = Object.keys(names);
      now = order[(order.indexOf(now) + 1) % order.length];
      memory((store) => store.setItem("railcrack-theme", now));
      show(now);
    });
  }

  /** Headings of a table that sort its rows. */
  function sorts(table) {
    const value = (row, column) => row.cells[column]?.textContent.trim() ?? "";
    // Numbers as the page writes them: a true minus sign, thousands apart.
    const number = (text) => (/^[\u2212-]?\d/.test(text) ? parseFloat(text.replaceAll("\u2212", "-").replace(/[\u00a0 ](?=\d)/g, "")) : NaN);
    let [order, down] = [null, false];
    [...table.tHead.rows[0].cells].forEach((cell, column) => {
      const button = document.createElement("button");
      button.type = "button";
      button.append(...cell.childNodes);
      button.addEventListener("click", () => {
        [down, order] = [order === column ? !down : false, column];
        for (const other of table.tHead.rows[0].cells) other.removeAttribute("aria-sort");
        cell.setAttribute("aria-sort", down ? "descending" : "ascending");
        const sorted = [...table.tBodies[0].rows].sort((a, b) => {
          const [one, other] = [value(a, column), value(b, column)];
          const [x, y] = [number(one), number(other)];
          // What has no value comes last either way; other words after numbers.
          if (!one || !other) return Number(!one) - Number(!other);
          if (Number.isNaN(x) || Number.isNaN(y)) return (Number.isNaN(x) - Number.isNaN(y)) || (down ? other.localeCompare(one) : one.localeCompare(other));
          return down ? y - x : x - y;
        });
        table.tBodies[0].append(...sorted);
      });
      cell.append(button);
    });
  }

  theme();
  for (const table of document.querySelectorAll("table.sorts")) sorts(table);
  for (const figure of document.querySelectorAll("figure.chart")) chart(figure);

  return { words, plain, inParts, typeset, singles, levels, quantised, unpack, legend, scale, ticks, onWidth, tools, charts, png, bringOut, extent, short, logarithmic, crack, DASHES };
})();

// What the scripts of a page share: theme, numbers in words, packed numbers, axes and legends,
// figures as files, sliders, the controls of a passage.
"use strict";

const railcrack = (() => {
  // ---- Numbers and words ------------------------------------------------------------------------

  /** A true minus sign. @param {string} text */
  const minus = (text) => text.replaceAll("-", "\u2212");

  const fourDigits = d3.format(".4~g");

  /** A number for display: 1 197 467, 0.0464, 2.47e−6. @param {number} value */
  function words(value) {
    const size = Math.abs(value);
    if (size >= 1e4 && size < 1e15) return d3.format(",.0f")(value).replaceAll(",", "\u00a0");
    // Below that a value is round-off in every unit of a page.
    if (size < 1e-12) return "0";
    if (size >= 1e-3 && size < 1e4) return minus(fourDigits(value));
    return minus(d3.format(".3~e")(value));
  }

  /**
   * Fixed decimals, without a sign before zero.
   * @param {number} value
   * @param {number} digits
   */
  const signed = (value, digits) => minus(value.toFixed(digits).replace(/^-(?=[0.]*$)/, ""));

  /**
   * The tonnage of `cycles`, appended to a sentence; empty without an axle load (t).
   * @param {number} cycles
   * @param {number | null} axleLoad
   */
  const tonnage = (cycles, axleLoad) => (axleLoad ? `, ${words((cycles * axleLoad) / 1e6)} MGT` : "");

  /** Ticks of large numbers in thousands and millions. @param {number} value */
  const ticks = (value) => minus((Math.abs(value) >= 1e4 ? d3.format("~s") : fourDigits)(value));

  /** A tick of a logarithmic axis: 14, 4.5e−5. @param {number} value */
  const short = (value) => minus((value >= 1e-2 && value < 1e4 ? fourDigits : d3.format(".2~e"))(value));

  /**
   * `text` without its marks of indices and powers, for plain text.
   * @param {string} text
   */
  const plain = (text) => text.replace(/[_^]\{([^}]*)\}/g, "$1");

  /** Smallest and largest of `values`; of none, undefined. @param {Iterable<number>} values */
  const ends = (values) => /** @type {Pair} */ (d3.extent(values));

  // ---- Elements ---------------------------------------------------------------------------------

  /**
   * The element with this `id`, which the page must have.
   * @template {HTMLElement} [T=HTMLElement]
   * @param {string} id
   * @param {new () => T} [kind]
   */
  function element(id, kind) {
    const found = document.getElementById(id);
    if (!(found instanceof (kind ?? HTMLElement))) throw new Error(`the page has no ${id}`);
    return /** @type {T} */ (found);
  }

  /**
   * The first element within `place` that matches `selector`, which must exist.
   * @param {Element} place
   * @param {string} selector
   */
  function within(place, selector) {
    const found = place.querySelector(selector);
    if (!(found instanceof HTMLElement)) throw new Error(`the page has no ${selector}`);
    return found;
  }

  /**
   * The data called `id`.
   * @param {string} id
   */
  const pageData = (id) => JSON.parse(element(id).textContent);

  /**
   * A button with `text`.
   * @param {string} text
   * @param {() => void} [action]
   */
  function button(text, action) {
    const made = document.createElement("button");
    made.type = "button";
    made.textContent = text;
    if (action) made.addEventListener("click", action);
    return made;
  }

  /**
   * Puts `text` into `place`; long names can break after dots and underscores.
   * @template {Element} E
   * @param {E} place
   * @param {string} text
   */
  function inParts(place, text) {
    const parts = text.split(/(?<=[A-Za-z\])][._])(?=[A-Za-z])/);
    place.append(...parts.flatMap((part, i) => (i ? [document.createElement("wbr"), part] : [part])));
    return place;
  }

  /**
   * Sets the text of `place`, `K_{I}` with a lowered index.
   * @param {Element} place
   * @param {string} text
   */
  function say(place, text) {
    const parts = text.split(/_\{([^}]*)\}/);
    place.replaceChildren(
      ...parts.map((part, i) => {
        if (i % 2 === 0) return plain(part);
        const index = document.createElement("sub");
        index.textContent = part;
        return index;
      }),
    );
  }

  /** Lowers the indices and raises the powers in a text of an SVG. @param {SVGTextElement} text */
  function shiftIndices(text) {
    const parts = text.textContent.split(/([_^]\{[^}]*\})/);
    text.textContent = "";
    let shift = 0;
    for (const part of parts) {
      const [, mark, content] = /^([_^])\{(.*)\}$/.exec(part) ?? [null, null, part];
      const wanted = mark === "_" ? 0.3 : mark === "^" ? -0.4 : 0;
      const span = document.createElementNS("http://www.w3.org/2000/svg", "tspan");
      span.textContent = content;
      // The shift counts in the size of the surrounding letters, so it is taken back by the next
      // part.
      span.setAttribute("dy", `${((wanted - shift) * 12).toFixed(2)}`);
      if (mark) span.setAttribute("font-size", "75%");
      shift = wanted;
      text.append(span);
    }
  }

  /**
   * Sets `K_{I}` in the texts of an SVG with a lowered index.
   * @template {Element} E
   * @param {E} svg
   */
  function typeset(svg) {
    for (const text of svg.querySelectorAll("text")) {
      if (!text.children.length && /[_^]\{/.test(text.textContent)) shiftIndices(text);
    }
    return svg;
  }

  // ---- Packed numbers ---------------------------------------------------------------------------

  /** Bytes of base64 text that holds deflated data. @param {Packed} text */
  async function unpack(text) {
    const letters = atob(text);
    const deflated = new Uint8Array(letters.length);
    for (let i = 0; i < letters.length; i++) deflated[i] = letters.charCodeAt(i);
    const stream = new Blob([deflated]).stream().pipeThrough(new DecompressionStream("deflate"));
    return new Uint8Array(await new Response(stream).arrayBuffer());
  }

  /** Numbers in single precision. @param {Packed} text */
  const singles = async (text) => new Float32Array((await unpack(text)).buffer);

  /**
   * Whole numbers in rows of `row`: differences from one to the next, first low bytes, then high
   * ones.
   * @param {Packed} text
   * @param {number} [row]
   */
  async function levels(text, row = Number.POSITIVE_INFINITY) {
    const bytes = await unpack(text);
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

  /**
   * Quantised numbers: low + step × level.
   * @param {PackedLevels} packed
   * @param {number} [row]
   */
  const quantised = async ({ low, step, data }, row) =>
    Float64Array.from(await levels(data, row), (level) => low + step * level);

  // ---- Colours, legends, axes -------------------------------------------------------------------

  /** Dashes by the look of a curve. @type {Partial<Record<Look, string>>} */
  const DASHES = {
    dashed: "6 4",
    fine: "2 3",
    "dash-dot": "9 3 2 3",
    "varied-0": "14 4",
    "varied-1": "9 3 2 3 2 3",
    "varied-2": "2 6",
    "varied-3": "14 3 2 3",
    "varied-4": "4 4",
    "varied-5": "14 3 5 3",
    "varied-6": "6 3 2 3 2 3 2 3",
    "varied-7": "1 3",
    "varied-8": "10 8",
    "varied-9": "20 4 2 4",
  };

  const AXES = /** @type {const} */ (["x", "y"]);

  /** The box of values under the pointer. */
  const TIP = { fill: "var(--ground)", fontSize: 12 };

  /**
   * `count` colours of a quantity from zero (light) to its largest value (dark).
   * @param {number} count
   */
  const shades = (count) => d3.range(count).map((i) => d3.interpolateViridis(1 - i / (count - 1)));

  // Ordered colours: viridis without its lightest part on white, without its darkest on black.
  {
    /** @param {number} from @param {number} to */
    const list = (from, to) =>
      d3
        .range(21)
        .map((i) => `--s${i}: ${d3.rgb(d3.interpolateViridis(from + ((to - from) * i) / 20)).formatHex()};`)
        .join(" ");
    const [light, dark] = [list(0, 0.86), list(0.36, 1)];
    const style = document.createElement("style");
    style.textContent = `:root, [data-theme="light"] { ${light} }
      @media (prefers-color-scheme: dark) { :root:not([data-theme="light"]) { ${dark} } }
      :root[data-theme="dark"] { ${dark} }
      @media print { :root, :root[data-theme="dark"] { ${light} } }`;
    document.head.append(style);
  }

  /**
   * An entry of a legend: a line, dots, a box, or a row of colours.
   * @typedef {object} LegendEntry
   * @property {string} name
   * @property {string} [colour]
   * @property {string[]} [colours]
   * @property {string | null} [dashes]
   * @property {boolean} [box]
   * @property {boolean | "only"} [dots]
   */

  /** A list of names with the strokes that they stand for. @param {LegendEntry[]} entries */
  function legend(entries) {
    const list = document.createElement("ul");
    list.className = "legend";
    for (const { name, colour = "none", colours, dashes = null, box, dots } of entries) {
      const item = document.createElement("li");
      const mark = d3
        .create("svg")
        .attr("width", colours ? 108 : 26)
        .attr("height", 12)
        .attr("aria-hidden", "true");
      if (colours) {
        mark
          .selectAll("rect")
          .data(colours)
          .join("rect")
          .attr("x", (_, i) => 12 * i)
          .attr("width", 12.5)
          .attr("height", 12)
          .attr("fill", String);
      } else if (box) {
        const place = mark.append("rect").attr("x", 7).attr("width", 12).attr("height", 12);
        place.attr("fill", colour).attr("stroke", "var(--quiet)");
      } else {
        if (dots !== "only") {
          const line = mark.append("line").attr("x2", 26).attr("y1", 6).attr("y2", 6);
          line.attr("stroke", colour).attr("stroke-width", 2).attr("stroke-dasharray", dashes);
        }
        if (dots) mark.append("circle").attr("cx", 13).attr("cy", 6).attr("r", 3).attr("fill", colour);
      }
      const words = document.createElement("span");
      say(words, name);
      item.append(/** @type {Element} */ (mark.node()), words);
      list.append(item);
    }
    return list;
  }

  /**
   * The colours of a quantity from its smallest to its largest value.
   * @typedef {object} Shade
   * @property {Pair} domain
   * @property {boolean} log
   * @property {(value: number) => string} colour
   */

  /**
   * The ordered colours over `values`, evenly or by the logarithm.
   * @param {number[]} values
   * @param {boolean} [log]
   * @returns {Shade}
   */
  function shade(values, log = false) {
    const domain = values.length ? extent(values, log) : /** @type {Pair} */ ([1, 10]);
    const flat = log ? Math.log : (/** @type {number} */ value) => value;
    const [low, high] = domain.map(flat);
    /** @param {number} value */
    const level = (value) => Math.round(20 * Math.max(0, Math.min(1, (flat(value) - low) / (high - low))));
    return { domain, log, colour: (value) => `var(--s${level(value)})` };
  }

  /**
   * The scale of colours of a quantity: its colours between its smallest and largest value.
   * @param {string} title
   * @param {Shade} shade
   */
  function ramp(title, { domain, log }) {
    const [low, high] = domain;
    const scale = document.createElement("p");
    scale.className = "ramp";
    const svg = d3.create("svg").attr("width", 126).attr("height", 12).attr("aria-hidden", "true");
    for (const i of d3.range(21))
      svg
        .append("rect")
        .attr("x", 6 * i)
        .attr("width", 6.5)
        .attr("height", 12)
        .attr("fill", `var(--s${i})`);
    const colours = document.createElement("span");
    colours.append(words(low), /** @type {Element} */ (svg.node()), words(high));
    scale.append(`${title}${log ? " (logarithmic)" : ""}:`, colours);
    return scale;
  }

  /**
   * An axis: its title in the middle, round ticks.
   * @param {AxisData} axis
   * @returns {import("@observablehq/plot").ScaleOptions}
   */
  function scale(axis) {
    const isLog = axis.scale === "log";
    const ends = axis.range ?? null;
    return {
      label: axis.title,
      labelAnchor: "center",
      labelArrow: "none",
      ...(isLog ? { type: "log", grid: false } : { tickFormat: ticks, grid: true }),
      ...(axis.zero ? { zero: true } : {}),
      ...(ends ? { domain: axis.scale === "depth" ? [ends[1], ends[0]] : ends } : {}),
      ...(!ends && axis.scale === "depth" ? { reverse: true } : {}),
    };
  }

  /**
   * A linear axis over `domain`; without one, over the values.
   * @param {string} title
   * @param {number[]} [domain]
   * @returns {import("@observablehq/plot").ScaleOptions}
   */
  const linear = (title, domain) => ({ ...scale({ title, scale: "linear" }), ...(domain ? { domain } : {}) });

  /**
   * Ticks of a logarithmic axis: powers of ten, over less than four decades also 2 and 5 times
   * these; over less than a factor of 10, round numbers.
   * @param {number} low
   * @param {number} high
   */
  function logarithmic(low, high) {
    if (!(high >= 10 * low)) return d3.ticks(low, high, 4);
    const digits = high < 1e4 * low ? [1, 2, 5] : [1];
    const exponents = d3.range(Math.floor(Math.log10(low)), Math.ceil(Math.log10(high)) + 1);
    const all = exponents.flatMap((exponent) => digits.map((digit) => digit * 10 ** exponent));
    return all.filter((tick) => tick >= low && tick <= high);
  }

  /** @param {number} value */
  const isPowerOfTen = (value) => Number.isInteger(+Math.log10(value).toFixed(9));

  /**
   * Grid and axis of a logarithmic scale over data from `low` to `high`; the usual ones leave out
   * labels by a rule of their own.
   * @param {"x" | "y"} name
   * @param {string} title
   * @param {Pair} range
   * @param {number} width
   */
  function logarithmicAxis(name, title, [low, high], width) {
    let values = logarithmic(low, high);
    // Labels along a narrow axis: powers of ten, or every other value.
    while (name === "x" && values.length > 2 && 64 * values.length > width) {
      const powers = values.filter(isPowerOfTen);
      const isFewer = powers.length > 1 && powers.length < values.length;
      values = isFewer ? powers : values.filter((_, i) => i % 2 === 0);
    }
    const label = /** @type {const} */ ({ label: title, labelAnchor: "center", labelArrow: "none" });
    return name === "x"
      ? [Plot.gridX(values), Plot.axisX(values, { text: short, ...label })]
      : [Plot.gridY(values), Plot.axisY(values, { text: short, ...label })];
  }

  /**
   * The domain of an axis: `values`, widened where they are all equal, so that it has more
   * than one tick.
   * @param {number[]} values
   * @param {boolean} [isLog]
   * @returns {Pair}
   */
  function extent(values, isLog) {
    const [low, high] = ends(values);
    // Round-off is not a range.
    if (!(high - low <= 1e-9 * Math.max(Math.abs(low), Math.abs(high)))) return [low, high];
    if (isLog) return [0.5 * low, 2 * high];
    const half = 0.05 * Math.abs(low) || 0.5;
    return [low - half, high + half];
  }

  /**
   * The range of `values` with a margin at both ends.
   * @param {Iterable<number>} values
   * @returns {Pair}
   */
  function aired(values) {
    const [low, high] = ends(values);
    const air = 0.06 * (high - low || 1);
    return [low - air, high + air];
  }

  /**
   * Domains with one scale both ways on `inside` pixels of width, the height that they take and the
   * pixels of a unit. The height is at most `most`, for which x is widened, and at least `least`,
   * for which y is.
   * @param {Pair} x
   * @param {Pair} y
   * @param {number} inside
   * @param {{ most: number, least?: number }} height
   * @returns {{ x: Pair, y: Pair, height: number, perUnit: number }}
   */
  function toScale(x, y, inside, { most, least = 0 }) {
    /** @param {Pair} domain @param {number} span @returns {Pair} */
    const widened = ([low, high], span) => [0.5 * (low + high - span), 0.5 * (low + high + span)];
    const perUnit = inside / (x[1] - x[0]);
    const height = perUnit * (y[1] - y[0]);
    if (height > most) {
      const smaller = most / (y[1] - y[0]);
      return { x: widened(x, inside / smaller), y, height: most, perUnit: smaller };
    }
    if (height < least) return { x, y: widened(y, least / perUnit), height: least, perUnit };
    return { x, y, height, perUnit };
  }

  /**
   * Size and margins of a chart, and its letters.
   * @param {number} width
   * @param {number} height
   * @param {{ top: number, right: number, bottom: number, left: number }} margin
   */
  const sized = (width, height, { top, right, bottom, left }) => ({
    width,
    height: Math.round(height),
    marginTop: top,
    marginRight: right,
    marginBottom: bottom,
    marginLeft: left,
    style: { fontSize: "12px", overflow: "visible" },
  });

  /**
   * A scale of a drawn chart.
   * @param {Plotted} svg
   * @param {"x" | "y"} name
   */
  function scaleOf(svg, name) {
    const found = svg.scale(name);
    if (!found?.range) throw new Error(`a chart without a scale ${name}`);
    const [from, to] = found.range;
    const invert = found.invert ?? (() => Number.NaN);
    return { at: found.apply, value: invert, from: Number(from), to: Number(to) };
  }

  /**
   * The image at `url`, over the whole frame of a chart.
   * @param {string} url
   * @param {string} [rendering]
   * @returns {import("@observablehq/plot").RenderFunction}
   */
  const imageMark = (url, rendering) => (_index, _scales, _values, box) => {
    const image = d3.create("svg:image").attr("href", url).attr("preserveAspectRatio", "none");
    image.attr("x", box.marginLeft).attr("y", box.marginTop);
    if (rendering) image.style("image-rendering", rendering);
    image.attr("width", box.width - box.marginLeft - box.marginRight);
    image.attr("height", box.height - box.marginTop - box.marginBottom);
    return /** @type {SVGElement} */ (image.node());
  };

  /**
   * The Hertzian pressure of a wheel at `xc`, drawn `height` high above the surface.
   * @param {number} xc
   * @param {number} halfWidth
   * @param {number} height
   */
  const hertzianPressure = (xc, halfWidth, height) =>
    // Closer together at the edges, where the pressure rises steeply.
    d3.range(61).map((i) => {
      const angle = (Math.PI * i) / 60;
      return { x: xc - halfWidth * Math.cos(angle), y: -height * Math.sin(angle) };
    });

  // ---- Drawing ----------------------------------------------------------------------------------

  /** @type {(() => void)[]} */
  const drawn = [];

  /**
   * Draws again whenever the width of `place` changes.
   * @param {Element} place
   * @param {(width: number) => void} draw
   */
  function onWidth(place, draw) {
    let before = 0;
    const look = () => {
      const width = Math.floor(place.clientWidth);
      if (width > 0 && Math.abs(width - before) > 1) {
        before = width;
        draw(width);
      }
    };
    drawn.push(look);
    new ResizeObserver(look).observe(place);
  }

  // On paper, figures are drawn for its width: scaled down from the screen, their letters would be
  // too small.
  addEventListener("beforeprint", () => {
    document.documentElement.dataset.paper = "true";
    foot.textContent = `@page { @bottom-left { content: "${footText()}"; font: 8pt Arial, sans-serif; color: #444444; } }`;
    for (const look of [...themed, ...drawn]) look();
  });
  addEventListener("afterprint", () => {
    delete document.documentElement.dataset.paper;
    for (const look of [...themed, ...drawn]) look();
  });

  /** What draws images, whose colours are not those of the style. @type {(() => void)[]} */
  const themed = [];
  /** Draws again whenever the theme changes. @param {() => void} draw */
  const onTheme = (draw) => themed.push(draw);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
    for (const draw of themed) draw();
  });

  /** A colour of the page by its name in the style: of paper while it is printed. @param {string} name */
  function colourOf(name) {
    const { dataset } = document.documentElement;
    if (!dataset.paper)
      return d3.rgb(getComputedStyle(document.documentElement).getPropertyValue(name).trim());
    const light = document.createElement("div");
    light.dataset.theme = "light";
    document.body.append(light);
    const colour = d3.rgb(getComputedStyle(light).getPropertyValue(name).trim());
    light.remove();
    return colour;
  }

  /** Foot of the printed pages: title, date of the file, day of the print. */
  const foot = document.createElement("style");
  document.head.append(foot);
  function footText() {
    /** @param {Date} date */
    const day = (date) =>
      date.toLocaleDateString("en-GB", { day: "numeric", month: "long", year: "numeric" });
    const title = document.title.replace(/[\\"\n]/g, " ");
    return `${title.length > 60 ? `${title.slice(0, 59)}\u2026` : title} \u00b7 report of ${day(new Date(document.lastModified))}, printed ${day(new Date())}`;
  }

  /** The figure called `id`, drawn by a script. @param {string} id */
  function picture(id) {
    const figure = element(id);
    const drawing = within(figure, ".drawing");
    const self = {
      drawing,
      /** Pixels; 0 until it is on the page. */
      width: 0,
      /** @param {Element} svg */
      show: (svg) => drawing.replaceChildren(typeset(svg)),
      /** @param {LegendEntry[]} entries */
      explain: (entries) => within(figure, ".legends").replaceChildren(legend(entries)),
      /** @param {Element} legend */
      legend: (legend) => within(figure, ".legends").replaceChildren(legend),
      /** @param {string} text */
      caption(text) {
        within(figure, "figcaption").textContent = text;
      },
      /** Leaves `text` alone in the place of the drawing. */
      clear(text = "") {
        drawing.replaceChildren(text);
        for (const part of figure.querySelectorAll(".legends, figcaption")) part.replaceChildren();
      },
      /** Draws whenever the width changes. @param {(width: number) => void} draw */
      follow(draw) {
        onWidth(drawing, (width) => {
          self.width = width;
          draw(width);
        });
        tools(figure);
      },
    };
    return self;
  }

  /**
   * Builds a part of the page within the element `id`, which is ready when `build` is through.
   * Where it fails, a note says so; `name` and `advice` are its words.
   * @param {string} id
   * @param {string} name
   * @param {string} advice
   * @param {() => Promise<void>} build
   */
  function viewer(id, name, advice, build) {
    const place = element(id);
    build().then(
      () => {
        place.dataset.ready = "true";
      },
      (reason) => {
        const note = document.createElement("p");
        note.className = "failure";
        note.textContent = `${name} cannot be shown: ${reason.message}. A browser of 2023 or later is required; ${advice}.`;
        place.before(note);
        console.error(reason);
      },
    );
  }

  // ---- Controls ---------------------------------------------------------------------------------

  /**
   * The slider called `id`, of whole numbers from 0 to `last`; `moved` is given what the reader
   * sets.
   * @param {string} id
   * @param {number} last
   * @param {(value: number) => void} moved
   */
  function slider(id, last, moved) {
    const input = element(id, HTMLInputElement);
    const output = element(`${id}-value`);
    const self = {
      /** @param {number} last */
      endAt(last) {
        input.max = String(last);
        input.disabled = last < 1;
      },
      /** @param {number} value @param {string} text */
      show(value, text) {
        input.value = String(value);
        input.setAttribute("aria-valuetext", plain(text));
        say(output, text);
      },
    };
    self.endAt(last);
    input.addEventListener("input", () => moved(+input.value));
    return self;
  }

  /**
   * Growth step and wheel position, by their places among those of the page.
   * @typedef {{ step: number, position: number }} PassageState
   */

  /**
   * The name of a wheel in a menu; of a single wheel its number.
   * @param {{ name: string | null, share: number | null }} wheel
   * @param {number} i
   */
  const wheelName = ({ name, share }, i) =>
    share === null ? `${i + 1}` : `${i + 1} ${name}, ${+(100 * share).toPrecision(3)}\u00a0%`;

  /**
   * The menu of the wheels of a mix, which is not shown for a single one.
   * @param {{ name: string | null, share: number | null }[]} wheels
   * @param {(wheel: number) => void} choose
   */
  function wheelMenu(wheels, choose) {
    const menu = element("of-mix", HTMLSelectElement);
    menu.append(...wheels.map((wheel, i) => new Option(wheelName(wheel, i), String(i))));
    element("which-wheel").hidden = wheels.length < 2;
    menu.addEventListener("change", () => choose(+menu.value));
    return menu;
  }

  /**
   * The number of the position, of `positions` over the half-width `a`, that is nearest to `x` (mm).
   * @param {number[]} positions
   * @param {number} a
   * @param {number} x
   */
  const nearestPosition = (positions, a, x) =>
    d3.leastIndex(positions, (position) => Math.abs(position * a - x)) ?? 0;

  /** Time that a passage is played in, milliseconds. */
  const PLAYED_IN = 8000;

  /**
   * The controls of a passage: sliders for growth step and wheel position, a button that plays the
   * passage, and the arrow keys. They read `state` and call `moveTo` with the requested state.
   * @param {object} passage
   * @param {number} passage.steps
   * @param {() => number} passage.positions number of them, which may change with the state
   * @param {PassageState} passage.state
   * @param {(change: Partial<PassageState>) => void} passage.moveTo
   */
  function passageControls({ steps, positions, state, moveTo }) {
    const place = element("explorer");
    const play = element("play", HTMLButtonElement);
    /** The frame that is asked for while the passage is played. @type {number | null} */
    let playing = null;

    function stop() {
      if (playing !== null) cancelAnimationFrame(playing);
      playing = null;
      play.textContent = "Play the passage";
    }

    /** @param {number} value @param {number} count */
    const bounded = (value, count) => Math.max(0, Math.min(value, count - 1));
    /** @param {number} step */
    const toStep = (step) => {
      stop();
      moveTo({ step: bounded(step, steps) });
    };
    /** @param {number} position */
    const toPosition = (position) => {
      stop();
      moveTo({ position: bounded(position, positions()) });
    };

    play.addEventListener("click", () => {
      if (playing !== null) return stop();
      if (state.position === positions() - 1) moveTo({ position: 0 });
      play.textContent = "Stop";
      const [begun, from] = [performance.now(), state.position];
      /** @param {number} now */
      const next = (now) => {
        const played = Math.floor(((now - begun) / PLAYED_IN) * positions());
        moveTo({ position: bounded(from + played, positions()) });
        if (state.position >= positions() - 1) stop();
        else playing = requestAnimationFrame(next);
      };
      playing = requestAnimationFrame(next);
    });

    /**
     * Whether an arrow key is for the explorer: no control wants it, and the explorer is in view.
     * @param {KeyboardEvent} event
     */
    const isOwnKey = ({ target, key, ctrlKey, altKey, metaKey }) => {
      if (ctrlKey || altKey || metaKey || !(target instanceof Element)) return false;
      // The browser moves a slider itself; up and down change the step from the slider of the
      // wheel, too.
      const isControl = target.closest("input, select, textarea, summary, pre, a, button");
      if (isControl && !(target.id === "wheel" && /^Arrow(Up|Down)$/.test(key))) return false;
      const { top, bottom } = place.getBoundingClientRect();
      return bottom >= 0 && top <= innerHeight;
    };
    /** @type {Record<string, () => void>} */
    const keys = {
      ArrowLeft: () => toPosition(state.position - 1),
      ArrowRight: () => toPosition(state.position + 1),
      ArrowUp: () => toStep(state.step + 1),
      ArrowDown: () => toStep(state.step - 1),
    };
    document.addEventListener("keydown", (event) => {
      if (!(event.key in keys && isOwnKey(event))) return;
      keys[event.key]();
      event.preventDefault();
    });

    place.hidden = false;
    const [step, wheel] = [slider("step", steps - 1, toStep), slider("wheel", positions() - 1, toPosition)];
    return {
      stop,
      /**
       * Shows the state; `xc` is the contact centre, mm.
       * @param {string} stepText
       * @param {number} xcOverA
       * @param {number} xc
       */
      show(stepText, xcOverA, xc) {
        step.show(state.step, stepText);
        wheel.endAt(positions() - 1);
        wheel.show(state.position, `x_{c}/a = ${signed(xcOverA, 3)} (x_{c} = ${signed(xc, 2)} mm)`);
      },
    };
  }

  /**
   * Puts buttons into the `headings` of a table; `ordered` is told the column by which the reader
   * wants the rows, and whether the largest comes first.
   * @param {Iterable<HTMLElement>} headings
   * @param {(column: number, down: boolean) => void} ordered
   */
  function sortButtons(headings, ordered) {
    const all = [...headings];
    let [chosen, down] = [-1, false];
    for (const [column, heading] of all.entries()) {
      const click = button("", () => {
        [down, chosen] = [chosen === column && !down, column];
        for (const other of all) other.setAttribute("aria-sort", "none");
        heading.setAttribute("aria-sort", down ? "descending" : "ascending");
        ordered(column, down);
      });
      click.append(...heading.childNodes);
      heading.append(click);
      heading.setAttribute("aria-sort", "none");
    }
  }

  /**
   * The order of two values of a column: words after numbers, and what is missing (empty, not a
   * number) last, whichever comes first.
   * @param {number | string} one
   * @param {number | string} other
   * @param {boolean} down
   */
  function compared(one, other, down) {
    const [none, neither] = [one, other].map((value) => value === "" || Number.isNaN(value));
    if (none || neither) return Number(none) - Number(neither);
    const sign = down ? -1 : 1;
    if (typeof one === "string" && typeof other === "string") return sign * one.localeCompare(other);
    if (typeof one === "number" && typeof other === "number") return sign * (one - other);
    return typeof one === "string" ? 1 : -1;
  }

  /** Headings of a table that sort its rows. @param {HTMLTableElement} table */
  function sorts(table) {
    const [body, head] = [table.tBodies[0], table.tHead?.rows[0]];
    /** @param {HTMLTableRowElement} row @param {number} column */
    const value = (row, column) => {
      const text = row.cells[column]?.textContent.trim() ?? "";
      // Numbers as the page writes them: a true minus sign, thousands apart.
      if (!/^[\u2212-]?\d/.test(text)) return text;
      return Number.parseFloat(text.replaceAll("\u2212", "-").replace(/[\u00a0 ](?=\d)/g, ""));
    };
    sortButtons(head?.cells ?? [], (column, down) => {
      body.append(...[...body.rows].sort((a, b) => compared(value(a, column), value(b, column), down)));
    });
  }

  // ---- Charts and the chosen crack -------------------------------------------------------------------

  /**
   * A chart of the page, as other scripts see it.
   * @typedef {object} PageChart
   * @property {{ name: string, note: string, points: { x: number, y: number }[] }[]} curves
   * @property {(on: (Set<number> | null)[]) => void} choose Shows the curves whose value of every group is on.
   * @property {(number: number) => void} pick Brings a crack of a bundle above the others.
   * @property {(name?: string) => void} emphasise Lets all curves step back but those called `name`.
   * @property {(points: { x: number, y: number }[]) => void} mark Draws rings around points.
   */

  /** The charts by the names of their figures. @type {Map<string, PageChart>} */
  const charts = new Map();

  /** The chosen crack of a row: whatever shows one crack follows it. */
  const crack = {
    now: 1,
    followers: /** @type {((number: number) => void)[]} */ ([]),
    /** @param {(number: number) => void} follower */
    follow(follower) {
      this.followers.push(follower);
    },
    /** @param {number} number */
    choose(number) {
      this.now = number;
      for (const chart of charts.values()) chart.pick(number);
      for (const follower of this.followers) follower(number);
    },
  };

  /**
   * Highlights the curves called `name` on all charts with several curves; none: no highlight.
   * @param {string} [name]
   */
  function bringOut(name) {
    if (!document.getElementById("choices")) return;
    for (const chart of charts.values()) chart.emphasise(name);
    for (const row of /** @type {NodeListOf<HTMLElement>} */ (document.querySelectorAll("tr[data-name]")))
      row.classList.toggle("out", Boolean(name) && row.dataset.name === name);
  }

  // ---- Figures as files -------------------------------------------------------------------------

  /**
   * The SVG of a figure as a file of its own: colours resolved, on white.
   * @param {HTMLElement} figure
   */
  function file(figure) {
    const svg = figure.querySelector(".drawing svg");
    if (!(svg instanceof SVGSVGElement)) throw new Error(`${figure.id} is not drawn`);
    const light = document.createElement("div");
    light.dataset.theme = "light";
    document.body.append(light);
    const style = getComputedStyle(light);
    const copy = /** @type {SVGSVGElement} */ (svg.cloneNode(true));
    copy.setAttribute("xmlns", "http://www.w3.org/2000/svg");
    copy.style.background = "#ffffff";
    copy.style.fontFamily = "Helvetica, Arial, sans-serif";
    const text = new XMLSerializer()
      .serializeToString(copy)
      .replace(/var\((--[\w-]+)\)/g, (all, name) => style.getPropertyValue(name).trim() || all)
      .replaceAll("currentColor", style.getPropertyValue("--ink").trim());
    light.remove();
    const [width, height] = [svg.clientWidth, svg.clientHeight];
    return {
      text,
      width: width || Number(svg.getAttribute("width")),
      height: height || Number(svg.getAttribute("height")),
    };
  }

  /** @param {string} text */
  const svgUrl = (text) => `data:image/svg+xml;charset=utf-8,${encodeURIComponent(text)}`;

  /** @param {string} name @param {string} url */
  function download(name, url) {
    const link = document.createElement("a");
    link.href = url;
    link.download = name;
    link.click();
  }

  /** The figure as PNG at three times the size of the screen. @param {HTMLElement} figure */
  async function png(figure) {
    const { text, width, height } = file(figure);
    const image = new Image();
    image.src = svgUrl(text);
    await image.decode();
    const canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = [3 * width, 3 * height];
    canvas.getContext("2d")?.drawImage(image, 0, 0, canvas.width, canvas.height);
    return canvas.toDataURL("image/png");
  }

  /** Buttons that keep a figure as a file. @param {HTMLElement} figure */
  function tools(figure) {
    const name = figure.dataset.name || figure.id;
    const bar = document.createElement("div");
    bar.className = "tools";
    /** @param {string} format @param {() => void} action */
    const keep = (format, action) => {
      const made = button(format, action);
      made.title = `Save this figure as ${format}`;
      made.setAttribute("aria-label", `Save figure ${name} as ${format}`);
      bar.append(made);
    };
    keep("SVG", () => download(`${name}.svg`, svgUrl(file(figure).text)));
    keep("PNG", async () => download(`${name}.png`, await png(figure)));
    figure.append(bar);
  }

  // ---- The page itself --------------------------------------------------------------------------

  /** The button that switches between the system's theme, light and dark. */
  function theme() {
    const change = element("theme", HTMLButtonElement);
    const root = document.documentElement;
    /** @type {Record<string, string>} */
    const names = { auto: "Theme: system", light: "Theme: light", dark: "Theme: dark" };
    /** @param {string} name */
    const show = (name) => {
      if (name === "auto") delete root.dataset.theme;
      else root.dataset.theme = name;
      change.textContent = names[name];
    };
    // A page from a file may have no memory: then it begins anew each time.
    /** @param {(store: Storage) => string | null | void} action */
    const memory = (action) => {
      try {
        return action(localStorage);
      } catch {
        return null;
      }
    };
    const stored = memory((store) => store.getItem("railcrack-theme"));
    let now = stored && stored in names ? stored : "auto";
    show(now);
    change.hidden = false;
    change.addEventListener("click", () => {
      const order = Object.keys(names);
      now = order[(order.indexOf(now) + 1) % order.length];
      memory((store) => store.setItem("railcrack-theme", now));
      show(now);
      for (const draw of themed) draw();
    });
  }

  theme();
  for (const table of /** @type {NodeListOf<HTMLTableElement>} */ (document.querySelectorAll("table.sorts")))
    sorts(table);

  return {
    DASHES,
    TIP,
    AXES,
    aired,
    bringOut,
    button,
    charts,
    colourOf,
    compared,
    crack,
    element,
    ends,
    extent,
    hertzianPressure,
    imageMark,
    inParts,
    isPowerOfTen,
    legend,
    levels,
    linear,
    logarithmic,
    logarithmicAxis,
    nearestPosition,
    onTheme,
    onWidth,
    pageData,
    passageControls,
    picture,
    plain,
    png,
    quantised,
    ramp,
    say,
    scale,
    scaleOf,
    shade,
    shades,
    short,
    signed,
    singles,
    sized,
    slider,
    sortButtons,
    ticks,
    toScale,
    tonnage,
    tools,
    typeset,
    unpack,
    viewer,
    wheelMenu,
    within,
    words,
  };
})();

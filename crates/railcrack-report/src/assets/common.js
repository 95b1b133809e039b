// Shared by the scripts of a page: numbers, charts, sliders, tables, figures as files, theme.
"use strict";

const railcrack = (() => {
  // ---- Numbers and words ------------------------------------------------------------------------

  /** A true minus sign. @param {string} text */
  const minus = (text) => text.replaceAll("-", "\u2212");

  /** A number for display: 1 197 467, 0.0464, 2.47e−6. @param {number} value */
  function words(value) {
    const size = Math.abs(value);
    if (size >= 1e4 && size < 1e15) return minus(value.toFixed(0).replace(/\B(?=(\d{3})+$)/g, "\u00a0"));
    // Below that a value is round-off in every unit of a page.
    if (size < 1e-12) return "0";
    if (size >= 1e-3 && size < 1e4) return minus(String(+value.toPrecision(4)));
    return minus(value.toExponential(3).replace(/\.?0+e/, "e"));
  }

  /** Fixed decimals, without a sign before zero. @param {number} value @param {number} digits */
  const signed = (value, digits) => minus(value.toFixed(digits).replace(/^-(?=[0.]*$)/, ""));

  /** Load cycles with their tonnage where there is an axle load (t). @param {number} cycles @param {number | null} load */
  const traffic = (cycles, load) =>
    `${words(cycles)} cycles${load ? `, ${words((cycles * load) / 1e6)} MGT` : ""}`;

  /** `text` without its marks of indices and powers. @param {string} text */
  const plain = (text) => text.replace(/[_^]\{([^}]*)\}/g, "$1");

  /** Smallest and largest of `values`. @param {Iterable<number>} values @returns {Pair} */
  function ends(values) {
    let [low, high] = [Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY];
    for (const value of values) {
      if (value < low) low = value;
      if (value > high) high = value;
    }
    return [low, high];
  }

  /** Whole numbers from 0, `count` of them. @param {number} count */
  const range = (count) => Array.from({ length: count }, (_, i) => i);

  /** The place of the least value; 0 of none. @param {Iterable<number>} values */
  function leastIndex(values) {
    let [best, least, i] = [0, Number.POSITIVE_INFINITY, 0];
    for (const value of values) {
      if (value < least) [best, least] = [i, value];
      i++;
    }
    return best;
  }

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

  /** The first element within `place` that matches `selector`. @param {Element} place @param {string} selector */
  function within(place, selector) {
    const found = place.querySelector(selector);
    if (!(found instanceof HTMLElement)) throw new Error(`the page has no ${selector}`);
    return found;
  }

  /** All elements that match. @param {string} selector */
  const every = (selector) => /** @type {NodeListOf<HTMLElement>} */ (document.querySelectorAll(selector));

  /** The data called `id`. @param {string} id */
  const pageData = (id) => JSON.parse(element(id).textContent);

  /** A button with `text`. @param {string} text @param {() => void} action */
  function button(text, action) {
    const made = Object.assign(document.createElement("button"), { type: "button", textContent: text });
    made.addEventListener("click", action);
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

  /** Sets the text of `place`, `K_{I}` with a lowered index. @param {Element} place @param {string} text */
  function say(place, text) {
    const parts = text.split(/_\{([^}]*)\}/);
    place.replaceChildren(
      ...parts.map((part, i) =>
        i % 2 ? Object.assign(document.createElement("sub"), { textContent: part }) : plain(part),
      ),
    );
  }

  /** An element of an SVG. @param {string} name @param {Attributes} attributes @param {(Element | string)[]} children */
  function shape(name, attributes, ...children) {
    const made = document.createElementNS("http://www.w3.org/2000/svg", name);
    for (const [key, value] of Object.entries(attributes))
      if (value !== undefined) made.setAttribute(key, String(value));
    made.append(...children);
    return /** @type {SVGElement} */ (made);
  }

  // ---- Packed numbers ---------------------------------------------------------------------------

  /** Bytes of base64 text that holds deflated data. @param {Packed} text */
  async function unpack(text) {
    const deflated = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
    const stream = new Blob([deflated]).stream().pipeThrough(new DecompressionStream("deflate"));
    return new Uint8Array(await new Response(stream).arrayBuffer());
  }

  /** Numbers in single precision. @param {Packed} text */
  const singles = async (text) => new Float32Array((await unpack(text)).buffer);

  /**
   * Whole numbers in rows of `row`: differences from the number above, in the first row from the one
   * before; first low bytes, then high ones.
   * @param {Packed} text
   * @param {number} [row]
   */
  async function levels(text, row = Number.POSITIVE_INFINITY) {
    const bytes = await unpack(text);
    const made = new Uint16Array(bytes.length / 2);
    for (let i = 0; i < made.length; i++) {
      const folded = bytes[i] | (bytes[made.length + i] << 8);
      const near = made[i - (i < row ? 1 : row)] ?? 0;
      made[i] = near + ((folded >> 1) ^ -(folded & 1));
    }
    return made;
  }

  /** Quantised numbers: low + step × level. @param {PackedLevels} packed @param {number} [row] */
  const quantised = async ({ low, step, data }, row) =>
    Float64Array.from(await levels(data, row), (level) => low + step * level);

  // ---- Legends ----------------------------------------------------------------------------------

  /** A list of names with the strokes that they stand for. @param {LegendEntry[]} entries */
  function legend(entries) {
    const list = document.createElement("ul");
    list.className = "legend";
    for (const { name, colour = "none", dashes = "", mark } of entries) {
      const isScale = mark === "map" || mark === "ramp";
      const svg = shape("svg", { width: isScale ? 108 : 26, height: 12, "aria-hidden": "true" });
      if (isScale) {
        /** @param {number} i */
        const fill = (i) => (mark === "map" ? `var(--m${2 * i})` : shade(i / 8));
        svg.append(
          ...range(9).map((i) => shape("rect", { x: 12 * i, width: 12.5, height: 12, fill: fill(i) })),
        );
      } else if (mark === "box")
        svg.append(shape("rect", { x: 7, width: 12, height: 12, fill: colour, stroke: "var(--quiet)" }));
      else if (mark === "dot") svg.append(shape("circle", { cx: 13, cy: 6, r: 3, fill: colour }));
      else {
        const stroke = { stroke: colour, "stroke-width": 2, "stroke-dasharray": dashes };
        svg.append(shape("line", { x2: 26, y1: 6, y2: 6, ...stroke }));
      }
      const item = document.createElement("li");
      const text = document.createElement("span");
      say(text, name);
      item.append(svg, text);
      list.append(item);
    }
    return list;
  }

  /** The ordered colour at `part`, 0 to 1, of a quantity. @param {number} part */
  const shade = (part) => `var(--s${Math.round(20 * Math.max(0, Math.min(1, part)))})`;

  // ---- Charts -----------------------------------------------------------------------------------

  /** An axis as a chart has it. @param {string} text @param {string} title @returns {ChartAxis} */
  function axisOf(text, title) {
    const [ends, kind] = [text.split(" ").slice(0, 4).map(Number), text.split(" ")[4]];
    const [from, to, start, end] = ends;
    const flat = kind === "log" ? Math.log : Number;
    const span = (end - start) / (flat(to) - flat(from));
    return {
      title,
      from,
      to,
      start,
      end,
      log: kind === "log",
      at: (value) => start + (flat(value) - flat(from)) * span,
      value: (pixel) => {
        const level = flat(from) + (pixel - start) / span;
        return kind === "log" ? Math.exp(level) : level;
      },
    };
  }

  /** Pixels of a curve, read once: a curve that moves is another one. @type {WeakMap<Element, Pair[]>} */
  const read = new WeakMap();
  /** @param {Element} curve @returns {Pair[]} */
  function pixelsOf(curve) {
    const known = read.get(curve);
    if (known) return known;
    const line = curve.querySelector("polyline")?.getAttribute("points")?.trim().split(/\s+/) ?? [];
    const dots = line.length ? [] : [...curve.querySelectorAll("circle")];
    const pixels = [
      ...line.map((pair) => /** @type {Pair} */ (pair.split(",").map(Number))),
      ...dots.map(
        (dot) => /** @type {Pair} */ ([Number(dot.getAttribute("cx")), Number(dot.getAttribute("cy"))]),
      ),
    ];
    read.set(curve, pixels);
    return pixels;
  }

  /** How far from a curve (pixels of the drawing) the pointer finds it. */
  const REACH = 24;

  /**
   * The chart of a figure, as the program has drawn it. Scripts add to it and hide parts of it.
   * @param {HTMLElement} figure
   */
  function chartOf(figure) {
    const svg = figure.querySelector(".drawing svg");
    const place = svg?.querySelector("g.curves");
    if (!(svg instanceof SVGSVGElement && place)) throw new Error(`${figure.id} is no chart`);
    const [x, y] = [
      axisOf(svg.dataset.x ?? "", svg.dataset.xTitle ?? ""),
      axisOf(svg.dataset.y ?? "", svg.dataset.yTitle ?? ""),
    ];
    const drawn = [...place.children];
    /** @param {Pair[]} points */
    const pixels = (points) =>
      points.map(([px, py]) => `${+x.at(px).toFixed(2)},${+y.at(py).toFixed(2)}`).join(" ");
    const curves = () =>
      [...place.querySelectorAll("g.curve")].filter((curve) => curve instanceof SVGElement);
    /** @type {Map<string, SVGElement>} */
    const layers = new Map();
    /** @param {Event} event @returns {Pair} */
    const pointer = (event) => {
      const { clientX, clientY } = /** @type {MouseEvent} */ (event);
      const at = new DOMPoint(clientX, clientY).matrixTransform(svg.getScreenCTM()?.inverse());
      return [at.x, at.y];
    };
    const self = {
      figure,
      svg,
      x,
      y,
      pointer,
      /** A line through points. @param {Pair[]} points @param {Attributes} style */
      line: (points, style) => {
        const look = { fill: "none", "stroke-width": 2, "stroke-linejoin": "round", ...style };
        return shape("polyline", { points: pixels(points), ...look });
      },
      /** A line that has a name under the pointer. @param {string} name @param {Pair[]} points @param {Attributes} style */
      curve: (name, points, style) =>
        shape("g", { class: "curve", "data-name": name }, self.line(points, style)),
      /** A dot, with a title under the pointer. @param {Pair} at @param {Attributes} style @param {string} [title] */
      dot: ([px, py], style, title) =>
        shape(
          "circle",
          { cx: x.at(px), cy: y.at(py), r: 4, "data-x": px, "data-y": py, ...style },
          ...(title ? [shape("title", {}, title)] : []),
        ),
      /** A line across the chart at a value of x. @param {number} value @param {Attributes} style */
      upright: (value, style) => {
        const [at, ends] = [x.at(value), { y1: y.start, y2: y.end }];
        return shape("line", { x1: at, x2: at, ...ends, "data-x": value, "stroke-width": 1.5, ...style });
      },
      /** Words at a place. @param {Pair} at @param {string} text @param {Attributes} style */
      words: ([px, py], text, style) => {
        const look = { "font-size": 12, "text-anchor": "middle", fill: "var(--ink)", ...style };
        return shape("text", { x: x.at(px), y: y.at(py), ...look }, plain(text));
      },
      /** Shows `shapes` in the place of those that the layer had. @param {string} name @param {Element[]} shapes */
      show(name, shapes) {
        const layer = layers.get(name) ?? shape("g", { class: name });
        if (!layers.has(name)) place.append(layer);
        layers.set(name, layer);
        layer.replaceChildren(...shapes);
      },
      /** Shows what the program has drawn, or not. @param {boolean} isShown */
      background(isShown) {
        for (const one of drawn) one.classList.toggle("off", !isShown);
      },
      /** @param {LegendEntry[]} entries */
      explain: (entries) => within(figure, ".legends").replaceChildren(legend(entries)),
      /** @param {string} text */
      caption: (text) => say(within(figure, "figcaption"), text),
      /** Names and points of the curves. */
      curves: () =>
        curves().map((curve) => ({
          name: curve.dataset.name ?? "",
          note: curve.dataset.note ?? "",
          isShown: !curve.classList.contains("off"),
          look:
            curve.querySelector("polyline")?.outerHTML.replace(/ points="[^"]*"/, "") ??
            curve.querySelector("circle")?.getAttribute("fill"),
          points: pixelsOf(curve).map(([px, py]) => ({ x: x.value(px), y: y.value(py) })),
        })),
      /** Shows the curves whose value of every group is on. @param {(Set<number> | null)[]} on */
      choose(on) {
        for (const curve of curves()) curve.classList.toggle("off", !isChosen(curve.dataset.choices, on));
      },
      /** Brings a crack of a bundle above the others. @param {number} number */
      pick(number) {
        for (const curve of curves()) {
          const isPicked = new RegExp(`^crack ${number}(,|$)`).test(curve.dataset.note ?? "");
          curve.classList.toggle("picked", isPicked);
          if (isPicked) place.append(curve);
        }
      },
      /** Lets all curves step back but those called `name`. @param {string} [name] */
      emphasise(name) {
        const has = curves().some((curve) => curve.dataset.name === name);
        for (const curve of curves()) curve.classList.toggle("back", has && curve.dataset.name !== name);
      },
      /** Draws rings around points. @param {Pair[]} points */
      mark: (points) =>
        self.show(
          "marks",
          points
            .filter(([px, py]) => (!x.log || px > 0) && (!y.log || py > 0))
            .map((at) => self.dot(at, { r: 6, fill: "none", stroke: "var(--ink)", "stroke-width": 2 })),
        ),
    };
    tellUnderPointer(self, curves);
    return self;
  }

  /** Whether `choices` ("0,2") are on in every group. @param {string | undefined} choices @param {(Set<number> | null)[]} on */
  const isChosen = (choices, on) =>
    !choices || choices.split(",").every((value, group) => on[group]?.has(+value) ?? true);

  /**
   * The values of the point of a curve that is nearest to the pointer.
   * @param {ReturnType<typeof chartOf>} chart
   * @param {() => SVGElement[]} curves
   */
  function tellUnderPointer({ figure, svg, x, y, pointer }, curves) {
    const tip = Object.assign(document.createElement("div"), { className: "tip screen", hidden: true });
    tip.setAttribute("aria-label", "tip");
    figure.append(tip);
    svg.addEventListener("pointermove", (event) => {
      const [px, py] = pointer(event);
      let [best, least] = [/** @type {{ curve: SVGElement, at: Pair } | null} */ (null), REACH];
      for (const curve of curves().filter((one) => !one.classList.contains("off")))
        for (const at of pixelsOf(curve)) {
          const distance = Math.hypot(at[0] - px, at[1] - py);
          if (distance < least) [best, least] = [{ curve, at }, distance];
        }
      tip.hidden = !best;
      bringOut(best?.curve.dataset.name);
      if (!best) return;
      const { name = "", note = "" } = best.curve.dataset;
      const values = [
        `${x.title}: ${words(x.value(best.at[0]))}`,
        `${y.title}: ${words(y.value(best.at[1]))}`,
      ];
      tip.replaceChildren(
        ...[name, note, ...values].filter(Boolean).flatMap((line) => [line, document.createElement("br")]),
      );
      const { left, top, width } = figure.getBoundingClientRect();
      const [across, down] = [event.clientX - left, event.clientY - top];
      tip.style.cssText = across > 0.5 * width ? `right: ${width - across + 12}px` : `left: ${across + 12}px`;
      tip.style.top = `${down + 12}px`;
    });
    svg.addEventListener("pointerleave", () => {
      tip.hidden = true;
      bringOut();
    });
  }

  /** The charts by the names of their figures. @type {Map<string, ReturnType<typeof chartOf>>} */
  const charts = new Map();
  /** The chart called `id`. @param {string} id */
  function chart(id) {
    const found = charts.get(id);
    if (!found) throw new Error(`the page has no chart ${id}`);
    return found;
  }

  /** The chosen crack of a row: whatever shows one crack follows it. */
  const crack = {
    chosen: 1,
    followers: /** @type {((number: number) => void)[]} */ ([]),
    /** @param {number} number */
    choose(number) {
      this.chosen = number;
      for (const chart of charts.values()) chart.pick(number);
      for (const follower of this.followers) follower(number);
    },
  };

  /** Highlights the curves called `name`, and its row, where a page has several; none: no highlight. @param {string} [name] */
  function bringOut(name) {
    if (!document.getElementById("choices")) return;
    for (const chart of charts.values()) chart.emphasise(name);
    for (const row of every("tr[data-name]"))
      row.classList.toggle("out", Boolean(name) && row.dataset.name === name);
  }

  /** The Hertzian pressure of a wheel at `xc`, `height` high at its middle. @param {number} xc @param {number} a @param {number} height */
  const hertzianPressure = (xc, a, height) =>
    // Closer together at the edges, where the pressure rises steeply.
    range(61).map(
      (i) =>
        /** @type {Pair} */ ([xc - a * Math.cos((Math.PI * i) / 60), height * Math.sin((Math.PI * i) / 60)]),
    );

  /**
   * Builds a part of the page within the element `id`, which is ready when `build` is through.
   * Where it fails, a note says so; `name` and `advice` are its words.
   * @param {string} id
   * @param {string} name
   * @param {string} advice
   * @param {() => Promise<void> | void} build
   */
  function viewer(id, name, advice, build) {
    const place = element(id);
    Promise.resolve()
      .then(build)
      .then(
        () => {
          place.dataset.ready = "true";
        },
        (reason) => {
          const note = Object.assign(document.createElement("p"), { className: "failure" });
          note.textContent = `${name} cannot be shown: ${reason.message}. A browser of 2023 or later is required; ${advice}.`;
          place.before(note);
          console.error(reason);
        },
      );
  }

  // ---- Controls ---------------------------------------------------------------------------------

  /**
   * The slider called `id`, of whole numbers from 0 to `last`; `moved` is given what the reader sets.
   * @param {string} id
   * @param {number} last
   * @param {(value: number) => void} moved
   */
  function slider(id, last, moved) {
    const [input, output] = [element(id, HTMLInputElement), element(`${id}-value`)];
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

  /** A menu with these options, which tells what is chosen. @param {string} id @param {MenuOption[]} options @param {(value: string) => void} choose */
  function menu(id, options, choose) {
    const select = element(id, HTMLSelectElement);
    select.append(...options.map(({ name, value }) => new Option(plain(name), String(value))));
    select.addEventListener("change", () => choose(select.value));
    return select;
  }

  /**
   * The controls of a passage: sliders for growth step and wheel position, menus of wheels and cracks.
   * They read `state` and call `moveTo` with the requested state. Another wheel stands at its position
   * nearest to that of the wheel before.
   * @param {Passage} passage
   */
  function passageControls({ steps, wheels, cracks, state, moveTo, chooseCrack }) {
    const positions = () => wheels[state.wheel].xc_over_a;
    const names = wheels.map(({ name, share }, i) =>
      share === null ? `${i + 1}` : `${i + 1} ${name}, ${+(100 * share).toPrecision(3)}\u00a0%`,
    );
    const wheelMenu = menu(
      "of-mix",
      names.map((name, value) => ({ name, value })),
      (value) => {
        const [before, after] = [wheels[state.wheel], wheels[+value]];
        const xc = before.xc_over_a[state.position] * before.half_width;
        const position = leastIndex(after.xc_over_a.map((over) => Math.abs(over * after.half_width - xc)));
        moveTo({ wheel: +value, position });
      },
    );
    const numbers = range(cracks).map((i) => ({ name: `${i + 1}`, value: i + 1 }));
    const crackMenu = menu("crack", numbers, (value) => chooseCrack(+value));
    element("which-wheel").hidden = wheels.length < 2;
    element("which").hidden = cracks < 2;
    const step = slider("step", steps - 1, (step) => moveTo({ step }));
    const wheel = slider("wheel", positions().length - 1, (position) => moveTo({ position }));
    return {
      /** Shows the state; `xc` is the contact centre, mm. @param {string} stepText @param {number} xc */
      show(stepText, xc) {
        step.show(state.step, stepText);
        wheel.endAt(positions().length - 1);
        const over = signed(positions()[state.position], 3);
        wheel.show(state.position, `x_{c}/a = ${over} (x_{c} = ${signed(xc, 2)} mm)`);
        wheelMenu.value = String(state.wheel);
        crackMenu.value = String(state.crack);
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

  // ---- Figures as files -------------------------------------------------------------------------

  /** The SVG of a figure as a file of its own: colours resolved, on white. @param {HTMLElement} figure */
  function file(figure) {
    const svg = figure.querySelector(".drawing svg");
    if (!(svg instanceof SVGSVGElement)) throw new Error(`${figure.id} is not drawn`);
    const light = document.createElement("div");
    light.dataset.theme = "light";
    document.body.append(light);
    const style = getComputedStyle(light);
    const copy = /** @type {SVGSVGElement} */ (svg.cloneNode(true));
    for (const hidden of copy.querySelectorAll(".off")) hidden.remove();
    const { width, height } = svg.viewBox.baseVal;
    const given = {
      xmlns: "http://www.w3.org/2000/svg",
      width,
      height,
      "font-family": "Helvetica, Arial, sans-serif",
    };
    for (const [key, value] of Object.entries(given)) copy.setAttribute(key, String(value));
    copy.style.background = "#ffffff";
    const text = new XMLSerializer()
      .serializeToString(copy)
      .replace(/var\((--[\w-]+)\)/g, (all, name) => style.getPropertyValue(name).trim() || all);
    light.remove();
    return text;
  }

  /** @param {string} name @param {string} kind @param {string} text */
  const download = (name, kind, text) => {
    const href = `data:${kind};charset=utf-8,${encodeURIComponent(text)}`;
    Object.assign(document.createElement("a"), { href, download: name }).click();
  };

  /** A button that keeps a figure as a file. @param {HTMLElement} figure */
  function tools(figure) {
    const keep = button("SVG", () => download(`${figure.id}.svg`, "image/svg+xml", file(figure)));
    keep.setAttribute("aria-label", `Save figure ${figure.id} as SVG`);
    keep.className = "tools";
    figure.append(keep);
  }

  // ---- The page itself --------------------------------------------------------------------------

  /** Foot of the printed pages: title, date of the file, day of the print. */
  const foot = document.createElement("style");
  document.head.append(foot);
  addEventListener("beforeprint", () => {
    /** @param {Date} date */
    const day = (date) =>
      date.toLocaleDateString("en-GB", { day: "numeric", month: "long", year: "numeric" });
    const title = document.title.replace(/[\\"\n]/g, " ");
    const short = title.length > 60 ? `${title.slice(0, 59)}\u2026` : title;
    const text = `${short} \u00b7 report of ${day(new Date(document.lastModified))}, printed ${day(new Date())}`;
    foot.textContent = `@page { @bottom-left { content: "${text}"; font: 8pt Arial, sans-serif; color: #444444; } }`;
  });

  for (const table of every("table.sorts")) sorts(/** @type {HTMLTableElement} */ (table));
  for (const figure of every("figure.chart")) {
    charts.set(figure.id, chartOf(figure));
    tools(figure);
  }

  return {
    bringOut,
    button,
    chart,
    chartOf,
    charts,
    compared,
    crack,
    download,
    element,
    ends,
    every,
    hertzianPressure,
    inParts,
    isChosen,
    leastIndex,
    legend,
    levels,
    menu,
    pageData,
    passageControls,
    plain,
    file,
    quantised,
    range,
    say,
    shade,
    shape,
    signed,
    singles,
    slider,
    sortButtons,
    tools,
    traffic,
    unpack,
    viewer,
    within,
    words,
  };
})();

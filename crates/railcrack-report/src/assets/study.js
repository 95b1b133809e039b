// A study of many runs: two keys against each other, what results depend on, a table, one run on
// demand.
"use strict";

railcrack.viewer("study-table", "The runs", "summary.csv has them", async () => {
  const { compared, element, extent, inParts, picture, plain, singles, sized, ticks, within, words } =
    railcrack;
  const data = /** @type {StudyData} */ (railcrack.pageData("study-data"));

  /**
   * A column with its values, also as text.
   * @typedef {Awaited<ReturnType<typeof unpacked>>} Column
   */

  /** @param {ColumnData} column */
  async function unpacked(column) {
    const values = await singles(column.data);
    /** @param {number} i */
    const text = (i) => {
      if (column.words) return column.words[values[i]] ?? "";
      if (column.name === "run") return String(values[i]);
      return Number.isNaN(values[i]) ? "" : words(values[i]);
    };
    return { ...column, values, text, plainTitle: plain(column.title) };
  }
  const columns = await Promise.all(data.columns.map(unpacked));
  const runs = columns[0];
  const count = runs.values.length;
  const all = d3.range(count);
  const named = new Map(columns.map((column) => [column.name, column]));
  const numbers = columns.filter((column) => !column.words && column.name !== "run");
  let rows = all;
  /** The run that is shown in detail. @type {number | null} */
  let chosen = null;

  // ---- Menus ------------------------------------------------------------------------------------

  /**
   * A menu of columns or results.
   * @param {string} id
   * @param {{ name: string, title: string }[]} list
   * @param {{ name: string } | undefined} first
   */
  function menu(id, list, first) {
    const select = element(id, HTMLSelectElement);
    select.append(...list.map(({ name, title }) => new Option(plain(title), name)));
    if (first) select.value = first.name;
    return select;
  }
  const keys = numbers.filter((column) => column.key);
  const firstResult = numbers.find((column) => !column.key) ?? numbers[0];
  const menus = [
    menu("study-x", numbers, keys[0] ?? numbers[0]),
    menu("study-y", numbers, keys[1] ?? firstResult),
    menu("study-z", numbers, firstResult),
  ];
  const resultMenu = menu("study-result", data.results, data.results[0]);

  // ---- Two keys against each other --------------------------------------------------------------

  const figures = {
    scatter: picture("study-scatter"),
    heat: picture("study-heat"),
    life: picture("study-life"),
  };
  const MARGIN = { left: 74, right: 20, top: 22, bottom: 44 };
  const LABEL = /** @type {const} */ ({ labelAnchor: "center", labelArrow: "none" });

  /**
   * @param {Column} column
   * @param {number[]} there
   * @returns {import("@observablehq/plot").ScaleOptions}
   */
  const axis = (column, there) => ({
    label: column.plainTitle,
    ...LABEL,
    domain: there.length ? extent(valuesOf(column, there), column.log) : [1, 10],
    ...(column.log ? { type: "log", ticks: 4, tickFormat: words } : { ticks: 5, tickFormat: ticks }),
  });
  /** @param {Column} column @param {number[]} there */
  const valuesOf = (column, there) => there.map((i) => column.values[i]);
  /** @param {Column} column @param {number} i */
  const isDrawable = (column, i) => !Number.isNaN(column.values[i]) && (!column.log || column.values[i] > 0);
  /** @param {number} width */
  const common = (width) => ({
    ...sized(width, Math.min(340, Math.max(240, 0.62 * width)), MARGIN),
    grid: true,
    inset: 7,
  });

  /** The three columns that are chosen, and the runs that have all of them. */
  function picked() {
    const [x, y, z] = menus.map((menu) => named.get(menu.value) ?? numbers[0]);
    return { x, y, z, there: rows.filter((i) => [x, y, z].every((column) => isDrawable(column, i))) };
  }

  /**
   * A chart of the chosen columns.
   * @param {number} width
   * @param {ReturnType<typeof picked>} picked
   * @param {import("@observablehq/plot").Markish[]} marks
   */
  const plotted = (width, { x, y, z, there }, marks) =>
    Plot.plot({
      ...common(width),
      x: axis(x, there),
      y: axis(y, there),
      color: { scheme: "viridis", type: z.log ? "log" : "linear", label: z.plainTitle },
      marks: [Plot.frame({ stroke: "var(--line)" }), ...marks],
    });

  // More dots than this show no more, and take seconds.
  const MOST = 1500;

  /**
   * A number in [0, 1) for run `i`, the same on every page. Low bits of the number of a sample say
   * where it lies: every fourth one leaves out half of a key.
   * @param {number} i
   */
  function chance(i) {
    let bits = i + 1;
    for (let round = 0; round < 2; round++) bits = Math.imul(bits ^ (bits >>> 16), 0x45d9f3b);
    return ((bits ^ (bits >>> 16)) >>> 0) / 2 ** 32;
  }

  /** @param {number} width */
  function scatter(width) {
    const choice = picked();
    const { x, y, z, there } = choice;
    const shown = there.filter((i) => chance(i) * there.length < MOST);
    const place = {
      x: (/** @type {number} */ i) => x.values[i],
      y: (/** @type {number} */ i) => y.values[i],
    };
    /** @param {number} i */
    const title = (i) =>
      [`run ${runs.text(i)}`, ...[x, y, z].map((column) => `${column.plainTitle}: ${column.text(i)}`)].join(
        "\n",
      );
    const isDrawn = chosen !== null && [x, y].every((column) => isDrawable(column, chosen ?? 0));
    const svg = plotted(width, choice, [
      Plot.dot(shown, { ...place, fill: (i) => z.values[i], r: 2.4, fillOpacity: 0.8 }),
      isDrawn ? Plot.dot([chosen], { ...place, r: 7, stroke: "var(--ink)", strokeWidth: 2 }) : null,
      Plot.tip(shown, Plot.pointer({ ...place, title, fill: "var(--ground)" })),
    ]);
    svg.addEventListener("click", () => {
      if (typeof svg.value === "number") choose(svg.value);
    });
    figures.scatter.show(svg);
    const drawn =
      shown.length === there.length ? `All ${there.length}` : `${shown.length} of ${there.length}`;
    figures.scatter.caption(`${drawn} runs; colour: ${z.plainTitle}.`);
  }

  /** @param {number} width */
  function heat(width) {
    const choice = picked();
    const { x, y, z, there } = choice;
    if (!there.length) return;
    /** Cells along an axis. @param {Column} column */
    const cut = (column) => {
      const flat = column.log ? Math.log10 : (/** @type {number} */ value) => value;
      const [low, high] = extent(valuesOf(column, there), column.log).map(flat);
      const cells = Math.max(2, Math.min(14, new Set(valuesOf(column, there)).size));
      /** @param {number} k */
      const edge = (k) => {
        const level = low + ((high - low) * k) / cells;
        return column.log ? 10 ** level : level;
      };
      /** @param {number} i */
      const of = (i) =>
        Math.min(cells - 1, Math.floor(((flat(column.values[i]) - low) / (high - low)) * cells));
      return { of, edge };
    };
    const [across, up] = [cut(x), cut(y)];
    const groups = d3.group(
      there,
      (i) => across.of(i),
      (i) => up.of(i),
    );
    const cells = [...groups].flatMap(([i, column]) =>
      [...column].map(([j, group]) => ({
        x1: across.edge(i),
        x2: across.edge(i + 1),
        y1: up.edge(j),
        y2: up.edge(j + 1),
        z: d3.median(valuesOf(z, group)) ?? Number.NaN,
        n: group.length,
      })),
    );
    /** @param {(typeof cells)[number]} cell */
    const title = (cell) => `${z.plainTitle}: ${words(cell.z)} (median of ${cell.n} runs)`;
    const sides = { x1: "x1", x2: "x2", y1: "y1", y2: "y2" };
    figures.heat.show(plotted(width, choice, [Plot.rect(cells, { ...sides, fill: "z", inset: 0.5, title })]));
    figures.heat.caption(`Median of ${z.plainTitle} in each cell; cells without runs are empty.`);
  }

  // ---- What a result depends on -----------------------------------------------------------------

  /**
   * Bars of an estimate for each key.
   * @param {"rank" | "sobol"} estimates
   * @param {string} label
   * @param {string} caption
   * @param {Pair} domain
   */
  function bars(estimates, label, caption, domain) {
    const figure = picture(`study-${estimates}`);
    const draw = () => {
      if (!figure.width) return;
      const result = data.results.find(({ name }) => name === resultMenu.value);
      const list = (result?.[estimates] ?? []).flatMap(({ key, estimate }) =>
        estimate ? [{ key, value: estimate[0], low: estimate[1], high: estimate[2] }] : [],
      );
      const titles = list.map(({ key }) => key);
      const left = Math.min(0.45 * figure.width, 24 + 7.2 * (d3.max(titles, (text) => text.length) ?? 4));
      /** The end of a long key says more than its beginning. @param {string} text */
      const shortened = (text) =>
        7.2 * text.length > left - 20 ? `\u2026${text.slice(-Math.floor((left - 30) / 7.2))}` : text;
      const svg = Plot.plot({
        ...sized(figure.width, 66 + 24 * Math.max(1, list.length), { left, right: 20, top: 10, bottom: 44 }),
        x: { label, ...LABEL, grid: true, domain },
        y: { label: null, domain: titles, tickFormat: shortened },
        marks: [
          Plot.barX(list, { y: "key", x: "value", fill: "var(--c0)" }),
          Plot.link(list, {
            y1: "key",
            y2: "key",
            x1: "low",
            x2: "high",
            stroke: "var(--ink)",
            strokeWidth: 2,
          }),
          Plot.ruleX([0], { stroke: "var(--ink)" }),
        ],
      });
      figure.show(svg);
      const of = `${caption} of ${plain(result?.title ?? "")}; the line is the 95 % confidence interval.`;
      figure.caption(list.length ? of : `${caption}: too few runs.`);
    };
    resultMenu.addEventListener("change", draw);
    figure.follow(draw);
  }

  // ---- The table --------------------------------------------------------------------------------

  const SHOWN = 25;
  /** @type {{ column: Column, down: boolean } | null} */
  let order = null;
  let page = 0;
  const table = element("study-table", HTMLTableElement);
  const [head, body] = [within(table, "thead"), within(table, "tbody")];
  const [earlier, later] = [
    element("study-less", HTMLButtonElement),
    element("study-more", HTMLButtonElement),
  ];
  const filter = element("study-filter", HTMLInputElement);

  const headings = columns.map((column) => {
    const cell = inParts(document.createElement("th"), column.plainTitle);
    if (!column.words) cell.className = "number";
    return cell;
  });
  railcrack.sortButtons(headings, (place, down) => {
    order = { column: columns[place], down };
    page = 0;
    list();
  });
  const headRow = document.createElement("tr");
  headRow.append(...headings);
  head.append(headRow);

  /** @param {number} i */
  function tableRow(i) {
    const row = document.createElement("tr");
    row.tabIndex = 0;
    row.dataset.run = runs.text(i);
    row.classList.toggle("out", i === chosen);
    for (const column of columns) {
      const cell = document.createElement("td");
      cell.textContent = column.text(i);
      if (!column.words) cell.className = "number";
      row.append(cell);
    }
    row.addEventListener("click", () => choose(i));
    row.addEventListener("keydown", (event) => {
      if (event.key === "Enter") choose(i);
    });
    return row;
  }

  /** The rows of the page of the table, in their order. */
  function ordered() {
    if (!order) return rows;
    const { column, down } = order;
    /** @param {number} i */
    const value = (i) => (column.words ? column.text(i) : column.values[i]);
    return rows.toSorted((a, b) => compared(value(a), value(b), down));
  }

  function list() {
    const sorted = ordered();
    const pages = Math.max(1, Math.ceil(sorted.length / SHOWN));
    page = Math.max(0, Math.min(page, pages - 1));
    body.replaceChildren(...sorted.slice(page * SHOWN, (page + 1) * SHOWN).map(tableRow));
    element("study-page").textContent = `page ${page + 1} of ${pages}`;
    element("study-count").textContent = `${rows.length} of ${count} runs`;
    earlier.disabled = page === 0;
    later.disabled = page >= pages - 1;
  }
  /** @param {number} pages */
  const turn = (pages) => {
    page += pages;
    list();
  };
  earlier.addEventListener("click", () => turn(-1));
  later.addEventListener("click", () => turn(1));

  /** @type {Record<string, (a: string | number, b: string | number) => boolean>} */
  const COMPARED = {
    "<": (a, b) => a < b,
    "<=": (a, b) => a <= b,
    ">": (a, b) => a > b,
    ">=": (a, b) => a >= b,
    "=": (a, b) => a === b,
    "!=": (a, b) => a !== b,
  };

  /**
   * Whether a run meets a condition such as `stop = arrest`; none where it cannot be read.
   * @param {string} text
   */
  function condition(text) {
    const [, name, sign, value] = /^\s*(.+?)\s*(<=|>=|!=|<|>|=)\s*(.+?)\s*$/.exec(text) ?? [];
    const column = name && (named.get(name) ?? columns.find((other) => other.name.endsWith(name)));
    if (!column) return [];
    const compare = COMPARED[sign];
    if (column.words) return [(/** @type {number} */ i) => compare(column.text(i), value)];
    return [(/** @type {number} */ i) => compare(column.values[i], Math.fround(Number(value)))];
  }

  filter.addEventListener("input", () => {
    const conditions = filter.value.split(",").flatMap(condition);
    rows = all.filter((i) => conditions.every((holds) => holds(i)));
    page = 0;
    list();
    redraw();
  });

  // ---- One run ----------------------------------------------------------------------------------

  const one = element("study-one");
  const [first, cycles, lengths] = await Promise.all([data.first, data.cycles, data.lengths].map(singles));

  /** @param {number} width */
  function life(width) {
    if (chosen === null) return;
    const points = d3.range(first[chosen], first[chosen + 1]).map((k) => ({ x: cycles[k], y: lengths[k] }));
    const svg = Plot.plot({
      ...common(width),
      x: { label: "Load cycles (axles)", ...LABEL, tickFormat: ticks },
      y: { label: "Crack length (mm)", ...LABEL },
      marks: [
        Plot.frame({ stroke: "var(--line)" }),
        Plot.line(points, { x: "x", y: "y", stroke: "var(--c0)", strokeWidth: 2 }),
        Plot.dot(points, { x: "x", y: "y", fill: "var(--c0)", r: 3 }),
      ],
    });
    figures.life.show(svg);
    figures.life.caption("Crack length against load cycles of this run.");
  }

  /** Shows a run in detail. @param {number} i */
  function choose(i) {
    chosen = i;
    one.hidden = false;
    const number = runs.text(i);
    within(one, "h3").textContent = `Run ${number}`;
    const values = columns.slice(1).map((column) => `${column.plainTitle}: ${column.text(i)}`);
    within(one, "p").textContent =
      `${values.join("; ")}. For its report: railcrack report DIR --run ${number}`;
    life(Math.floor(figures.life.drawing.clientWidth));
    list();
    redraw();
  }

  function redraw() {
    if (figures.scatter.width) scatter(figures.scatter.width);
    if (figures.heat.width) heat(figures.heat.width);
  }

  for (const menu of menus) menu.addEventListener("change", redraw);
  list();
  figures.scatter.follow(scatter);
  figures.heat.follow(heat);
  bars("rank", "Rank correlation", "Rank correlation (Spearman)", [-1, 1]);
  const share = "First-order Sobol index, the share of the variance explained by the key alone,";
  bars("sobol", "First-order index", share, [0, 1]);
  figures.life.follow(life);
});

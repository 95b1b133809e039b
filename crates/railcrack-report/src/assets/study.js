// A study of many runs: two keys against each other, what results depend on, how they scatter, a
// table, one run on demand.
"use strict";

railcrack.viewer("study-table", "The runs", "summary.csv has them", async () => {
  const {
    compared,
    element,
    extent,
    inParts,
    picture,
    plain,
    ramp,
    shade,
    short,
    singles,
    sized,
    ticks,
    within,
    words,
  } = railcrack;
  const data = /** @type {StudyData} */ (railcrack.pageData("study-data"));

  /** Most values of a key that an axis shows one by one. */
  const MOST_LEVELS = 24;

  /**
   * A column with its values, also as text.
   * @typedef {Awaited<ReturnType<typeof unpacked>>} Column
   */

  /** @param {ColumnData} column */
  async function unpacked(column) {
    const values = await singles(column.data);
    /** @param {number} value */
    const wording = (value) => {
      if (column.words) return column.words[value] ?? "";
      if (column.name === "run") return String(value);
      return Number.isNaN(value) ? "" : words(value);
    };
    /** @param {number} i */
    const text = (i) => wording(values[i]);
    // A key of few values, each in many runs, is a list; samples have a value each.
    const distinct = d3.sort(new Set(values.filter((value) => !Number.isNaN(value))));
    const isList = column.key && distinct.length <= MOST_LEVELS && 2 * distinct.length < values.length;
    const levels = column.words || isList ? distinct : null;
    /** Where a run lies on an axis: at its value, or at the place of it in the list. */
    const places = levels ? values.map((value) => d3.bisectLeft(levels, value)) : values;
    return { ...column, values, text, wording, levels, places, plainTitle: plain(column.title) };
  }
  const columns = await Promise.all(data.columns.map(unpacked));
  const runs = columns[0];
  const count = runs.values.length;
  const all = d3.range(count);
  const named = new Map(columns.map((column) => [column.name, column]));
  const others = columns.slice(1);
  const numbers = others.filter((column) => !column.words);
  const keys = others.filter((column) => column.key);
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
  const firstResult = numbers.find((column) => !column.key) ?? numbers[0];
  const menus = [
    menu("study-x", others, keys[0] ?? numbers[0]),
    menu("study-y", others, keys[1] ?? firstResult),
    menu("study-z", numbers, firstResult),
  ];
  const resultMenu = menu("study-result", data.results, data.results[0]);
  const resultNow = () => named.get(resultMenu.value) ?? firstResult;

  // ---- Two keys against each other --------------------------------------------------------------

  const figures = {
    scatter: picture("study-scatter"),
    heat: picture("study-heat"),
    histogram: picture("study-histogram"),
    parallel: picture("study-parallel"),
    life: picture("study-life"),
  };
  const LABEL = /** @type {const} */ ({ labelAnchor: "center", labelArrow: "none" });

  /** @param {Column} column @param {number[]} there */
  const valuesOf = (column, there) => there.map((i) => column.values[i]);
  /** @param {Column} column @param {number} i */
  const isDrawable = (column, i) => !Number.isNaN(column.values[i]) && (!column.log || column.values[i] > 0);
  /** The words of the values of a list. @param {Column} column */
  const levelWords = (column) => (column.levels ?? []).map((value) => column.wording(value));
  /** Pixels of a text. @param {string} text */
  const widthOf = (text) => 6.8 * text.length;

  /**
   * Size of a chart with room for the words of the vertical axis.
   * @param {number} width
   * @param {Column} y
   */
  function common(width, y) {
    const longest = d3.max(levelWords(y), widthOf) ?? 0;
    const left = Math.max(74, Math.min(0.4 * width, 36 + longest));
    const margin = { left, right: 20, top: 12, bottom: 44 };
    return { ...sized(width, Math.min(340, Math.max(240, 0.62 * width)), margin), grid: true, inset: 7 };
  }

  /**
   * @param {Column} column
   * @param {number[]} there
   * @param {number} room pixels of the axis
   * @returns {import("@observablehq/plot").ScaleOptions}
   */
  function axis(column, there, room) {
    const label = { label: column.plainTitle, ...LABEL };
    if (column.levels) {
      const names = levelWords(column);
      const every = Math.max(1, Math.ceil(((d3.max(names, widthOf) ?? 0) + 10) / (room / names.length)));
      const shown = d3.range(0, names.length, every);
      return {
        ...label,
        domain: [-0.5, names.length - 0.5],
        ticks: shown,
        tickFormat: (k) => names[k] ?? "",
      };
    }
    const domain = there.length ? extent(valuesOf(column, there), column.log) : [1, 10];
    if (!column.log) return { ...label, domain, ticks: 5, tickFormat: ticks };
    return { ...label, domain, type: "log", ticks: 4, tickFormat: short };
  }

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
  function plotted(width, { x, y, there }, marks) {
    const size = common(width, y);
    const [across, up] = [size.width - size.marginLeft - 20, size.height - 56];
    return Plot.plot({
      ...size,
      x: axis(x, there, across),
      // Words of the vertical axis need a line each.
      y: y.levels
        ? {
            ...axis(y, there, 1e9),
            ticks: d3.range(0, y.levels.length, Math.ceil((16 * y.levels.length) / up)),
          }
        : axis(y, there, up),
      color: { type: "identity" },
      marks: [Plot.frame({ stroke: "var(--line)" }), ...marks],
    });
  }

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

  /**
   * Where a run is drawn: runs of the same value of a list lie beside one another.
   * @param {Column} column
   * @param {number} salt
   */
  const placed = (column, salt) => (/** @type {number} */ i) =>
    column.levels ? column.places[i] + 0.7 * (chance(i + salt) - 0.5) : column.places[i];

  /** @param {number} width */
  function scatter(width) {
    const choice = picked();
    const { x, y, z, there } = choice;
    const shown = there.filter((i) => chance(i) * there.length < MOST);
    const tone = shade(valuesOf(z, there), z.log);
    const place = { x: placed(x, 7919), y: placed(y, 104729) };
    /** @param {number} i */
    const title = (i) =>
      [`run ${runs.text(i)}`, ...[x, y, z].map((column) => `${column.plainTitle}: ${column.text(i)}`)].join(
        "\n",
      );
    const isDrawn = chosen !== null && [x, y].every((column) => isDrawable(column, chosen ?? 0));
    const svg = plotted(width, choice, [
      Plot.dot(shown, { ...place, fill: (i) => tone.colour(z.values[i]), r: 2.6, fillOpacity: 0.85 }),
      isDrawn ? Plot.dot([chosen], { ...place, r: 7, stroke: "var(--ink)", strokeWidth: 2 }) : null,
      Plot.tip(shown, Plot.pointer({ ...place, title, fill: "var(--ground)" })),
    ]);
    svg.addEventListener("click", () => {
      if (typeof svg.value === "number") choose(svg.value, "there");
    });
    figures.scatter.show(svg);
    figures.scatter.legend(ramp(z.plainTitle, tone));
    const drawn =
      shown.length === there.length ? `All ${there.length}` : `${shown.length} of ${there.length}`;
    const lists = [x, y].filter((column) => column.levels).map((column) => column.plainTitle);
    const beside = lists.length ? ` Runs with the same ${lists.join(" and ")} are spread around it.` : "";
    figures.scatter.caption(`${drawn} runs, coloured by ${z.plainTitle}.${beside}`);
  }

  /** Cells along an axis: one for each value of a list, else of equal width. @param {Column} column @param {number[]} there */
  function cut(column, there) {
    if (column.levels)
      return {
        of: (/** @type {number} */ i) => column.places[i],
        edge: (/** @type {number} */ k) => k - 0.5,
      };
    const flat = column.log ? Math.log10 : (/** @type {number} */ value) => value;
    const [low, high] = extent(valuesOf(column, there), column.log).map(flat);
    const cells = Math.max(3, Math.min(14, Math.round(Math.sqrt(there.length / 6))));
    /** @param {number} k */
    const edge = (k) => {
      const level = low + ((high - low) * k) / cells;
      return column.log ? 10 ** level : level;
    };
    /** @param {number} i */
    const of = (i) =>
      Math.min(cells - 1, Math.floor(((flat(column.values[i]) - low) / (high - low)) * cells));
    return { of, edge };
  }

  /** @param {number} width */
  function heat(width) {
    const choice = picked();
    const { x, y, z, there } = choice;
    if (!there.length) return figures.heat.clear("No run meets the conditions.");
    const [across, up] = [cut(x, there), cut(y, there)];
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
    const tone = shade(
      cells.map((cell) => cell.z),
      z.log,
    );
    /** @param {(typeof cells)[number]} cell */
    const title = (cell) => `${z.plainTitle}: ${words(cell.z)} (median of ${cell.n} runs)`;
    const sides = { x1: "x1", x2: "x2", y1: "y1", y2: "y2" };
    const mark = Plot.rect(cells, { ...sides, fill: (cell) => tone.colour(cell.z), inset: 0.5, title });
    figures.heat.show(plotted(width, choice, [mark]));
    figures.heat.legend(ramp(`Median of ${z.plainTitle}`, tone));
    const [least, most] = railcrack.ends(cells.map((cell) => cell.n));
    const runsEach = least === most ? `${least}` : `${least} to ${most}`;
    figures.heat.caption(
      `Median of ${z.plainTitle} in each cell, of ${runsEach} runs; cells without runs are empty.`,
    );
  }

  // ---- What a result depends on -----------------------------------------------------------------

  /** The estimates of the program for all runs, those of the page for some. @param {"rank" | "sobol"} estimates */
  function estimated(estimates) {
    const result = resultNow();
    if (rows.length === count)
      return data.results.find(({ name }) => name === result.name)?.[estimates] ?? [];
    const of = estimates === "rank" ? studyStatistics.rankCorrelation : studyStatistics.firstOrder;
    return keys
      .filter((key) => estimates === "sobol" || !key.words)
      .map((key) => {
        const there = rows.filter((i) => isDrawable(result, i) && !Number.isNaN(key.values[i]));
        const level = result.log ? Math.log : (/** @type {number} */ value) => value;
        return { key: key.name, estimate: of(valuesOf(key, there), valuesOf(result, there).map(level)) };
      });
  }

  /**
   * Bars of an estimate for each key.
   * @param {"rank" | "sobol"} estimates
   * @param {string} label
   * @param {(result: Column) => string} caption
   * @param {Pair} domain
   */
  function bars(estimates, label, caption, domain) {
    const figure = picture(`study-${estimates}`);
    const draw = () => {
      if (!figure.width) return;
      const list = estimated(estimates).flatMap(({ key, estimate }) =>
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
      const of = caption(resultNow());
      const whose = rows.length === count ? `all ${count} runs` : `the ${rows.length} selected runs`;
      const text = `${of}, of ${whose}; the line is the 95 % confidence interval.`;
      figure.caption(list.length ? text : `${of}: too few runs.`);
    };
    resultMenu.addEventListener("change", draw);
    figure.follow(draw);
    return draw;
  }

  // ---- How results scatter ----------------------------------------------------------------------

  const SHARES = [0.05, 0.25, 0.5, 0.75, 0.95];
  /** @param {number} share */
  const percent = (share) => (share === 0.5 ? "median" : `${Math.round(100 * share)} %`);

  function histogram() {
    const figure = figures.histogram;
    if (!figure.width) return;
    const result = resultNow();
    const there = rows.filter((i) => isDrawable(result, i));
    if (there.length < 2) return figure.clear("Too few runs.");
    const flat = result.log ? Math.log10 : (/** @type {number} */ value) => value;
    const back = result.log
      ? (/** @type {number} */ level) => 10 ** level
      : (/** @type {number} */ level) => level;
    const levels = valuesOf(result, there).map(flat);
    const [low, high] = extent(valuesOf(result, there), result.log).map(flat);
    const bins = Math.max(5, Math.min(40, Math.round(Math.sqrt(there.length))));
    const edges = d3.range(bins + 1).map((k) => low + ((high - low) * k) / bins);
    const counts = new Array(bins).fill(0);
    for (const level of levels)
      counts[Math.min(bins - 1, Math.floor(((level - low) / (high - low)) * bins))]++;
    const cells = counts.map((n, k) => ({ x1: back(edges[k]), x2: back(edges[k + 1]), n }));
    const marked = [0.05, 0.5, 0.95].map((share) => ({
      share,
      x: d3.quantile(valuesOf(result, there), share) ?? 0,
    }));
    figure.show(
      Plot.plot({
        ...common(figure.width, numbers[0]),
        x: axis(result, there, figure.width - 94),
        y: { label: "Runs", ...LABEL, domain: [0, 1.12 * Math.max(...counts)], ticks: 5, tickFormat: ticks },
        marks: [
          Plot.rect(cells, {
            x1: "x1",
            x2: "x2",
            y1: 0,
            y2: "n",
            fill: "var(--c0)",
            fillOpacity: 0.6,
            inset: 0.5,
            title: ({ x1, x2, n }) => `${n} runs from ${words(x1)} to ${words(x2)}`,
          }),
          Plot.ruleX(marked.slice(1, 2), { x: "x", stroke: "var(--ink)" }),
          Plot.ruleX([marked[0], marked[2]], { x: "x", stroke: "var(--ink)", strokeDasharray: "4 3" }),
          Plot.ruleY([0], { stroke: "var(--ink)" }),
        ],
      }),
    );
    const missing = rows.length - there.length;
    const without = missing ? ` ${missing === 1 ? "1 run has" : `${missing} runs have`} none.` : "";
    const lines = marked.map(({ share, x }) => `${percent(share)} ${words(x)}`).join(", ");
    figure.caption(`${result.plainTitle} of ${there.length} runs; lines: ${lines}.${without}`);
  }

  /** More lines than this are a plain area. */
  const MOST_LINES = 300;

  function parallel() {
    const figure = figures.parallel;
    if (!figure.width) return;
    const result = resultNow();
    const axes = [...keys, result];
    const there = rows.filter((i) => axes.every((column) => isDrawable(column, i)));
    if (there.length < 2) return figure.clear("Too few runs.");
    const shown = there.filter((i) => chance(i) * there.length < MOST_LINES);
    const tone = shade(valuesOf(result, there), result.log);
    const scales = axes.map((column) => {
      if (column.levels) {
        const most = column.levels.length - 1;
        const ends = [column.wording(column.levels[0]), column.wording(column.levels[most])];
        return { share: (/** @type {number} */ i) => (most ? column.places[i] / most : 0.5), ends };
      }
      const flat = column.log ? Math.log : (/** @type {number} */ value) => value;
      const domain = extent(valuesOf(column, there), column.log);
      const [low, high] = domain.map(flat);
      return {
        share: (/** @type {number} */ i) => (flat(column.values[i]) - low) / (high - low),
        ends: domain.map(words),
      };
    });
    const points = shown.flatMap((i) => scales.map(({ share }, axis) => ({ i, axis, share: share(i) })));
    // Names where there is room for them; otherwise letters, which the caption explains.
    const ends = axes.map((column) => (column.key ? column.name.split(".").slice(-1)[0] : column.plainTitle));
    const last = new Set(ends).size < ends.length ? axes.map((column) => column.plainTitle) : ends;
    const half = (d3.max(last, widthOf) ?? 0) / 2;
    const isRoomy = 2 * half < (figure.width - 2 * half) / (axes.length - 1);
    const names = isRoomy ? last : axes.map((_, k) => String.fromCharCode(65 + k));
    const side = isRoomy ? Math.max(40, half + 4) : 40;
    const margin = { left: side, right: side, top: 26, bottom: 68 };
    const text = { fill: "currentColor", fontSize: 11 };
    figure.show(
      Plot.plot({
        ...sized(figure.width, 300, margin),
        x: {
          label: "Keys and the result",
          ...LABEL,
          domain: [0, axes.length - 1],
          ticks: d3.range(axes.length),
          tickFormat: (k) => names[k] ?? "",
          tickSize: 0,
          tickPadding: 28,
        },
        y: { axis: null, domain: [0, 1] },
        color: { type: "identity" },
        marks: [
          Plot.line(points, {
            x: "axis",
            y: "share",
            z: "i",
            stroke: ({ i }) => tone.colour(result.values[i]),
            strokeOpacity: 0.55,
          }),
          chosen !== null && there.includes(chosen)
            ? Plot.line(
                scales.map(({ share }, axis) => ({ axis, share: share(chosen ?? 0) })),
                { x: "axis", y: "share", stroke: "var(--ink)", strokeWidth: 3 },
              )
            : null,
          Plot.ruleX(d3.range(axes.length), { stroke: "var(--quiet)" }),
          Plot.text(scales, { x: (_, k) => k, y: 0, dy: 16, text: ({ ends }) => ends[0], ...text }),
          Plot.text(scales, { x: (_, k) => k, y: 1, dy: -12, text: ({ ends }) => ends[1], ...text }),
        ],
      }),
    );
    figure.legend(ramp(result.plainTitle, tone));
    const drawn =
      shown.length === there.length ? `All ${there.length}` : `${shown.length} of ${there.length}`;
    const lettered = isRoomy
      ? ""
      : ` ${axes.map((column, k) => `${names[k]} ${column.plainTitle}`).join("; ")}.`;
    figure.caption(
      `${drawn} runs, a line each through its keys and its ${result.plainTitle}, which colours it.${lettered}`,
    );
  }

  const quantileTable = element("study-quantiles", HTMLTableElement);

  /** The quantiles of every result. */
  function quantiles() {
    const body = numbers
      .filter((column) => !column.key)
      .map((column) => {
        const there = valuesOf(
          column,
          rows.filter((i) => !Number.isNaN(column.values[i])),
        );
        const row = document.createElement("tr");
        const name = inParts(document.createElement("th"), column.plainTitle);
        name.scope = "row";
        const cells = SHARES.map((share) =>
          there.length ? words(d3.quantile(there, share) ?? 0) : "\u2013",
        );
        row.append(name, ...[String(there.length), ...cells].map(numberCell));
        return row;
      });
    within(quantileTable, "tbody").replaceChildren(...body);
  }

  /** @param {string} text */
  function numberCell(text) {
    const cell = document.createElement("td");
    cell.className = "number";
    cell.textContent = text;
    return cell;
  }

  const quantileHead = document.createElement("tr");
  for (const text of ["Result", "Runs", ...SHARES.map(percent)]) {
    const cell = document.createElement("th");
    cell.scope = "col";
    cell.textContent = text;
    if (text !== "Result") cell.className = "number";
    quantileHead.append(cell);
  }
  within(quantileTable, "thead").append(quantileHead);

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
    cell.scope = "col";
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
    for (const [place, column] of columns.entries()) {
      const cell = document.createElement(place ? "td" : "th");
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

  filter.addEventListener("input", () => {
    const { conditions, faults } = studyConditions.read(filter.value, columns);
    rows = all.filter((i) => conditions.every((holds) => holds(i)));
    page = 0;
    const says = element("study-unknown");
    says.hidden = faults.length === 0;
    says.textContent = faults.length ? `Not understood, and left out: ${faults.join("; ")}.` : "";
    filter.setAttribute("aria-invalid", String(faults.length > 0));
    selected();
  });

  // ---- One run ----------------------------------------------------------------------------------

  const one = element("study-one");
  const [first, cycles, lengths] = await Promise.all([data.first, data.cycles, data.lengths].map(singles));

  /** @param {number} width */
  function life(width) {
    if (chosen === null) return;
    const points = d3.range(first[chosen], first[chosen + 1]).map((k) => ({ x: cycles[k], y: lengths[k] }));
    const svg = Plot.plot({
      ...common(width, numbers[0]),
      x: { label: "Load cycles (axles)", ...LABEL, ticks: 5, tickFormat: ticks },
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

  /**
   * Shows a run in detail, and the page of the table with its row; a run chosen on a chart is
   * brought into view there.
   * @param {number} i
   * @param {"here" | "there"} [from] Whether it was chosen in the table.
   */
  function choose(i, from = "here") {
    chosen = i;
    page = Math.max(0, Math.floor(ordered().indexOf(i) / SHOWN));
    one.hidden = false;
    const number = runs.text(i);
    within(one, "h3").textContent = `Run ${number}`;
    const values = columns.slice(1).map((column) => `${column.plainTitle}: ${column.text(i)}`);
    within(one, "p").textContent =
      `${values.join("; ")}. For its report: railcrack report DIR --run ${number}`;
    life(Math.floor(figures.life.drawing.clientWidth));
    list();
    if (from === "there") body.querySelector("tr.out")?.scrollIntoView({ block: "nearest" });
    redraw();
  }

  function redraw() {
    if (figures.scatter.width) scatter(figures.scatter.width);
    if (figures.heat.width) heat(figures.heat.width);
    parallel();
  }

  const draws = [
    bars(
      "rank",
      "Rank correlation",
      ({ plainTitle }) => `Rank correlation (Spearman) with ${plainTitle}`,
      [-1, 1],
    ),
    bars(
      "sobol",
      "First-order index",
      ({ plainTitle, log }) =>
        `First-order Sobol index, the share of the variance of ${log ? "the logarithm of " : ""}${plainTitle} explained by the key alone`,
      [0, 1],
    ),
    histogram,
  ];

  /** Everything that shows the selected runs. */
  function selected() {
    list();
    quantiles();
    redraw();
    for (const draw of draws) draw();
  }

  for (const menu of menus) menu.addEventListener("change", redraw);
  resultMenu.addEventListener("change", () => {
    histogram();
    parallel();
  });
  list();
  quantiles();
  figures.scatter.follow(scatter);
  figures.heat.follow(heat);
  figures.histogram.follow(histogram);
  figures.parallel.follow(parallel);
  figures.life.follow(life);
});

// A study of many runs: two columns against each other, scatter, a table, one run; conditions select.
"use strict";

railcrack.viewer("study-table", "The runs", "summary.csv has them", async () => {
  const { compared, element, inParts, menu, plain, range, shade, shape, singles, within, words } = railcrack;
  const data = /** @type {StudyData} */ (railcrack.pageData("study-data"));

  /** A column with its values, also as text. @typedef {Awaited<ReturnType<typeof unpacked>>} Column */
  /** @param {ColumnData} column */
  async function unpacked(column) {
    const values = await singles(column.data);
    const { axis, levels } = column;
    /** @param {number} i */
    const text = (i) => {
      if (column.words) return column.words[values[i]] ?? "";
      if (column.name === "run") return String(values[i]);
      return Number.isNaN(values[i]) ? "" : words(values[i]);
    };
    // A run lies at its value, or at the place of it in a list.
    const places = levels
      ? values.map((value) => levels.findIndex((level) => Math.fround(level) === value))
      : values;
    const flat = axis.log ? Math.log : Number;
    /** The part of the axis before a place. @param {number} place */
    const part = (place) => (flat(place) - flat(axis.from)) / (flat(axis.to) - flat(axis.from));
    /** @param {number} i */
    const isDrawable = (i) => !Number.isNaN(values[i]) && (!axis.log || values[i] > 0);
    return { ...column, values, text, places, part, isDrawable, plainTitle: plain(column.title) };
  }
  const columns = await Promise.all(data.columns.map(unpacked));
  const [runs, ...others] = columns;
  const count = runs.values.length;
  const all = range(count);
  const named = new Map(columns.map((column) => [column.name, column]));
  const numbers = others.filter((column) => !column.words);
  const results = numbers.filter((column) => !column.key);
  const keys = others.filter((column) => column.key);
  let rows = all;
  /** The run that is shown in detail. @type {number | null} */
  let chosen = null;

  // ---- Two columns against each other -----------------------------------------------------------

  /** @param {Column[]} list */
  const optionsOf = (list) => list.map(({ name, title }) => ({ name: title, value: name }));
  const menus = [
    menu("study-x", optionsOf(others), scatter),
    menu("study-y", optionsOf(others), scatter),
    menu("study-z", optionsOf(numbers), scatter),
  ];
  for (const [i, column] of [keys[0] ?? numbers[0], keys[1] ?? results[0], results[0]].entries())
    if (column) menus[i].value = column.name;

  /** Places of the inside of a chart, pixels. */
  const INSIDE = { left: 92, right: 470, top: 10, bottom: 252 };
  /** @param {number} part */
  const across = (part) => INSIDE.left + part * (INSIDE.right - INSIDE.left);
  /** @param {number} part */
  const up = (part) => INSIDE.bottom - part * (INSIDE.bottom - INSIDE.top);

  /** The end of a long word says more than its beginning. @param {string} text */
  const shortened = (text) => (text.length > 11 ? `\u2026${text.slice(-10)}` : text);

  /** A text of the chart. @param {number} x @param {number} y @param {string} text @param {Attributes} [style] */
  const label = (x, y, text, style) => shape("text", { x, y, ...style }, text);
  /** Axes that the program has laid out for two columns. @param {Column} x @param {Column} y */
  function axes(x, y) {
    const { left, right, top, bottom } = INSIDE;
    const xs = x.axis.ticks.map(([value, text]) => ({ at: across(x.part(value)), text: shortened(text) }));
    const ys = y.axis.ticks.map(([value, text]) => ({ at: up(y.part(value)), text: shortened(text) }));
    const lines = [
      ...xs.map(({ at }) => `M${at} ${top}V${bottom}`),
      ...ys.map(({ at }) => `M${left} ${at}H${right}`),
    ];
    const middle = 0.5 * (top + bottom);
    /** @param {string} name @param {"start" | "middle" | "end"} anchor @param {Element[]} texts */
    const group = (name, anchor, texts) =>
      shape(
        "g",
        { "aria-label": name, "font-size": 12, fill: "var(--ink)", "text-anchor": anchor },
        ...texts,
      );
    return [
      shape("path", {
        d: `${lines.join("")}M${left} ${top}H${right}V${bottom}H${left}z`,
        stroke: "var(--line)",
        fill: "none",
      }),
      group(
        "x-axis tick label",
        "middle",
        xs.map(({ at, text }) => label(at, bottom + 18, text)),
      ),
      group(
        "y-axis tick label",
        "end",
        ys.map(({ at, text }) => label(left - 8, at + 4, text)),
      ),
      group("x-axis label", "middle", [label(0.5 * (left + right), bottom + 40, x.plainTitle)]),
      group("y-axis label", "middle", [
        label(14, middle, y.plainTitle, { transform: `rotate(-90 14 ${middle})` }),
      ]),
    ];
  }

  // More dots than this show no more, and take seconds.
  const MOST = 1500;
  /** A number in [0, 1) for run `i`, the same on every page. Low bits of the number of a sample say where it lies. @param {number} i */
  function chance(i) {
    let bits = i + 1;
    for (let round = 0; round < 2; round++) bits = Math.imul(bits ^ (bits >>> 16), 0x45d9f3b);
    return ((bits ^ (bits >>> 16)) >>> 0) / 2 ** 32;
  }
  /** Where a run is drawn: runs of the same value of a list lie beside one another. @param {Column} column @param {number} salt @param {number} i */
  const partOf = ({ levels, places, part }, salt, i) =>
    part(levels ? places[i] + 0.7 * (chance(i + salt) - 0.5) : places[i]);

  function scatter() {
    const [x, y, z] = menus.map((menu) => named.get(menu.value) ?? numbers[0]);
    const there = rows.filter((i) => [x, y, z].every((column) => column.isDrawable(i)));
    const shown = there.filter((i) => chance(i) * there.length < MOST);
    /** @param {number} i @param {Attributes} style */
    const dot = (i, style) => {
      const place = { cx: across(partOf(x, 7919, i)), cy: up(partOf(y, 104729, i)) };
      const title = [x, y, z].map((column) => `${column.plainTitle}: ${column.text(i)}`).join("\n");
      const made = shape("circle", { ...place, ...style });
      made.append(shape("title", {}, `run ${runs.text(i)}\n${title}`));
      made.addEventListener("click", () => choose(i, "there"));
      return made;
    };
    const dots = shown.map((i) => dot(i, { r: 2.6, "fill-opacity": 0.85, fill: shade(z.part(z.places[i])) }));
    const isDrawn = chosen !== null && x.isDrawable(chosen) && y.isDrawable(chosen);
    const ring = { r: 7, fill: "none", stroke: "var(--ink)", "stroke-width": 2 };
    if (chosen !== null && isDrawn) dots.push(dot(chosen, ring));
    const view = { viewBox: "0 0 480 300", role: "img", "aria-label": `${x.plainTitle} and ${y.plainTitle}` };
    const svg = shape("svg", view, ...axes(x, y), shape("g", { class: "curves" }, ...dots));
    const scale = `${z.title}, ${words(z.axis.from)} to ${words(z.axis.to)}`;
    const figure = element("study-scatter");
    within(figure, ".drawing").replaceChildren(svg);
    within(figure, ".legends").replaceChildren(railcrack.legend([{ name: scale, mark: "ramp" }]));
    const drawn = shown.length === there.length ? "All" : `${shown.length} of`;
    const lists = [x, y].filter((column) => column.levels).map((column) => column.plainTitle);
    const beside = lists.length ? ` Runs with the same ${lists.join(" and ")} are spread around it.` : "";
    within(figure, "figcaption").textContent =
      `${drawn} ${there.length} runs, coloured by ${z.plainTitle}; click one to see it below.${beside}`;
  }

  // ---- How results scatter ----------------------------------------------------------------------

  const SHARES = [0.05, 0.25, 0.5, 0.75, 0.95];
  /** @param {number} share */
  const percent = (share) => (share === 0.5 ? "median" : `${Math.round(100 * share)} %`);
  /** The quantile of sorted values. @param {number[]} sorted @param {number} share */
  function quantile(sorted, share) {
    const place = share * (sorted.length - 1);
    const [low, high] = [sorted[Math.floor(place)], sorted[Math.ceil(place)]];
    return low + (place - Math.floor(place)) * (high - low);
  }
  /** A cell of a row. @param {"td" | "th"} kind @param {string} text @param {boolean} isNumber */
  function cell(kind, text, isNumber) {
    const made = inParts(document.createElement(kind), text);
    if (isNumber) made.className = "number";
    return made;
  }
  /** A row of cells, the first of which names it. @param {string[]} texts @param {"td" | "th"} kind @param {(place: number) => boolean} isNumber */
  function tableRow(texts, kind, isNumber) {
    const row = document.createElement("tr");
    row.append(...texts.map((text, i) => cell(i ? kind : "th", text, isNumber(i))));
    return row;
  }

  const quantileTable = element("study-quantiles", HTMLTableElement);
  within(quantileTable, "thead").append(
    tableRow(["Result", "Runs", ...SHARES.map(percent)], "th", (i) => i > 0),
  );
  /** The quantiles of every result. */
  function quantiles() {
    const body = results.map((column) => {
      const sorted = rows
        .map((i) => column.values[i])
        .filter((value) => !Number.isNaN(value))
        .sort((a, b) => a - b);
      const values = SHARES.map((share) => (sorted.length ? words(quantile(sorted, share)) : "\u2013"));
      return tableRow([column.plainTitle, String(sorted.length), ...values], "td", (i) => i > 0);
    });
    within(quantileTable, "tbody").replaceChildren(...body);
  }

  // ---- The table --------------------------------------------------------------------------------

  const SHOWN = 25;
  /** @type {{ column: Column, down: boolean } | null} */
  let order = null;
  let page = 0;
  const table = element("study-table", HTMLTableElement);
  const [earlier, later] = ["study-less", "study-more"].map((id) => element(id, HTMLButtonElement));
  const filter = element("study-filter", HTMLInputElement);
  /** @param {number} i */
  const isNumberColumn = (i) => !columns[i].words;

  const headRow = tableRow(
    columns.map(({ plainTitle }) => plainTitle),
    "th",
    isNumberColumn,
  );
  railcrack.sortButtons(/** @type {HTMLElement[]} */ ([...headRow.children]), (place, down) => {
    order = { column: columns[place], down };
    page = 0;
    list();
  });
  within(table, "thead").append(headRow);

  /** The selected runs in the order of the table. */
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
    const shown = sorted.slice(page * SHOWN, (page + 1) * SHOWN).map((i) => {
      const row = tableRow(
        columns.map((column) => column.text(i)),
        "td",
        isNumberColumn,
      );
      row.tabIndex = 0;
      row.dataset.run = runs.text(i);
      row.classList.toggle("out", i === chosen);
      row.addEventListener("click", () => choose(i, "here"));
      row.addEventListener("keydown", ({ key }) => {
        if (key === "Enter") choose(i, "here");
      });
      return row;
    });
    within(table, "tbody").replaceChildren(...shown);
    element("study-page").textContent = `page ${page + 1} of ${pages}`;
    element("study-count").textContent = `${rows.length} of ${count} runs`;
    earlier.disabled = page === 0;
    later.disabled = page >= pages - 1;
  }
  for (const [button, by] of /** @type {[HTMLButtonElement, number][]} */ ([
    [earlier, -1],
    [later, 1],
  ]))
    button.addEventListener("click", () => {
      page += by;
      list();
    });

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

  /** Shows a run in detail, and the page of the table with its row; one chosen on a chart is brought into view there. @param {number} i @param {"here" | "there"} from */
  function choose(i, from) {
    chosen = i;
    page = Math.max(0, Math.floor(ordered().indexOf(i) / SHOWN));
    one.hidden = false;
    const number = runs.text(i);
    within(one, "h3").textContent = `Run ${number}`;
    const values = others.map((column) => `${column.plainTitle}: ${column.text(i)}`);
    within(one, "p").textContent =
      `${values.join("; ")}. For its report: railcrack report DIR --run ${number}`;
    const life = tableRow(["Load cycles", "Crack length (mm)"], "th", () => true);
    const states = range(first[i + 1] - first[i]).map((k) => first[i] + k);
    const steps = states.map((k) => tableRow([words(cycles[k]), words(lengths[k])], "td", () => true));
    within(one, "thead").replaceChildren(life);
    within(one, "tbody").replaceChildren(...steps);
    // Its growth among the quantiles of all runs.
    const among = railcrack.charts.get("length-cycles");
    const points = states
      .filter((k) => cycles[k] > 0)
      .map((k) => /** @type {Pair} */ ([cycles[k], lengths[k]]));
    among?.show("run", [among.curve(`run ${number}`, points, { stroke: "var(--ink)", "stroke-width": 2.4 })]);
    list();
    if (from === "there")
      within(table, "tbody").querySelector("tr.out")?.scrollIntoView({ block: "nearest" });
    scatter();
  }

  /** Everything that shows the selected runs. */
  function selected() {
    list();
    quantiles();
    scatter();
  }
  selected();
  railcrack.tools(element("study-scatter"));
});

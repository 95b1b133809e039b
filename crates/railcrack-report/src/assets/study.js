// A study of many runs: two keys against each other, what results depend on, a table, one run on demand.
"use strict";

(async () => {
  const { words, plain, inParts, typeset, singles, onWidth, tools, extent } = railcrack;
  const data = JSON.parse(document.getElementById("study-data").textContent);
  const byId = (id) => document.getElementById(`study-${id}`);
  const columns = await Promise.all(data.columns.map(async (column) => {
    const values = await singles(column.data);
    return { ...column, values, text: column.words ? (i) => column.words[values[i]] ?? "" : (i) => (Number.isNaN(values[i]) ? "" : words(values[i])) };
  }));
  const count = columns[0].values.length;
  const all = d3.range(count);
  const named = new Map(columns.map((column) => [column.name, column]));
  const numbers = columns.filter((column) => !column.words && column.name !== "run");
  let rows = all;
  let chosen = null;

  function options(select, list, value) {
    select.append(...list.map(({ name, title }) => Object.assign(document.createElement("option"), { value: name, textContent: plain(title) })));
    select.value = value;
  }
  const keys = numbers.filter((column) => column.key);
  options(byId("x"), numbers, (keys[0] ?? numbers[0]).name);
  options(byId("y"), numbers, (keys[1] ?? numbers.find((column) => !column.key) ?? numbers[0]).name);
  options(byId("z"), numbers, (numbers.find((column) => !column.key) ?? numbers[0]).name);
  options(byId("result"), data.results, data.results[0]?.name);

  const picked = (id) => named.get(byId(id).value);
  const axis = (column, there) => ({ label: plain(column.title), labelAnchor: "center", labelArrow: "none", domain: there.length ? extent(there.map((i) => column.values[i]), column.log) : [1, 10], ...(column.log ? { type: "log", ticks: 4, tickFormat: (value) => words(value) } : { ticks: 5, tickFormat: railcrack.ticks }) });
  const good = (column, i) => !Number.isNaN(column.values[i]) && (!column.log || column.values[i] > 0);
  const common = (width) => ({
    width, height: Math.round(Math.min(340, Math.max(240, 0.62 * width))), marginLeft: 74, marginRight: 20, marginBottom: 44, marginTop: 22,
    style: { fontSize: "12px", overflow: "visible" }, grid: true, insetLeft: 7, insetRight: 7, insetTop: 7, insetBottom: 7,
  });
  const put = (id, svg, caption) => {
    byId(id).querySelector(".drawing").replaceChildren(typeset(svg));
    byId(id).querySelector("figcaption").textContent = caption;
  };
  const colours = (column) => ({ scheme: "viridis", type: column.log ? "log" : "linear", label: plain(column.title) });

  // More dots than this tell no more, and take seconds.
  const MOST = 1500;
  /** A number in [0, 1) for run `i`, the same on every page. Low bits of the number of a sample say where it lies: every fourth one leaves out half of a key. */
  function chance(i) {
    let bits = i + 1;
    for (let round = 0; round < 2; round++) bits = Math.imul(bits ^ (bits >>> 16), 0x45d9f3b);
    return ((bits ^ (bits >>> 16)) >>> 0) / 2 ** 32;
  }
  function scatter(width) {
    const [x, y, z] = ["x", "y", "z"].map(picked);
    const there = rows.filter((i) => good(x, i) && good(y, i) && good(z, i));
    const shown = there.filter((i) => chance(i) * there.length < MOST);
    const svg = Plot.plot({
      ...common(width), x: axis(x, there), y: axis(y, there), color: colours(z),
      marks: [
        Plot.frame({ stroke: "var(--line)" }),
        Plot.dot(shown, { x: (i) => x.values[i], y: (i) => y.values[i], fill: (i) => z.values[i], r: 2.4, fillOpacity: 0.8 }),
        chosen !== null && good(x, chosen) && good(y, chosen) ? Plot.dot([chosen], { x: (i) => x.values[i], y: (i) => y.values[i], r: 7, stroke: "var(--ink)", strokeWidth: 2 }) : null,
        Plot.tip(shown, Plot.pointer({ x: (i) => x.values[i], y: (i) => y.values[i], title: (i) => `run ${columns[0].values[i]}\n${[x, y, z].map((c) => `${plain(c.title)}: ${c.text(i)}`).join("\n")}`, fill: "var(--ground)" })),
      ],
    });
    svg.addEventListener("click", () => { if (svg.value !== null && svg.value !== undefined) choose(svg.value); });
    put("scatter", svg, `${shown.length === there.length ? `All ${there.length}` : `${shown.length} of ${there.length}`} runs; colour: ${plain(z.title)}.`);
  }

  const middle = (values) => d3.median(values) ?? NaN;
  function heat(width) {
    const [x, y, z] = ["x", "y", "z"].map(picked);
    const there = rows.filter((i) => good(x, i) && good(y, i) && good(z, i));
    const cut = (column) => {
      const [low, high] = extent(there.map((i) => column.values[i]), column.log);
      const flat = column.log ? Math.log10 : (value) => value;
      const steps = Math.max(2, Math.min(14, new Set(there.map((i) => column.values[i])).size));
      const [a, b] = [flat(low), flat(high)];
      const edge = (k) => (column.log ? 10 ** (a + ((b - a) * k) / steps) : a + ((b - a) * k) / steps);
      return { of: (i) => Math.min(steps - 1, Math.floor(((flat(column.values[i]) - a) / (b - a)) * steps)), edge };
    };
    if (!there.length) return;
    const [cx, cy] = [cut(x), cut(y)];
    const cells = d3.rollups(there, (group) => ({ z: middle(group.map((i) => z.values[i])), n: group.length }), (i) => `${cx.of(i)},${cy.of(i)}`)
      .map(([key, cell]) => { const [i, j] = key.split(",").map(Number); return { ...cell, x1: cx.edge(i), x2: cx.edge(i + 1), y1: cy.edge(j), y2: cy.edge(j + 1) }; });
    const svg = Plot.plot({
      ...common(width), x: axis(x, there), y: axis(y, there), color: colours(z),
      marks: [
        Plot.frame({ stroke: "var(--line)" }),
        Plot.rect(cells, { x1: "x1", x2: "x2", y1: "y1", y2: "y2", fill: "z", inset: 0.5, title: (cell) => `${plain(z.title)}: ${words(cell.z)} (median of ${cell.n} runs)` }),
      ],
    });
    put("heat", svg, `Median of ${plain(z.title)} in each cell; empty where no run is.`);
  }

  function bars(id, estimates, title, caption) {
    return (width) => {
      const result = data.results.find(({ name }) => name === byId("result").value);
      const list = (result?.[estimates] ?? []).filter(({ estimate }) => estimate);
      const titles = list.map(({ key }) => key);
      const left = Math.min(0.45 * width, 24 + 7.2 * (d3.max(titles, (text) => text.length) ?? 4));
      const svg = Plot.plot({
        width, height: 66 + 24 * Math.max(1, list.length), marginLeft: left, marginRight: 20, marginBottom: 44, marginTop: 10,
        style: { fontSize: "12px", overflow: "visible" },
        x: { label: title, labelAnchor: "center", labelArrow: "none", grid: true, domain: estimates === "rank" ? [-1, 1] : [0, 1] },
        y: { label: null, domain: titles, tickFormat: (text) => (7.2 * text.length > left - 20 ? `…${text.slice(-Math.floor((left - 30) / 7.2))}` : text) },
        marks: [
          Plot.barX(list, { y: "key", x: (d) => d.estimate[0], fill: "var(--c0)" }),
          Plot.link(list, { y: "key", x1: (d) => d.estimate[1], x2: (d) => d.estimate[2], y1: "key", y2: "key", stroke: "var(--ink)", strokeWidth: 2 }),
          Plot.ruleX([0], { stroke: "var(--ink)" }),
        ],
      });
      put(id, svg, list.length ? `${caption} of ${plain(result.title)}; the line is the interval of 95 %.` : `${caption}: too few runs.`);
    };
  }

  // The table.
  const SHOWN = 25;
  let [order, down, page] = [null, false, 0];
  const table = byId("table");
  const head = document.createElement("tr");
  for (const column of columns) {
    const cell = document.createElement("th");
    const button = inParts(Object.assign(document.createElement("button"), { type: "button" }), plain(column.title));
    button.addEventListener("click", () => {
      [down, order] = [order === column ? !down : false, column];
      page = 0;
      list();
    });
    cell.append(button);
    if (!column.words) cell.className = "number";
    head.append(cell);
  }
  table.tHead.append(head);

  function list() {
    const sorted = order ? rows.toSorted((a, b) => {
      const [one, other] = order.words ? [order.text(a), order.text(b)] : [order.values[a], order.values[b]];
      // What is not there comes last either way.
      const [none, nor] = [one, other].map((value) => value === "" || Number.isNaN(value));
      return none || nor ? none - nor : down ? d3.descending(one, other) : d3.ascending(one, other);
    }) : rows;
    const pages = Math.max(1, Math.ceil(sorted.length / SHOWN));
    page = Math.max(0, Math.min(page, pages - 1));
    table.tBodies[0].replaceChildren(...sorted.slice(page * SHOWN, (page + 1) * SHOWN).map((i) => {
      const row = document.createElement("tr");
      row.tabIndex = 0;
      row.dataset.run = columns[0].values[i];
      row.classList.toggle("out", i === chosen);
      for (const column of columns) {
        const cell = document.createElement("td");
        cell.textContent = column.name === "run" ? String(column.values[i]) : column.text(i);
        if (!column.words) cell.className = "number";
        row.append(cell);
      }
      row.addEventListener("click", () => choose(i));
      row.addEventListener("keydown", (event) => { if (event.key === "Enter") choose(i); });
      return row;
    }));
    byId("page").textContent = `page ${page + 1} of ${pages}`;
    byId("count").textContent = `${rows.length} of ${count} runs`;
    byId("less").disabled = page === 0;
    byId("more").disabled = page >= pages - 1;
  }
  byId("less").addEventListener("click", () => { page -= 1; list(); });
  byId("more").addEventListener("click", () => { page += 1; list(); });

  const COMPARED = { "<": (a, b) => a < b, "<=": (a, b) => a <= b, ">": (a, b) => a > b, ">=": (a, b) => a >= b, "=": (a, b) => a === b, "!=": (a, b) => a !== b };
  byId("filter").addEventListener("input", () => {
    const conditions = byId("filter").value.split(",").flatMap((text) => {
      const parts = /^\s*(.+?)\s*(<=|>=|!=|<|>|=)\s*(.+?)\s*$/.exec(text);
      const column = parts && (named.get(parts[1]) ?? columns.find((other) => other.name.endsWith(parts[1])));
      if (!column) return [];
      const compare = COMPARED[parts[2]];
      return [column.words ? (i) => compare(column.text(i), parts[3]) : (i) => compare(column.values[i], Math.fround(Number(parts[3])))];
    });
    rows = all.filter((i) => conditions.every((holds) => holds(i)));
    page = 0;
    list();
    redraw();
  });

  // One run.
  const [first, cycles, lengths] = await Promise.all([data.first, data.cycles, data.lengths].map(singles));
  function life(width) {
    if (chosen === null) return;
    const points = d3.range(first[chosen], first[chosen + 1]).map((k) => ({ x: cycles[k], y: lengths[k] }));
    const svg = Plot.plot({
      ...common(width),
      x: { label: "Load cycles (axles)", labelAnchor: "center", labelArrow: "none", tickFormat: railcrack.ticks },
      y: { label: "Crack length (mm)", labelAnchor: "center", labelArrow: "none" },
      marks: [Plot.frame({ stroke: "var(--line)" }), Plot.line(points, { x: "x", y: "y", stroke: "var(--c0)", strokeWidth: 2 }), Plot.dot(points, { x: "x", y: "y", fill: "var(--c0)", r: 3 })],
    });
    put("life", svg, "Crack length against load cycles of this run.");
  }
  function choose(i) {
    chosen = i;
    const one = byId("one");
    one.hidden = false;
    one.querySelector("h3").textContent = `Run ${columns[0].values[i]}`;
    one.querySelector("p").textContent = `${columns.slice(1).map((column) => `${plain(column.title)}: ${column.text(i)}`).join("; ")}. Its page: railcrack report DIR --run ${columns[0].values[i]}`;
    life(Math.floor(byId("life").querySelector(".drawing").clientWidth));
    list();
    for (const draw of drawings) draw();
  }

  const drawings = [["scatter", scatter], ["heat", heat]].map(([id, draw]) => () => draw(Math.floor(byId(id).querySelector(".drawing").clientWidth)));
  const redraw = () => drawings.forEach((draw) => draw());
  const rank = bars("rank", "rank", "Rank correlation", "Rank correlation (Spearman)");
  const sobol = bars("sobol", "sobol", "First-order index", "First-order Sobol index, the share of the variance that the key explains by itself,");
  for (const id of ["x", "y", "z"]) byId(id).addEventListener("change", redraw);
  byId("result").addEventListener("change", () => {
    rank(byId("rank").querySelector(".drawing").clientWidth);
    sobol(byId("sobol").querySelector(".drawing").clientWidth);
  });
  list();
  for (const [id, draw] of [["scatter", scatter], ["heat", heat], ["rank", rank], ["sobol", sobol], ["life", life]]) {
    onWidth(byId(id).querySelector(".drawing"), draw);
    tools(byId(id));
  }
  document.getElementById("study-table").dataset.ready = "true";
})();

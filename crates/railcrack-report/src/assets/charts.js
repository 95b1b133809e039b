// The charts of a page, drawn from the data in their figures.
"use strict";

(() => {
  const { AXES, DASHES, TIP, aired, bringOut, charts, extent, legend, logarithmicAxis, onWidth, plain } =
    railcrack;
  const { scale, scaleOf, sized, ticks, toScale, tools, typeset, within, words } = railcrack;

  /**
   * A point of a curve on a chart.
   * @typedef {{ x: number, y: number, name: string, note: string, dot: boolean }} ChartPoint
   */

  /** @param {CurveData} data */
  function curvePoints({ x, y, name, note, dots }) {
    return x.flatMap((value, i) => {
      const height = y[i];
      if (value === null || height === null) return [];
      const dot = dots === true || (Array.isArray(dots) && dots.includes(i));
      return [{ x: value, y: height, name, note, dot }];
    });
  }

  /** Builds the chart of a figure from the data in it. @param {HTMLElement} figure */
  function chart(figure) {
    const data = /** @type {ChartData} */ (JSON.parse(within(figure, "script").textContent));
    const place = within(figure, ".drawing");
    const isByDepth = data.y.scale === "depth";
    const log = { x: data.x.scale === "log", y: data.y.scale === "log" };
    /** @param {{ x: number, y: number }} point */
    const isDrawable = ({ x, y }) => (!log.x || x > 0) && (!log.y || y > 0);
    const curves = data.curves
      .map((curve) => ({
        ...curve,
        stroke: `var(--${curve.colour})`,
        points: curvePoints(curve).filter(isDrawable),
      }))
      .filter((curve) => curve.points.length);
    const names = document.createElement("div");
    if (data.legend) place.before(names);
    let shown = curves;
    // The bundle of many cracks, and of it those that are picked.
    const isBundle = curves.some((curve) => curve.fine);
    /** @type {typeof curves} */
    let picked = [];
    /** @type {Plotted | null} */
    let drawing = null;
    /** @type {{ x: number, y: number }[]} */
    let marked = [];

    function drawLegend() {
      if (!data.legend) return;
      // Cracks of one run share a name; what the dashes say, the switches say where curves have
      // any.
      /** @param {(typeof curves)[number]} curve */
      const key = ({ name, stroke, look, note }) => `${name} ${stroke} ${note ? "" : look}`;
      const named = new Map(shown.filter((curve) => curve.name).map((curve) => [key(curve), curve]));
      const entries = [...named.values()].map(({ name, stroke, look, dots, note }) => ({
        name,
        colour: stroke,
        dashes: note ? null : DASHES[look],
        dots: look === "dots" ? /** @type {const} */ ("only") : dots === true,
      }));
      const own = picked.some((curve) => curve.fine) ? [{ name: picked[0].note, colour: "var(--ink)" }] : [];
      names.replaceChildren(...(entries.length ? [legend([...entries, ...own])] : []));
    }

    /** @param {ChartPoint} point */
    const title = ({ x, y, name, note }) =>
      [plain(name), plain(note), `${plain(data.x.title)}: ${words(x)}`, `${plain(data.y.title)}: ${words(y)}`]
        .filter(Boolean)
        .join("\n");

    /** What the curves that are shown span; of none, what all do. */
    const points = () => (shown.length ? shown : curves).flatMap((curve) => curve.points);

    /**
     * The domain of the axis `name` over `all`, including zero where the axis does.
     * @param {"x" | "y"} name
     * @param {ChartPoint[]} all
     */
    const covered = (name, all) =>
      extent([...all.map((point) => point[name]), ...(data[name].zero ? [0] : [])], log[name]);

    /**
     * Space for the ticks and the title next to them, from the usual width of digits.
     * @param {ChartPoint[]} all
     */
    function room(all) {
      const [low, high] = data.y.range ?? covered("y", all);
      const lengths = d3.ticks(low ?? 0, high ?? 1, 6).map((value) => ticks(value).length);
      return 36 + 7.4 * Math.max(3, log.y ? 6 : (d3.max(lengths) ?? 4));
    }

    /**
     * Axes over the points `all`, and the height of the chart.
     * @param {number} width
     * @param {{ left: number, right: number, top: number, bottom: number }} margin
     * @param {ChartPoint[]} all
     */
    function layout(width, margin, all) {
      const axes = { x: scale(data.x), y: scale(data.y) };
      if (data.equal) {
        const [x, y] = AXES.map((name) => aired(all.map((point) => point[name])));
        const fit = toScale(x, y, width - margin.left - margin.right, { most: 480, least: 140 });
        axes.x.domain = fit.x;
        axes.y.domain = fit.y;
        if (isByDepth) {
          // Room is made below: above the running surface there is nothing.
          const top = Math.max(fit.y[0], Math.min(0, y[0]));
          const bottom = fit.y[1] + top - fit.y[0];
          axes.y.domain = [bottom, top];
          axes.y.ticks = d3.ticks(Math.max(0, top), bottom, Math.max(2, Math.min(6, fit.height / 40)));
        }
        axes.y.reverse = false;
        return { axes, height: Math.round(fit.height) + margin.top + margin.bottom };
      }
      for (const name of AXES) {
        // Values that are one and the same; otherwise the marks say what is covered.
        const [low, high] = covered(name, all);
        const isMarked = all.some((point) => point[name] === low || point[name] === high);
        if (axes[name].domain || !all.length || isMarked) continue;
        axes[name].domain = axes[name].reverse ? [high, low] : [low, high];
        axes[name].reverse = false;
      }
      return { axes, height: Math.min(320, Math.max(230, 0.55 * width)) };
    }

    /** The curves that are shown, those that are picked above them. */
    function curveMarks() {
      const above = picked.map((curve) => {
        const stroke = curve.fine ? "var(--ink)" : curve.stroke;
        return { ...curve, stroke, wide: true, fine: false };
      });
      return [...shown, ...above].flatMap(({ points, stroke, look, wide, fine }) => {
        const width = fine ? 1 : 1.8;
        const line = { stroke, strokeWidth: wide ? 3.2 : width, strokeOpacity: fine ? 0.45 : 1 };
        const dots = points.filter((point) => point.dot);
        return [
          ...(look === "dots"
            ? []
            : [Plot.line(points, { x: "x", y: "y", ...line, strokeDasharray: DASHES[look], clip: true })]),
          ...(dots.length ? [Plot.dot(dots, { x: "x", y: "y", fill: stroke, r: 2.6, clip: true })] : []),
        ];
      });
    }

    /** Areas, and words at points. */
    function otherMarks() {
      const filled = { fill: "var(--c4)", fillOpacity: 0.3, stroke: "var(--c4)", strokeDasharray: "4 3" };
      const areas = (data.areas ?? []).map(({ x, y }) => {
        const corners = [...x, x[0]].map((x, i) => ({ x, y: y[i % y.length] }));
        return Plot.line(corners, { x: "x", y: "y", ...filled, className: "area" });
      });
      const notes = (data.notes ?? []).map(({ at, words }) =>
        Plot.text([at], { x: "0", y: "1", text: () => plain(words), dy: -8 }),
      );
      return { areas, notes };
    }

    /** @param {number} width */
    function draw(width) {
      const all = points();
      const margin = { left: room(all), right: 20, top: 22, bottom: 44 };
      const { axes, height } = layout(width, margin, all);
      const { areas, notes } = otherMarks();
      // Points at the ends are not cut off by the frame.
      const [acrossInset, upInset] = AXES.map((name) => (data[name].range || data.equal ? 0 : 7));
      const logAxes = AXES.filter((name) => log[name] && all.length).flatMap((name) =>
        logarithmicAxis(name, data[name].title, covered(name, all), width - margin.left),
      );
      const under = shown.flatMap((curve) => curve.points);
      const pointer = Plot.pointer({ x: "x", y: "y", title, ...TIP, lineWidth: 32 });
      const svg = Plot.plot({
        ...sized(width, height, margin),
        ...axes,
        insetLeft: acrossInset,
        insetRight: acrossInset,
        insetTop: upInset,
        insetBottom: upInset,
        ariaLabel: plain(data.caption),
        marks: [
          Plot.frame({ stroke: "var(--line)" }),
          // The running surface.
          data.equal && isByDepth ? Plot.ruleY([0], { stroke: "var(--ink)", strokeWidth: 2 }) : null,
          ...logAxes,
          ...areas,
          ...curveMarks(),
          ...notes,
          Plot.tip(under, pointer),
        ],
      });
      drawing = typeset(svg);
      // The pointer on a curve brings it out everywhere on the page.
      svg.addEventListener("input", () => bringOut(svg.value?.name));
      place.replaceChildren(svg);
      drawMarks();
    }

    const drawAgain = () => {
      drawLegend();
      if (drawing) draw(Math.floor(place.clientWidth));
    };

    function drawMarks() {
      if (!drawing) return;
      const [x, y] = [scaleOf(drawing, "x"), scaleOf(drawing, "y")];
      const rings = d3.select(drawing).selectAll("g.marks").data([0]).join("g");
      rings.attr("class", "marks").attr("pointer-events", "none");
      rings
        .selectAll("circle")
        .data(marked.filter(isDrawable))
        .join("circle")
        .attr("cx", (mark) => x.at(mark.x))
        .attr("cy", (mark) => y.at(mark.y))
        .attr("data-x", (mark) => mark.x)
        .attr("data-y", (mark) => mark.y)
        .attr("r", 6)
        .attr("fill", "none")
        .attr("stroke", "var(--ink)")
        .attr("stroke-width", 2);
    }

    drawLegend();
    onWidth(place, draw);
    tools(figure);
    return {
      curves,
      /** Shows the curves whose value of every group is on. @param {(Set<number> | null)[]} on */
      choose(on) {
        shown = curves.filter((curve) =>
          curve.choices.every((value, group) => on[group]?.has(value) ?? true),
        );
        drawAgain();
      },
      /** Brings a crack of a bundle above the others. @param {number} number */
      pick(number) {
        if (!isBundle) return;
        picked = curves.filter((curve) => new RegExp(`^crack ${number}(,|$)`).test(curve.note));
        drawAgain();
      },
      /** Lets all curves step back but those called `name`. @param {string} [name] */
      emphasise(name) {
        if (!drawing) return;
        const has = shown.some((curve) => curve.name === name);
        const lines = shown.filter((curve) => curve.look !== "dots");
        d3.select(drawing)
          .selectAll("g[aria-label=line]:not(.area)")
          .style("opacity", (_, i) => (has && lines[i]?.name !== name ? 0.25 : 1));
      },
      /**
       * Draws rings around points that something else on the page points to.
       * @param {typeof marked} points
       */
      mark(points) {
        marked = points;
        drawMarks();
      },
    };
  }

  for (const figure of /** @type {NodeListOf<HTMLElement>} */ (document.querySelectorAll("figure.chart")))
    charts.set(figure.id, chart(figure));
})();

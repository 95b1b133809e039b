// The explorer of cracks in space: the fronts of the cracks, with sliders for growth step, wheel
// position and point of the front.
"use strict";

railcrack.viewer("explorer", "The explorer", "the folder plots/ has pictures", async () => {
  const { TIP, aired, element, hertzianPressure, linear, picture, signed, singles, sized, toScale, words } =
    railcrack;
  const data = /** @type {SpaceData} */ (railcrack.pageData("space-data"));
  const { wheels, steps, cracks } = data;
  const MODES = /** @type {const} */ ([
    { key: "ki", name: "K_{I}", colour: "var(--c0)" },
    { key: "kii", name: "K_{II}", colour: "var(--c1)" },
    { key: "kiii", name: "K_{III}", colour: "var(--c2)" },
  ]);
  const lastStep = steps.length - 1;
  const state = { step: 0, position: 0, crack: 0, point: 0, wheel: 0 };
  const wheel = () => wheels[state.wheel];
  /** The positions of the chosen wheel, over its half-width. */
  const positions = () => wheel().positions;

  /** @param {number} step */
  const front = (step, crack = state.crack) => steps[step].cracks[crack].front;

  // ---- Histories of K ---------------------------------------------------------------------------

  /** K of the modes over the positions of each wheel, at a point of a front. @param {FrontPoint} point */
  const decode = (point) =>
    Promise.all(
      point.wheels.map(async (under) => {
        const [ki, kii, kiii] = await Promise.all(
          MODES.map(({ key }) => {
            const packed = under[key];
            return packed ? singles(packed) : new Float32Array();
          }),
        );
        return { ki, kii, kiii };
      }),
    );
  const all = await Promise.all(
    steps.map((step) => Promise.all(step.cracks.map((crack) => Promise.all(crack.front.map(decode))))),
  );
  /** K at the points of the front of the chosen crack under the chosen wheel. */
  const histories = (step = state.step) => all[step][state.crack].map((point) => point[state.wheel]);

  /**
   * Chooses a crack: its deepest point, and the position at which K is largest there.
   * @param {number} crack
   */
  function choose(crack) {
    state.crack = crack;
    state.point = d3.minIndex(front(0), (point) => Math.abs(point.phi - 90));
    const { ki, kii, kiii } = histories(0)[state.point];
    state.position = Math.max(
      0,
      d3.maxIndex(ki, (_, i) => Math.hypot(ki[i], kii[i], kiii[i])),
    );
  }
  choose(d3.maxIndex(cracks, (_, crack) => d3.max(front(0, crack), (point) => point.delta_keq) ?? 0));

  const contactCentre = () => data.origin + positions()[state.position] * wheel().half_width;

  // ---- Geometry ---------------------------------------------------------------------------------

  const MARGIN = { left: 56, right: 16, top: 12, bottom: 42 };

  /** The front of a crack as a line, closed for a buried one. @param {number} step */
  function outline(step, crack = state.crack) {
    const points = front(step, crack);
    return cracks[crack].buried ? [...points, points[0]] : points;
  }
  /** @template T @param {(crack: number) => T[]} of */
  const ofEveryCrack = (of) => cracks.flatMap((_, crack) => of(crack));
  /** First and last fronts of all cracks, which a picture has room for. */
  const extremes = ofEveryCrack((crack) => [...outline(0, crack), ...outline(lastStep, crack)]);
  const [leftmost, rightmost] = railcrack.ends(extremes.map((point) => point.x));
  const widest = d3.max(wheels, (one) => one.half_width) ?? 0;
  /** The cracks and a half-width of the widest wheel on either side of them. */
  const alongRail = aired([leftmost - widest, rightmost + widest]);
  /** The lateral ends of all contacts. */
  const acrossRail = wheels.flatMap((one) => [
    one.lateral - one.lateral_half_width,
    one.lateral + one.lateral_half_width,
  ]);

  const figures = {
    above: picture("above"),
    side: picture("side"),
    plane: picture("plane"),
    along: picture("along"),
    history: picture("history"),
  };

  /**
   * Domains at one scale both ways, and the size of the chart.
   * @param {ReturnType<typeof picture>} figure
   * @param {Pair} x
   * @param {Pair} y
   * @param {number} most
   */
  function fitted(figure, x, y, most) {
    const fit = toScale(x, y, figure.width - MARGIN.left - MARGIN.right, { most, least: 120 });
    const height = Math.round(fit.height) + MARGIN.top + MARGIN.bottom;
    return { x: fit.x, y: fit.y, size: sized(figure.width, height, MARGIN) };
  }

  /** An axis of a picture to scale. @param {string} title @param {Pair} domain */
  const plainAxis = (title, domain) => ({ ...linear(title, domain), grid: false });

  /** @typedef {string | ((point: FrontPoint) => number)} Channel */

  /**
   * The faces of the cracks and their fronts in the first, the last and this growth step.
   * @param {Channel} x
   * @param {Channel} y
   */
  const fronts = (x, y) => [
    ...ofEveryCrack((crack) => [
      Plot.line(outline(state.step, crack), {
        x,
        y,
        fill: "var(--c0)",
        fillOpacity: crack === state.crack ? 0.18 : 0.08,
        stroke: "none",
      }),
    ]),
    ...ofEveryCrack((crack) => [
      Plot.line(outline(0, crack), {
        x,
        y,
        stroke: "var(--quiet)",
        strokeDasharray: "2 3",
        strokeWidth: 1.6,
      }),
      Plot.line(outline(lastStep, crack), { x, y, stroke: "var(--quiet)", strokeWidth: 1 }),
      Plot.line(outline(state.step, crack), {
        x,
        y,
        stroke: "var(--ink)",
        strokeWidth: crack === state.crack ? 3 : 1.6,
      }),
    ]),
  ];

  /** The chosen point of the front. @param {Channel} x @param {Channel} y */
  const chosenPoint = (x, y) =>
    Plot.dot([front(state.step)[state.point]], { x, y, r: 5, fill: "var(--c4)", stroke: "var(--ink)" });

  // ---- Drawing ----------------------------------------------------------------------------------

  function drawAbove() {
    const figure = figures.above;
    if (!figure.width) return;
    const xc = contactCentre();
    const ellipse = d3.range(73).map((i) => ({
      x: xc + wheel().half_width * Math.cos((Math.PI * i) / 36),
      z: wheel().lateral + wheel().lateral_half_width * Math.sin((Math.PI * i) / 36),
    }));
    const { x, y, size } = fitted(
      figure,
      alongRail,
      aired([...extremes.map((point) => point.z), ...acrossRail]),
      420,
    );
    const mouths = ofEveryCrack((crack) => {
      const points = front(state.step, crack);
      if (cracks[crack].buried) return [];
      const ends = [points[0], points[points.length - 1]];
      return [
        Plot.line(ends, { x: "x", y: "z", stroke: "var(--ink)", strokeWidth: 1.4, strokeDasharray: "6 4" }),
      ];
    });
    const svg = Plot.plot({
      ...size,
      x: plainAxis("x (mm)", x),
      y: plainAxis("z, across the rail (mm)", y),
      ariaLabel: "Cracks from above with the contact ellipse",
      marks: [
        Plot.rect([0], { x1: x[0], x2: x[1], y1: y[0], y2: y[1], fill: "var(--rail)" }),
        Plot.line(ellipse, {
          x: "x",
          y: "z",
          fill: "var(--c1)",
          fillOpacity: 0.2,
          stroke: "var(--c1)",
          clip: true,
        }),
        ...mouths,
        ...fronts("x", "z"),
        chosenPoint("x", "z"),
      ],
    });
    svg.dataset.centre = String(xc);
    figure.show(svg);
  }

  function drawSide() {
    const figure = figures.side;
    if (!figure.width) return;
    const deepest = d3.max(extremes, (point) => point.depth) ?? 1;
    const load = 0.35 * Math.max(deepest, 0.5 * widest);
    const { x, y, size } = fitted(figure, alongRail, aired([-1.2 * load, deepest]), 420);
    const pressure = hertzianPressure(contactCentre(), wheel().half_width, load);
    const ticks = Math.max(2, Math.min(5, Math.round((size.height - MARGIN.top - MARGIN.bottom) / 30)));
    const loaded = { fill: "var(--c1)", fillOpacity: 0.3, stroke: "var(--c1)", clip: true };
    const svg = Plot.plot({
      ...size,
      x: plainAxis("x (mm)", x),
      y: { ...plainAxis("Depth (mm)", [y[1], y[0]]), ticks: d3.ticks(0, y[1], ticks) },
      ariaLabel: "Cracks from the side below the wheel",
      marks: [
        Plot.rect([0], { x1: x[0], x2: x[1], y1: 0, y2: y[1], fill: "var(--rail)" }),
        Plot.ruleY([0], { stroke: "var(--ink)", strokeWidth: 2 }),
        Plot.areaY(pressure, { x: "x", y1: 0, y2: "y", ...loaded }),
        ...fronts("x", "depth"),
        chosenPoint("x", "depth"),
      ],
    });
    figure.show(svg);
  }

  function drawPlane() {
    const figure = figures.plane;
    if (!figure.width) return;
    const { strike, middle } = cracks[state.crack];
    const { fold } = steps[state.step].cracks[state.crack];
    /** @param {FrontPoint} point */
    const down = (point) => point.down;
    // Along the mouth, which a strike turns away from z.
    const [sin, cos] = [Math.sin(strike), Math.cos(strike)];
    /** @param {FrontPoint} point */
    const along = (point) =>
      sin === 0 ? point.z : (point.z - middle[1]) * cos - (point.x - middle[0]) * sin;
    const points = [...outline(0), ...outline(lastStep)];
    const { x, y, size } = fitted(figure, aired(points.map(along)), aired([0, ...points.map(down)]), 380);
    /** @param {number} step */
    const colour = (step) => `var(--s${Math.round(20 * (lastStep ? step / lastStep : 0.5))})`;
    const svg = Plot.plot({
      ...size,
      x: plainAxis(sin === 0 ? "z, across the rail (mm)" : "Along the mouth (mm)", x),
      y: plainAxis(fold === null ? "Down the dip (mm)" : "Down the dip, over the fold (mm)", [y[1], y[0]]),
      ariaLabel: "Fronts in the plane of the crack",
      marks: [
        Plot.ruleY([0], { stroke: "var(--ink)", strokeWidth: 2 }),
        Plot.ruleY(fold === null ? [] : [fold], { stroke: "var(--quiet)", strokeDasharray: "6 4" }),
        ...steps.map((_, step) =>
          Plot.line(outline(step), {
            x: along,
            y: down,
            stroke: colour(step),
            strokeWidth: step === state.step ? 3.2 : 1.2,
          }),
        ),
        Plot.dot(front(state.step), {
          x: along,
          y: down,
          r: 3,
          fill: "var(--ground)",
          stroke: "var(--ink)",
          title: (point) => `\u03c6 = ${words(point.phi)}\u00b0\nrate ${words(point.rate)} mm/cycle`,
          tip: TIP,
        }),
        chosenPoint(along, down),
      ],
    });
    figure.show(svg);
  }

  /** Marks that K charts begin with. */
  const kFrame = () => [Plot.frame({ stroke: "var(--line)" }), Plot.ruleY([0], { stroke: "var(--quiet)" })];
  /** Where a slider is, on the other chart's axis. @param {number} place */
  const chosenPlace = (place) => Plot.ruleX([place], { stroke: "var(--c4)", strokeDasharray: "4 3" });

  function drawAlong() {
    const figure = figures.along;
    if (!figure.width) return;
    const points = front(state.step);
    const isClosed = cracks[state.crack].buried;
    const isFolded = steps[state.step].cracks[state.crack].fold !== null;
    // The sides of a strip continue the angle to both sides.
    const [start, end] = isClosed ? [0, 360] : isFolded ? [-90, 270] : [0, 180];
    const curves = MODES.flatMap(({ key, colour }) => {
      const rows = points.map(({ phi }, i) => {
        const values = histories()[i][key];
        const [low, high] = railcrack.ends(values);
        return { phi, k: values[state.position], low, high };
      });
      /** @param {(typeof rows)[number]} row */
      const title = ({ phi, k, low, high }) =>
        `\u03c6 = ${words(phi)}\u00b0\nK = ${words(k)} MPa\u221am\nfrom ${words(low)} to ${words(high)}`;
      return [
        Plot.areaY(rows, { x: "phi", y1: "low", y2: "high", fill: colour, fillOpacity: 0.12 }),
        Plot.line(rows, { x: "phi", y: "k", stroke: colour, strokeWidth: 2 }),
        Plot.dot(rows, { x: "phi", y: "k", r: 2.4, fill: colour, title, tip: TIP }),
      ];
    });
    const ofStrip = 90 * Math.sin((data.layer * Math.PI) / 180);
    const strip = [-90 + ofStrip, -ofStrip, 180 + ofStrip, 270 - ofStrip];
    const layer = isClosed ? [] : [data.layer, 180 - data.layer, ...(isFolded ? strip : [])];
    const svg = Plot.plot({
      ...sized(figure.width, Math.min(380, Math.max(260, 0.6 * figure.width)), MARGIN),
      x: {
        ...linear("\u03c6 along the front (\u00b0)", [start, end]),
        ticks: d3.range(start, end + 1, (end - start) / 6),
      },
      y: linear("K (MPa\u221am)"),
      ariaLabel: "K along the front",
      marks: [
        ...kFrame(),
        ...curves,
        chosenPlace(points[state.point].phi),
        Plot.ruleX(layer, { stroke: "var(--quiet)", strokeDasharray: "2 4" }),
      ],
    });
    figure.show(svg);
  }

  function drawHistory() {
    const figure = figures.history;
    if (!figure.width) return;
    const k = histories()[state.point];
    const curves = MODES.map(({ key, colour }) =>
      Plot.line(
        Array.from(k[key], (value, i) => [positions()[i], value]),
        { stroke: colour, strokeWidth: 2 },
      ),
    );
    const svg = Plot.plot({
      ...sized(figure.width, 280, MARGIN),
      x: linear("Wheel position x_{c}/a"),
      y: linear("K (MPa\u221am)"),
      ariaLabel: "K at the chosen point of the front over the passage",
      marks: [...kFrame(), ...curves, chosenPlace(positions()[state.position])],
    });
    figure.show(svg);
  }

  const DRAWINGS = [
    { figure: figures.above, draw: drawAbove },
    { figure: figures.side, draw: drawSide },
    { figure: figures.plane, draw: drawPlane },
    { figure: figures.along, draw: drawAlong },
    { figure: figures.history, draw: drawHistory },
  ];

  // ---- Words and controls -----------------------------------------------------------------------

  function describe() {
    const step = steps[state.step];
    const crack = step.cracks[state.crack];
    const point = front(state.step)[state.point];
    const values = histories()[state.point];
    const k = MODES.map(({ key, name }) => `${name} = ${signed(values[key][state.position] ?? 0, 2)}`).join(
      ", ",
    );
    const axes = crack.fold === null ? "half axes" : "length over the fold and half-length";
    const said = cracks.length > 1 ? `crack ${state.crack + 1}: ${axes}` : axes;
    const whose = said.charAt(0).toUpperCase() + said.slice(1);
    const { name } = wheel();
    const under = name === null ? "" : `Under \u201c${name}\u201d. `;
    const wanted =
      point.wanted === null
        ? ""
        : ` The direction criterion predicts a kink of ${signed(point.wanted, 0)}\u00b0 there.`;
    railcrack.say(
      element("readout"),
      `${under}${whose} ${words(crack.depth)} mm down the dip and ${words(crack.half_length)} mm along the surface, after ` +
        `${words(step.cycles)} load cycles. At \u03c6 = ${words(point.phi)}\u00b0: ${k} MPa\u221am; ` +
        `\u0394K_{eq} = ${words(point.delta_keq)} MPa\u221am, ${words(point.rate)} mm per cycle.${wanted}`,
    );
  }

  /** Shows the state after a change of it. @param {Partial<typeof state>} change */
  function moveTo(change) {
    Object.assign(state, change);
    const points = front(state.step);
    state.point = Math.min(state.point, points.length - 1);
    controls.show(
      `${steps[state.step].step} of ${data.last_step}`,
      positions()[state.position],
      contactCentre(),
    );
    frontSlider.endAt(points.length - 1);
    frontSlider.show(state.point, `\u03c6 = ${words(points[state.point].phi)}\u00b0`);
    describe();
    for (const { draw } of DRAWINGS) draw();
  }

  const controls = railcrack.passageControls({
    steps: steps.length,
    positions: () => positions().length,
    state,
    moveTo,
  });
  const frontSlider = railcrack.slider("front", front(0).length - 1, (point) => {
    controls.stop();
    moveTo({ point });
  });
  const select = element("crack", HTMLSelectElement);
  select.append(...cracks.map((_, crack) => new Option(`${crack + 1}`, `${crack}`)));
  select.value = String(state.crack);
  element("which").hidden = cracks.length < 2;
  select.addEventListener("change", () => {
    controls.stop();
    choose(+select.value);
    moveTo({});
  });
  railcrack.wheelMenu(wheels, (under) => {
    controls.stop();
    // The position nearest to that of the wheel before.
    const { positions: others, half_width: a } = wheels[under];
    const position = railcrack.nearestPosition(others, a, contactCentre() - data.origin);
    moveTo({ wheel: under, position });
  });
  const modes = MODES.map(({ name, colour }) => ({ name, colour }));
  for (const figure of [figures.along, figures.history]) figure.explain(modes);
  moveTo({});
  for (const { figure, draw } of DRAWINGS) figure.follow(draw);
});

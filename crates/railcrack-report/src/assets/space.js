// The explorer of cracks in space: sliders for growth step, wheel position and point of the front.
"use strict";

railcrack.viewer("explorer", "The explorer", "the folder plots/ has pictures", async () => {
  const { chart, ends, hertzianPressure, leastIndex, range, shade, signed, singles, words } = railcrack;
  const data = /** @type {SpaceData} */ (railcrack.pageData("space-data"));
  const { wheels, steps, cracks } = data;
  const MODES = /** @type {const} */ ([
    { key: "ki", name: "K_{I}", colour: "var(--c0)" },
    { key: "kii", name: "K_{II}", colour: "var(--c1)" },
    { key: "kiii", name: "K_{III}", colour: "var(--c2)" },
  ]);
  const lastStep = steps.length - 1;
  const state = { step: 0, position: 0, crack: 1, point: 0, wheel: 0 };
  const wheel = () => wheels[state.wheel];
  /** @param {number} step */
  const crackAt = (step, crack = state.crack) => steps[step].cracks[crack - 1];
  /** @param {number} step */
  const front = (step, crack = state.crack) => crackAt(step, crack).front;
  /** A place of a front point on a chart. @typedef {(point: FrontPlace) => Pair} Place */

  /** K of the modes over the positions of each wheel, by step, crack and point of its front. */
  const all = await Promise.all(
    steps.map(({ cracks }) => Promise.all(cracks.map(({ front }) => Promise.all(front.map(decode))))),
  );
  /** @param {FrontPoint} point */
  function decode(point) {
    return Promise.all(
      point.wheels.map(async (under) => {
        const values = MODES.map(({ key }) => (under[key] ? singles(under[key]) : new Float32Array()));
        const [ki, kii, kiii] = await Promise.all(values);
        return { ki, kii, kiii };
      }),
    );
  }
  /** K at the points of the front of the chosen crack under the chosen wheel. */
  const histories = (step = state.step) => all[step][state.crack - 1].map((point) => point[state.wheel]);

  /** Chooses a crack: its deepest point, and the position at which K is largest there. @param {number} crack */
  function choose(crack) {
    state.crack = crack;
    state.point = leastIndex(front(0).map(({ phi }) => Math.abs(phi - 90)));
    const { ki, kii, kiii } = histories(0)[state.point];
    state.position = leastIndex(ki.map((k, i) => -Math.hypot(k, kii[i], kiii[i])));
  }
  const ranges = cracks.map((_, i) => ends(front(0, i + 1).map(({ delta_keq }) => -delta_keq))[0]);
  choose(1 + leastIndex(ranges));

  const contactCentre = () => data.origin + wheel().xc_over_a[state.position] * wheel().half_width;

  // ---- Drawing ----------------------------------------------------------------------------------

  /** The front of a crack as a smooth line. @param {number} step @param {number} crack */
  const outline = (step, crack) => crackAt(step, crack).outline;

  /** The faces of the cracks and their fronts in the first, the last and this step, and the chosen point. @param {ReturnType<typeof chart>} figure @param {Place} place */
  function fronts(figure, place) {
    /** @param {number} step @param {number} crack @param {Attributes} style */
    const line = (step, crack, style) => figure.line(outline(step, crack).map(place), style);
    const drawn = range(cracks.length).flatMap((i) => {
      const isChosen = i + 1 === state.crack;
      const face = { fill: "var(--c0)", "fill-opacity": isChosen ? 0.18 : 0.08, "stroke-width": 0 };
      return [
        line(state.step, i + 1, face),
        line(0, i + 1, { stroke: "var(--quiet)", "stroke-dasharray": "2 3", "stroke-width": 1.6 }),
        line(lastStep, i + 1, { stroke: "var(--quiet)", "stroke-width": 1 }),
        line(state.step, i + 1, { stroke: "var(--ink)", "stroke-width": isChosen ? 3 : 1.6 }),
      ];
    });
    return [...drawn, chosenPoint(figure, place)];
  }
  /** @param {ReturnType<typeof chart>} figure @param {Place} place */
  const chosenPoint = (figure, place) =>
    figure.dot(place(front(state.step)[state.point]), { r: 5, fill: "var(--c4)", stroke: "var(--ink)" });

  const loaded = { fill: "var(--c1)", "fill-opacity": 0.25, stroke: "var(--c1)", "stroke-width": 1.4 };

  function drawAbove() {
    const [figure, xc] = [chart("above"), contactCentre()];
    const { half_width: a, lateral, lateral_half_width: b } = wheel();
    const ellipse = range(73).map((i) => {
      const angle = (Math.PI * i) / 36;
      return /** @type {Pair} */ ([xc + a * Math.cos(angle), lateral + b * Math.sin(angle)]);
    });
    /** @type {Place} */
    const place = ({ x, z }) => [x, z];
    const mouths = range(cracks.length).flatMap((i) => {
      const points = front(state.step, i + 1);
      if (cracks[i].buried) return [];
      const mouth = [points[0], points[points.length - 1]].map(place);
      return [figure.line(mouth, { stroke: "var(--ink)", "stroke-width": 1.4, "stroke-dasharray": "6 4" })];
    });
    figure.show("fronts", [figure.line(ellipse, loaded), ...mouths, ...fronts(figure, place)]);
    figure.svg.dataset.centre = String(xc);
  }

  function drawSide() {
    const figure = chart("side");
    const pressure = hertzianPressure(contactCentre(), wheel().half_width, -0.8 * figure.y.to);
    const load = pressure.map(([x, y]) => /** @type {Pair} */ ([x, -y]));
    figure.show("fronts", [figure.line(load, loaded), ...fronts(figure, ({ x, depth }) => [x, depth])]);
  }

  function drawPlane() {
    const [figure, { strike, middle }, { fold }] = [
      chart("plane"),
      cracks[state.crack - 1],
      crackAt(state.step),
    ];
    // Along the mouth, which a strike turns away from z.
    const [sin, cos] = [Math.sin(strike), Math.cos(strike)];
    /** @type {Place} */
    const place = ({ x, z, down }) => [(z - middle[1]) * cos - (x - middle[0]) * sin, down];
    const dashed = { stroke: "var(--quiet)", "stroke-dasharray": "6 4" };
    const across = [figure.x.from, figure.x.to].map((x) => /** @type {Pair} */ ([x, fold ?? 0]));
    figure.show("fronts", [
      ...(fold === null ? [] : [figure.line(across, dashed)]),
      ...steps.map((_, step) =>
        figure.line(outline(step, state.crack).map(place), {
          stroke: shade(lastStep ? step / lastStep : 0.5),
          "stroke-width": step === state.step ? 3.2 : 1.2,
        }),
      ),
      ...front(state.step).map((point) =>
        figure.dot(
          place(point),
          { r: 3, fill: "var(--ground)", stroke: "var(--ink)" },
          `\u03c6 = ${words(point.phi)}\u00b0\nrate ${words(point.rate)} mm/cycle`,
        ),
      ),
      chosenPoint(figure, place),
    ]);
  }

  const chosenPlace = { stroke: "var(--c4)", "stroke-dasharray": "4 3" };

  function drawAlong() {
    const [figure, points] = [chart("along"), front(state.step)];
    const isFolded = crackAt(state.step).fold !== null;
    const curves = MODES.flatMap(({ key, name, colour }) => {
      const values = histories().map((history) => history[key]);
      const spans = values.map(ends);
      /** @param {0 | 1} end */
      const side = (end) => points.map(({ phi }, i) => /** @type {Pair} */ ([phi, spans[i][end]]));
      const here = points.map(({ phi }, i) => /** @type {Pair} */ ([phi, values[i][state.position]]));
      const band = { fill: colour, "fill-opacity": 0.12, "stroke-width": 0 };
      return [
        figure.line([...side(0), ...side(1).toReversed()], band),
        figure.curve(railcrack.plain(name), here, { stroke: colour }),
      ];
    });
    const strip = 90 * Math.sin((data.layer * Math.PI) / 180);
    const sides = isFolded ? [-90 + strip, -strip, 180 + strip, 270 - strip] : [];
    const layer = cracks[state.crack - 1].buried ? [] : [data.layer, 180 - data.layer, ...sides];
    figure.show("curves-here", [
      ...layer.map((phi) => figure.upright(phi, { stroke: "var(--quiet)", "stroke-dasharray": "2 4" })),
      ...curves,
      figure.upright(points[state.point].phi, chosenPlace),
    ]);
  }

  function drawHistory() {
    const [figure, k] = [chart("history"), histories()[state.point]];
    const { xc_over_a } = wheel();
    figure.show("curves-here", [
      ...MODES.map(({ key, name, colour }) =>
        figure.curve(
          railcrack.plain(name),
          Array.from(k[key], (value, i) => [xc_over_a[i], value]),
          { stroke: colour },
        ),
      ),
      figure.upright(xc_over_a[state.position], chosenPlace),
    ]);
  }

  // ---- Words and controls -----------------------------------------------------------------------

  function describe() {
    const [{ cycles }, crack, point] = [
      steps[state.step],
      crackAt(state.step),
      front(state.step)[state.point],
    ];
    const values = histories()[state.point];
    const k = MODES.map(({ key, name }) => `${name} = ${signed(values[key][state.position] ?? 0, 2)}`).join(
      ", ",
    );
    const axes = crack.fold === null ? "half axes" : "length over the fold and half-length";
    const named = cracks.length > 1 ? `crack ${state.crack}: ${axes}` : axes;
    const under = wheel().name === null ? "" : `Under \u201c${wheel().name}\u201d. `;
    const kink =
      point.wanted === null
        ? ""
        : ` The direction criterion predicts a kink of ${signed(point.wanted, 0)}\u00b0 there.`;
    railcrack.say(
      railcrack.element("readout"),
      `${under}${named.charAt(0).toUpperCase()}${named.slice(1)} ${words(crack.depth)} mm down the dip and ` +
        `${words(crack.half_length)} mm along the surface, after ${words(cycles)} load cycles. ` +
        `At \u03c6 = ${words(point.phi)}\u00b0: ${k} MPa\u221am; \u0394K_{eq} = ${words(point.delta_keq)} MPa\u221am, ` +
        `${words(point.rate)} mm per cycle.${kink}`,
    );
  }

  /** Shows the state after a change of it. @param {Partial<typeof state>} change */
  function moveTo(change) {
    Object.assign(state, change);
    const points = front(state.step);
    state.point = Math.min(state.point, points.length - 1);
    controls.show(`${steps[state.step].step} of ${data.last_step}`, contactCentre());
    frontSlider.endAt(points.length - 1);
    frontSlider.show(state.point, `\u03c6 = ${words(points[state.point].phi)}\u00b0`);
    describe();
    for (const draw of [drawAbove, drawSide, drawPlane, drawAlong, drawHistory]) draw();
  }

  const controls = railcrack.passageControls({
    steps: steps.length,
    wheels,
    cracks: cracks.length,
    state,
    moveTo,
    chooseCrack: (crack) => {
      choose(crack);
      moveTo({});
    },
  });
  railcrack.element("which-front").hidden = false;
  const frontSlider = railcrack.slider("front", front(0).length - 1, (point) => moveTo({ point }));
  for (const id of ["along", "history"])
    chart(id).explain(MODES.map(({ name, colour }) => ({ name, colour })));
  moveTo({});
});

// The deformed neighbourhood of the cracks: the cells of a field file, moved and coloured.
"use strict";

railcrack.viewer("neighbourhood", "The fields", "ParaView shows the files in fields/", async () => {
  const {
    element,
    ends,
    imageMark,
    levels,
    linear,
    pageData,
    picture,
    quantised,
    shades,
    signed,
    sized,
    slider,
    toScale,
    words,
  } = railcrack;
  const { steps } = /** @type {FieldData} */ (pageData("field-data"));
  const run = /** @type {RunData} */ (pageData("run-data"));
  const select = element("field-choice", HTMLSelectElement);
  const field = picture("field");
  const choices = steps.flatMap((step, i) =>
    step.snapshots.map((snapshot, j) => ({
      i,
      j,
      step: step.step,
      xcOverA: run.wheels[0].xc_over_a[snapshot.position - 1],
    })),
  );

  /**
   * A field: points, corners of the cells, displacement from its mean, and stress.
   * @typedef {object} Field
   * @property {Float64Array} x
   * @property {Float64Array} y
   * @property {Float64Array} dx
   * @property {Float64Array} dy
   * @property {Float64Array} stress
   * @property {Uint16Array} corners
   */

  /** @type {Map<(typeof choices)[number], Promise<Field>>} */
  const decoded = new Map();

  /** @param {(typeof choices)[number]} choice @returns {Promise<Field>} */
  async function decode({ i, j }) {
    const step = steps[i];
    const snapshot = step.snapshots[j];
    const all = [step.x, step.y, snapshot.ux, snapshot.uy, snapshot.stress];
    const [x, y, ux, uy, stress] = await Promise.all(all.map((values) => quantised(values)));
    // A line load moves all of a half-plane: only differences mean something.
    /** @param {Float64Array} values */
    const fromMean = (values) => {
      const mean = d3.mean(values) ?? 0;
      return values.map((value) => value - mean);
    };
    return { x, y, dx: fromMean(ux), dy: fromMean(uy), stress, corners: await levels(step.corners) };
  }

  /** @param {(typeof choices)[number]} choice */
  function fieldOf(choice) {
    const known = decoded.get(choice) ?? decode(choice);
    decoded.set(choice, known);
    return known;
  }

  const MAGNIFICATIONS = [0, 1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000];
  const MARGIN = { left: 56, right: 14, top: 10, bottom: 42 };
  const last = choices[choices.length - 1];
  const state = { choice: last, field: await fieldOf(last), magnification: 0 };
  state.magnification = usual(state.field);

  /**
   * The magnification that moves points by about a fiftieth of the picture.
   * @param {Field} field
   */
  function usual({ x, dx, dy }) {
    const [left, right] = ends(x);
    const most = d3.max(dx, (u, i) => Math.hypot(u, dy[i])) || 1;
    return Math.max(0, d3.bisectRight(MAGNIFICATIONS, (0.04 * (right - left)) / most) - 1);
  }

  /**
   * The picture of the cells, `perMm` pixels to a mm, within the domains x and y (depth). Colours
   * end at `most`.
   * @param {{ x: Pair, y: Pair, perUnit: number }} fit
   * @param {number} magnified
   * @param {number} most
   */
  function cells(fit, magnified, most) {
    const { x, y, dx, dy, stress, corners } = state.field;
    // Twice the pixels of the page, for screens that have them.
    const perMm = 2 * fit.perUnit;
    const canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = [perMm * (fit.x[1] - fit.x[0]), perMm * (fit.y[1] - fit.y[0])];
    const context = canvas.getContext("2d");
    if (!context) throw new Error("no canvas to draw on");
    const px = x.map((v, i) => perMm * (v + magnified * dx[i] - fit.x[0]));
    const py = y.map((v, i) => perMm * (-(v + magnified * dy[i]) - fit.y[0]));
    const colours = shades(64);
    context.lineWidth = 0.6;
    for (let c = 0; c < corners.length; c += 4) {
      const [first, ...others] = corners.subarray(c, c + 4);
      const mean = d3.sum([first, ...others], (corner) => stress[corner]) / 4;
      context.fillStyle = context.strokeStyle = colours[Math.min(63, Math.floor((64 * mean) / most))];
      context.beginPath();
      context.moveTo(px[first], py[first]);
      for (const corner of others) context.lineTo(px[corner], py[corner]);
      context.closePath();
      context.fill();
      // The border closes the hairlines between cells.
      context.stroke();
    }
    return canvas.toDataURL("image/png");
  }

  function draw() {
    if (!field.width) return;
    const { x, y, stress } = state.field;
    const magnified = MAGNIFICATIONS[state.magnification];
    const [[left, right], [bottom, top]] = [ends(x), ends(y)];
    const air = 0.04 * (right - left);
    const inside = field.width - MARGIN.left - MARGIN.right;
    const fit = toScale([left - air, right + air], [-top - air, -bottom + air], inside, { most: 480 });
    // The tip is singular: colours end where all but a fiftieth of the points lie.
    const most = d3.quantile(stress, 0.98) || 1;
    const svg = Plot.plot({
      ...sized(field.width, Math.round(fit.height) + MARGIN.top + MARGIN.bottom, MARGIN),
      x: { ...linear("x (mm)", fit.x), grid: false },
      y: { ...linear("Depth (mm)", [fit.y[1], fit.y[0]]), grid: false },
      ariaLabel: "Deformed neighbourhood of the cracks",
      marks: [imageMark(cells(fit, magnified, most)), Plot.frame({ stroke: "var(--line)" })],
    });
    field.show(svg);
    field.explain([{ name: `von Mises stress, 0 to ${words(most)} MPa`, colours: shades(9) }]);
    magnification.show(state.magnification, magnified ? `magnified ${words(magnified)} times` : "none");
    field.caption(
      `Step ${state.choice.step}, x_c/a = ${signed(state.choice.xcOverA, 3)}: displacement relative to its mean over ` +
        "the picture, and von Mises stress of the total stress; values at the tips exceed the scale. " +
        "Source: the files in fields/.",
    );
  }

  select.append(
    ...choices.map(({ step, xcOverA }) => new Option(`step ${step}, x_c/a = ${signed(xcOverA, 2)}`)),
  );
  element("neighbourhood").hidden = false;
  select.selectedIndex = choices.length - 1;
  select.addEventListener("change", async () => {
    const choice = choices[select.selectedIndex];
    const chosen = await fieldOf(choice);
    // Another one has been chosen meanwhile.
    if (choice !== choices[select.selectedIndex]) return;
    Object.assign(state, { choice, field: chosen });
    draw();
  });
  const magnification = slider("field-scale", MAGNIFICATIONS.length - 1, (place) => {
    state.magnification = place;
    draw();
  });
  field.follow(draw);
});

// The deformed neighbourhood of the cracks: the cells of a field file, moved and coloured.
"use strict";

railcrack.viewer("neighbourhood", "The fields", "ParaView shows the files in fields/", async () => {
  const { chart, element, ends, levels, menu, pageData, quantised, range, shape, signed, words } = railcrack;
  const { steps } = /** @type {FieldData} */ (pageData("field-data"));
  const run = /** @type {RunData} */ (pageData("run-data"));
  const figure = chart("field");
  const choices = steps.flatMap((step) =>
    step.snapshots.map((snapshot) => ({
      step,
      snapshot,
      xcOverA: run.wheels[0].xc_over_a[snapshot.position - 1],
    })),
  );
  const MAGNIFICATIONS = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000];

  /** @param {(typeof choices)[number]} choice */
  async function decode({ step, snapshot }) {
    const packed = [step.x, step.y, snapshot.ux, snapshot.uy, snapshot.stress];
    const [x, y, ux, uy, stress] = await Promise.all(packed.map((values) => quantised(values)));
    // A line load moves all of a half-plane: only differences mean something.
    const [dx, dy] = [ux, uy].map((values) => {
      const mean = values.reduce((sum, value) => sum + value, 0) / values.length;
      return values.map((value) => value - mean);
    });
    return { x, y, dx, dy, stress, corners: await levels(step.corners) };
  }
  const last = choices[choices.length - 1];
  const state = { choice: last, field: await decode(last) };

  /** The magnification that moves points by about a fiftieth of the picture. */
  function magnification() {
    const { x, dx, dy } = state.field;
    const [[left, right], most] = [ends(x), ends(dx.map((u, i) => Math.hypot(u, dy[i])))[1] || 1];
    return MAGNIFICATIONS.findLast((times) => times * most <= 0.04 * (right - left)) ?? 0;
  }

  /** The picture of the cells; colours end at `most`. @param {number} magnified @param {number} most */
  function cells(magnified, most) {
    const { x, y, dx, dy, stress, corners } = state.field;
    const [left, top] = [figure.x.start, figure.y.end];
    // Three pixels for one of the drawing, for screens that have them.
    const size = { width: 3 * (figure.x.end - left), height: 3 * (figure.y.start - top) };
    const canvas = Object.assign(document.createElement("canvas"), size);
    const context = canvas.getContext("2d");
    if (!context) throw new Error("no canvas to draw on");
    const px = x.map((v, i) => 3 * (figure.x.at(v + magnified * dx[i]) - left));
    const py = y.map((v, i) => 3 * (figure.y.at(-(v + magnified * dy[i])) - top));
    const style = getComputedStyle(document.documentElement);
    const colours = range(17).map((i) => style.getPropertyValue(`--m${i}`).trim());
    context.lineWidth = 0.8;
    for (let c = 0; c < corners.length; c += 4) {
      const [first, ...others] = corners.subarray(c, c + 4);
      const mean = (stress[first] + others.reduce((sum, corner) => sum + stress[corner], 0)) / 4;
      context.fillStyle = context.strokeStyle = colours[Math.min(16, Math.floor((17 * mean) / most))];
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
    const { choice, field } = state;
    const magnified = element("field-deformed", HTMLInputElement).checked ? magnification() : 0;
    // The tip is singular: colours end where all but a fiftieth of the points lie.
    const sorted = field.stress.toSorted();
    const most = sorted[Math.floor(0.98 * (sorted.length - 1))] || 1;
    const { x, y } = figure;
    const box = { x: x.start, y: y.end, width: x.end - x.start, height: y.start - y.end };
    figure.show("cells", [
      shape("image", { ...box, preserveAspectRatio: "none", href: cells(magnified, most) }),
    ]);
    figure.explain([{ name: `von Mises stress, 0 to ${words(most)} MPa`, mark: "map" }]);
    figure.caption(
      `Step ${choice.step.step}, x_c/a = ${signed(choice.xcOverA, 3)}: displacement relative to its mean over the ` +
        "picture, and von Mises stress of the total stress; values at the tips exceed the scale. " +
        "Source: the files in fields/.",
    );
  }

  const options = choices.map(({ step, xcOverA }, value) => ({
    name: `step ${step.step}, x_c/a = ${signed(xcOverA, 2)}`,
    value,
  }));
  const select = menu("field-choice", options, async (value) => {
    const choice = choices[+value];
    const field = await decode(choice);
    // Another one has been chosen meanwhile.
    if (choice !== choices[select.selectedIndex]) return;
    Object.assign(state, { choice, field });
    draw();
  });
  select.selectedIndex = choices.length - 1;
  element("field-deformed").addEventListener("change", draw);
  draw();
});

// The deformed neighbourhood of the cracks: the cells of a field file, moved and coloured.
"use strict";

(async () => {
  const { words, quantised, levels, legend, typeset, scale, onWidth, tools } = railcrack;
  const find = (id) => document.getElementById(id);
  const { steps } = JSON.parse(find("field-data").textContent);
  const run = JSON.parse(find("run-data").textContent);
  const choices = steps.flatMap((step, i) => step.snapshots.map((snapshot, j) => ({ i, j, step: step.step, at: snapshot.position - 1 })));
  const decoded = new Map();
  let state = null;
  let width = 0;

  /** Points, corners, displacement from its mean, and stress of a choice. */
  async function decode({ i, j }) {
    const key = `${i},${j}`;
    if (!decoded.has(key)) {
      const step = steps[i];
      const { ux, uy, stress } = step.snapshots[j];
      const count = Infinity;
      const [x, y, dx, dy, s] = await Promise.all([step.x, step.y, ux, uy, stress].map((values) => quantised(values, count)));
      const corners = await levels(step.corners, count);
      // A line load moves all of a half-plane: only differences mean something.
      const [mx, my] = [d3.mean(dx), d3.mean(dy)];
      decoded.set(key, { x, y, dx: dx.map((u) => u - mx), dy: dy.map((u) => u - my), s, corners });
    }
    return decoded.get(key);
  }

  const MAGNIFICATIONS = [0, 1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000];

  async function changed() {
    const choice = choices[find("field-choice").selectedIndex];
    state = { choice, field: await decode(choice) };
    draw();
  }

  /** The magnification that moves points by about a fiftieth of the picture. */
  function usual({ x, dx, dy }) {
    const [left, right] = d3.extent(x);
    const most = d3.max(dx, (u, i) => Math.hypot(u, dy[i])) || 1;
    const wanted = 0.04 * (right - left) / most;
    return Math.max(0, d3.bisectRight(MAGNIFICATIONS, wanted) - 1);
  }

  function draw() {
    if (!state || !width) return;
    const { field: { x, y, dx, dy, s, corners }, choice } = state;
    const magnified = MAGNIFICATIONS[+find("field-scale").value];
    const [left, right] = d3.extent(x);
    const [bottom, top] = d3.extent(y);
    const margin = { left: 56, right: 14, top: 10, bottom: 42 };
    const air = 0.04 * (right - left);
    let xs = [left - air, right + air];
    const ys = [-bottom + air, -top - air];
    let perMm = (width - margin.left - margin.right) / (xs[1] - xs[0]);
    if (perMm * (ys[0] - ys[1]) > 480) {
      perMm = 480 / (ys[0] - ys[1]);
      const half = 0.5 * (width - margin.left - margin.right) / perMm;
      xs = [0.5 * (left + right) - half, 0.5 * (left + right) + half];
    }
    // The tip is singular: colours end where all but a fiftieth of the points lie.
    const most = d3.quantile(s, 0.98) || 1;
    const canvas = document.createElement("canvas");
    const fine = 2;
    [canvas.width, canvas.height] = [fine * perMm * (xs[1] - xs[0]), fine * perMm * (ys[0] - ys[1])];
    const context = canvas.getContext("2d");
    const px = x.map((v, i) => fine * perMm * (v + magnified * dx[i] - xs[0]));
    const py = y.map((v, i) => fine * perMm * (-(v + magnified * dy[i]) - ys[1]));
    const table = d3.range(64).map((i) => d3.interpolateViridis(1 - i / 63));
    context.lineWidth = 0.6;
    for (let c = 0; c < corners.length; c += 4) {
      const cell = corners.subarray(c, c + 4);
      const mean = (s[cell[0]] + s[cell[1]] + s[cell[2]] + s[cell[3]]) / 4;
      context.fillStyle = context.strokeStyle = table[Math.min(63, Math.floor(64 * mean / most))];
      context.beginPath();
      context.moveTo(px[cell[0]], py[cell[0]]);
      for (const corner of cell.subarray(1)) context.lineTo(px[corner], py[corner]);
      context.closePath();
      context.fill();
      // The border closes the hairlines between cells.
      context.stroke();
    }
    const url = canvas.toDataURL("image/png");
    const image = (index, scales, values, { marginLeft, marginTop, width, height, marginRight, marginBottom }) =>
      d3.create("svg:image").attr("href", url).attr("x", marginLeft).attr("y", marginTop).attr("width", width - marginLeft - marginRight)
        .attr("height", height - marginTop - marginBottom).attr("preserveAspectRatio", "none").node();
    const svg = Plot.plot({
      width, height: Math.round(perMm * (ys[0] - ys[1])) + margin.top + margin.bottom,
      marginLeft: margin.left, marginRight: margin.right, marginTop: margin.top, marginBottom: margin.bottom,
      x: { ...scale({ title: "x (mm)", scale: "linear" }), domain: xs, grid: false },
      y: { ...scale({ title: "Depth (mm)", scale: "linear" }), domain: ys, grid: false },
      ariaLabel: "Deformed neighbourhood of the cracks", style: { fontSize: "12px", overflow: "visible" },
      marks: [image, Plot.frame({ stroke: "var(--line)" })],
    });
    find("field").querySelector(".drawing").replaceChildren(typeset(svg));
    find("field").querySelector(".legends").replaceChildren(legend([
      { name: `von Mises stress, 0 to ${words(most)} MPa`, colours: d3.range(9).map((i) => d3.interpolateViridis(1 - i / 8)) },
    ]));
    find("field-scale-value").textContent = magnified ? `magnified ${words(magnified)} times` : "none";
    find("field-scale").setAttribute("aria-valuetext", find("field-scale-value").textContent);
    find("field-caption").textContent =
      `Step ${choice.step}, x_c/a = ${run.xc_over_a[choice.at].toFixed(3).replace("-", "\u2212")}: displacement relative to its mean over the picture, ` +
      "and total stress; at the tips it is beyond the scale. From the files in fields/.";
  }

  for (const { step, at } of choices) {
    find("field-choice").append(new Option(`step ${step}, x_c/a = ${run.xc_over_a[at].toFixed(2).replace("-", "\u2212")}`));
  }
  find("neighbourhood").hidden = false;
  find("field-choice").selectedIndex = choices.length - 1;
  find("field-scale").max = MAGNIFICATIONS.length - 1;
  find("field-choice").addEventListener("change", changed);
  find("field-scale").addEventListener("input", draw);
  find("field-scale").value = usual(await decode(choices[choices.length - 1]));
  await changed();
  onWidth(find("field").querySelector(".drawing"), (now) => {
    width = now;
    draw();
  });
  tools(find("field"));
  find("neighbourhood").dataset.ready = "true";
})().catch((reason) => {
  const note = document.createElement("p");
  note.className = "failure";
  note.textContent = `The fields cannot be shown: ${reason.message}.`;
  document.getElementById("neighbourhood").before(note);
  console.error(reason);
});

// The explorer of a passage in the plane: sliders for growth step and wheel position, and their charts.
"use strict";

railcrack.viewer("explorer", "The explorer", "the folder plots/ has pictures", async () => {
  const { chart, charts, element, ends, leastIndex, quantised, range, say, shape, signed } = railcrack;
  const { singles, traffic, unpack, words } = railcrack;
  const data = /** @type {RunData} */ (railcrack.pageData("run-data"));
  const { wheels, steps } = data;
  const first = steps[0];
  const isRow = wheels[0].windows !== null;
  const isMany = isRow || first.tips.length > 4;

  // ---- Histories and faces ----------------------------------------------------------------------

  /** Positions of a wheel near a crack: of a row, those that the page has of it. @param {WheelData} wheel @param {number} crack */
  const windowUnder = (wheel, crack) => wheel.windows?.[crack - 1] ?? wheel.near;

  /** Values over all positions of a wheel; of one crack of a row they are those near it. @param {PackedLevels} packed @param {WheelData} wheel @param {number} crack */
  async function overPassage(packed, wheel, crack) {
    const whole = new Float64Array(wheel.xc_over_a.length).fill(Number.NaN);
    whole.set(await quantised(packed), wheel.windows?.[crack - 1][0] ?? 0);
    return whole;
  }
  /** The histories of a tip of `crack` under a wheel. @param {HistoryData} history @param {WheelData} wheel @param {number} crack */
  async function decodeHistory({ ki, kii, fluid }, wheel, crack) {
    /** @param {PackedLevels | null} packed */
    const over = (packed) => (packed ? overPassage(packed, wheel, crack) : new Float64Array());
    const wet = fluid && { pressure: await over(fluid[0]), volume: await over(fluid[1]) };
    return { ki: await over(ki), kii: await over(kii), fluid: wet };
  }
  /** The histories of the tips of a step under a wheel. @param {RunStepData} step @param {number} under */
  const decodeStep = ({ tips, wheels: all }, under) =>
    Promise.all(all[under].histories.map((one, i) => decodeHistory(one, wheels[under], tips[i].crack)));
  /** By wheel, step and tip. */
  const histories = await Promise.all(
    wheels.map((_, under) => Promise.all(steps.map((step) => decodeStep(step, under)))),
  );

  /** Faces of a crack: values by face point and stored position. @typedef {Awaited<ReturnType<typeof decodeFaces>>} Faces */
  /** @param {FacesData} faces */
  async function decodeFaces(faces) {
    const [s, status] = [await quantised(faces.s), await unpack(faces.status)];
    const row = status.length / s.length;
    const packed = [faces.opening, faces.slip, faces.pressure];
    const [opening, slip, pressure] = await Promise.all(packed.map((values) => quantised(values, row)));
    return { crack: faces.crack, first: faces.first ?? 0, s, row, status, opening, slip, pressure };
  }
  /** The pressure of a coupled wheel, by surface node and position. @typedef {Awaited<ReturnType<typeof decodeContact>>} Contact */
  /** @param {ContactData} contact */
  async function decodeContact({ first, positions, x, pressure }) {
    return { first, positions, x: await singles(x), pressure: await quantised(pressure, positions) };
  }
  /** Faces and contact of a step under a wheel. @param {StepUnderWheel} parts */
  const decode = ({ faces, contact }) =>
    Promise.all([Promise.all((faces ?? []).map(decodeFaces)), contact && decodeContact(contact)]);

  // ---- State ------------------------------------------------------------------------------------

  const firstCrack = data.named?.[0] ?? 1;
  const state = {
    step: 0,
    wheel: 0,
    position: loudest(0, 0, isRow ? firstCrack : null),
    crack: firstCrack,
    faces: /** @type {Faces | null} */ (null),
    contact: /** @type {Contact | null} */ (null),
  };
  const wheel = () => wheels[state.wheel];
  const positions = () => wheel().xc_over_a;
  const historiesHere = () => histories[state.wheel][state.step];
  const step = () => steps[state.step];

  /** The position with the largest |K| of a step under a wheel, of one crack or of all. @param {number} step @param {number} under @param {number | null} crack */
  function loudest(step, under, crack) {
    let [most, at] = [-1, 0];
    for (const [tip, { ki, kii }] of histories[under][step].entries()) {
      if (crack !== null && steps[step].tips[tip].crack !== crack) continue;
      for (let i = 0; i < ki.length; i++) {
        const size = Math.hypot(ki[i], kii[i]);
        if (size > most) [most, at] = [size, i];
      }
    }
    return at;
  }
  const contactCentre = () => data.origin + positions()[state.position] * wheel().half_width;
  /** Whether the wheel is where the charts of the crack have K: a rail that bends has positions far beyond. */
  const isNear = () => {
    const [from, to] = windowUnder(wheel(), state.crack);
    return state.position >= from && state.position <= to;
  };
  /** What is subtracted from x (mm): the charts of a row are about the mouth of the chosen crack. */
  const origin = () => (isRow ? data.mouths[state.crack - 1] : 0);
  /** The wheel position on the charts. @param {number} position */
  const place = (position) =>
    positions()[position] - (isRow ? (data.mouths[state.crack - 1] - data.origin) / wheel().half_width : 0);
  /** A jump in micrometres: hundredths are known, no more. @param {number} mm */
  const microns = (mm) => `${signed(1e3 * mm, 2)} \u00b5m`;

  // ---- Colours, names, fluid --------------------------------------------------------------------

  const STATUS = ["open", "stick", "slip"];
  const STATUS_COLOURS = ["var(--open)", "var(--stick)", "var(--slip)"];
  const hasSecondTips = first.tips.some((tip) => tip.tip > 1);
  /** @param {TipData} tip */
  const tipName = (tip) => (hasSecondTips ? `crack ${tip.crack}, tip ${tip.tip}` : `crack ${tip.crack}`);
  const isSingle = data.cracks.length === 1 && !hasSecondTips;
  /** Of a row or a network the chosen crack stands out. @param {number} crack @param {number} [tip] */
  function colourOf(crack, tip) {
    if (isMany) return crack === state.crack ? "var(--ink)" : "var(--quiet)";
    if (isSingle) return "var(--ink)";
    const place = first.tips.findIndex((other) => other.crack === crack && (tip ?? other.tip) === other.tip);
    return `var(--c${Math.max(place, 0) % 9})`;
  }
  /** Pressure and volume of the fluid in a crack; null of a dry one. @param {number} crack */
  function fluidOf(crack) {
    const fluid = historiesHere()[step().tips.findIndex((tip) => tip.crack === crack)]?.fluid;
    return fluid ? { pressure: fluid.pressure[state.position], volume: fluid.volume[state.position] } : null;
  }
  const fluids = histories.flat(2).flatMap(({ fluid }) => fluid ?? []);
  const isWet = fluids.length > 0;
  const mostPressure = Math.max(0, ...fluids.map(({ pressure }) => ends(pressure)[1]));
  /** The pressure over the largest of the run. @param {{ pressure: number } | null} fluid */
  const shareOfPressure = (fluid) =>
    fluid && mostPressure > 0 ? Math.max(fluid.pressure, 0) / mostPressure : 0;

  // ---- Geometry ---------------------------------------------------------------------------------

  /** The path of a crack to its tips in the step. @param {number} crack @returns {Pair[]} */
  function pathOf(crack) {
    const { lines, cracks } = step();
    if (lines) return lines[crack - 1];
    const [from, to] = cracks[crack - 1];
    return data.cracks[crack - 1].points.slice(from, to + 1);
  }
  /** @param {Pair[]} points */
  const lengthOf = (points) =>
    points.slice(1).reduce((sum, [x, y], i) => sum + Math.hypot(x - points[i][0], y - points[i][1]), 0);
  /** Points about `from`, with their depths. @param {Pair[]} points @param {number} from @returns {Pair[]} */
  const depths = (points, from) => points.map(([x, y]) => [x - from, -y]);
  /** Point, tangent and normal (the tangent turned by +90°) at the arc length `s`. @param {Pair[]} points @param {number} s */
  function frameAt(points, s) {
    let rest = s;
    for (let i = 0; i + 1 < points.length; i++) {
      const [dx, dy] = [points[i + 1][0] - points[i][0], points[i + 1][1] - points[i][1]];
      const length = Math.hypot(dx, dy);
      if (rest <= length || i + 2 === points.length) {
        const t = [dx / length, dy / length];
        return { at: [points[i][0] + rest * t[0], points[i][1] + rest * t[1]], t, n: [-t[1], t[0]] };
      }
      rest -= length;
    }
    return { at: points[0], t: [1, 0], n: [0, 1] };
  }

  // ---- Cracks and wheel -------------------------------------------------------------------------

  const scene = chart("scene");
  /** What a step encloses is there at the start of the next one; of the last step, at its end. @param {{ step: number }} thing */
  const isThere = (thing) => step().step >= thing.step || step().step === data.last_step;

  /** The colours of a network. @param {ReturnType<typeof chart>} figure */
  const explainColours = (figure) => {
    const chosen = { name: `crack ${state.crack}`, colour: "var(--ink)" };
    if (isMany && !isRow) figure.explain([chosen, { name: "other cracks", colour: "var(--quiet)" }]);
  };

  function drawScene() {
    const from = origin();
    const numbers = range(data.cracks.length).map((i) => i + 1);
    // Of a chosen crack among others, and below a surface that has come down, the program has no paths.
    const whole = isMany || step().whole;
    const later = numbers.map((crack) =>
      scene.line(depths(step().whole?.[crack - 1] ?? data.cracks[crack - 1].points, from), {
        stroke: colourOf(crack),
        "stroke-dasharray": "2 3",
        "stroke-width": 1.4,
      }),
    );
    const grown = numbers.map((crack) =>
      scene.line(depths(pathOf(crack), from), { stroke: colourOf(crack), "stroke-width": 3 }),
    );
    scene.background(!whole);
    explainColours(scene);
    scene.show("cracks", [...pieces(from), ...(whole ? later : []), ...grown]);
    scene.show("fluid", isWet ? numbers.flatMap((crack) => fluidIn(crack, from)) : []);
    scene.show("tips", [...tips(from), ...junctions(from)]);
    scene.show("wheel", wheelShapes(contactCentre() - from));
    scene.svg.dataset.centre = String(contactCentre());
    scene.svg.dataset.fluid = isWet ? numbers.map((crack) => fluidOf(crack)?.pressure ?? 0).join(" ") : "";
    scene.svg.dataset.pieces = String(data.pieces.filter(isThere).length);
  }

  /** Pieces of rail that cracks enclose. @param {number} from */
  const pieces = (from) =>
    data.pieces.filter(isThere).flatMap(({ outline, area, kind, crack }) => {
      const corners = depths([...outline, outline[0]], from);
      const dashed = {
        fill: "var(--area)",
        stroke: "var(--c4)",
        "stroke-dasharray": "4 3",
        "stroke-width": 1.2,
      };
      const piece = scene.line(corners, dashed);
      piece.append(shape("title", {}, `${kind} at crack ${crack}, ${words(area)} mm\u00b2`));
      const middle = /** @type {Pair} */ (
        [0, 1].map((c) => corners.reduce((sum, at) => sum + at[c], 0) / corners.length)
      );
      return [piece, scene.words(middle, `${kind} ${words(area)} mm\u00b2`, {})];
    });

  /** @param {number} from */
  const tips = (from) =>
    step().tips.map(({ crack, tip, x, y, length }) =>
      scene.dot(
        [x - from, -y],
        { fill: "var(--ground)", stroke: "var(--ink)", "stroke-width": 1.5 },
        `crack ${crack}, tip ${tip}\nx = ${words(x)} mm, depth ${words(-y)} mm\nlength ${words(length)} mm`,
      ),
    );

  /** @param {number} from */
  const junctions = (from) =>
    data.junctions
      .filter(isThere)
      .map(({ crack, onto, x, y }) =>
        scene.dot(
          [x - from, -y],
          { r: 5, fill: "var(--ink)" },
          `crack ${crack} has joined crack ${onto}\nx = ${words(x)} mm, depth ${words(-y)} mm`,
        ),
      );

  /** The fluid in a crack: the stronger its colour, the higher its pressure, at the mouth where it falls from there. @param {number} crack @param {number} from */
  function fluidIn(crack, from) {
    const share = shareOfPressure(fluidOf(crack));
    if (!(share > 0)) return [];
    const width = { "stroke-width": 4 + 5 * share, "stroke-opacity": 0.15 + 0.85 * share };
    return [scene.line(depths(pathOf(crack), from), { stroke: "var(--c5)", ...width })];
  }

  /** The pressure of the wheel with the direction of its shear, or where the wheel is. @param {number} xc */
  function wheelShapes(xc) {
    const { half_width: a, peak_pressure: peak, friction } = wheel();
    const top = -scene.y.to;
    const low = Math.min(scene.x.from, scene.x.to);
    const high = Math.max(scene.x.from, scene.x.to);
    const colour = { fill: "var(--c1)", "stroke-width": 0 };
    const real = signed(contactCentre(), 1);
    if (xc + a < low)
      return [
        scene.words([low, -0.5 * top], `\u2190 wheel at x = ${real} mm`, {
          ...colour,
          "text-anchor": "start",
        }),
      ];
    if (xc - a > high)
      return [
        scene.words([high, -0.5 * top], `wheel at x = ${real} mm \u2192`, {
          ...colour,
          "text-anchor": "end",
        }),
      ];
    const pressure = railcrack
      .hertzianPressure(xc, a, 0.55 * top)
      .map(([x, y]) => /** @type {Pair} */ ([x, -y]));
    const filled = { fill: "var(--c1)", "fill-opacity": 0.3, stroke: "var(--c1)", "stroke-width": 1.2 };
    const name = peak ? `p_{0} = ${words(peak)} MPa` : "wheel";
    const label = friction ? `${name}, friction ${signed(friction, 3).replace(/0+$/, "")}` : name;
    // The label ends within the picture: half its width, from the usual one of letters.
    const half = (3.5 * label.length * (high - low)) / Math.abs(scene.x.end - scene.x.start);
    const middle = Math.min(Math.max(xc, low + half), high - half);
    const shapes = [scene.line(pressure, filled), scene.words([middle, -0.8 * top], label, colour)];
    if (!friction) return shapes;
    const [x, y, way] = [scene.x.at(xc), scene.y.at(-0.66 * top), Math.sign(friction)];
    const tip = scene.x.at(xc + 0.6 * a * way);
    const arrow = `M${x} ${y}H${tip}M${tip - 7 * way} ${y - 4}L${tip} ${y}L${tip - 7 * way} ${y + 4}`;
    return [...shapes, shape("path", { d: arrow, fill: "none", stroke: "var(--c1)", "stroke-width": 2 })];
  }

  // ---- Contact pressure over the mouth ----------------------------------------------------------

  const isCoupled = wheels.some((wheel) => wheel.is_coupled);
  /** The mouth of a crack in this step; null of a buried one. @param {number} crack */
  function mouthOf(crack) {
    const points = pathOf(crack);
    return [points[0], points[points.length - 1]].find(([, y]) => y > -1e-9)?.[0] ?? null;
  }
  /** The pressure at the surface nodes; null where the wheel does not feel the cracks. @returns {Pair[] | null} */
  function nodalPressures() {
    const { contact } = state;
    const column = state.position - (contact?.first ?? 0);
    if (!contact || column < 0 || column >= contact.positions) return null;
    return Array.from(contact.x, (x, i) => [x, contact.pressure[i * contact.positions + column]]);
  }
  function drawContact() {
    const figure = chart("contact");
    const { half_width: a, peak_pressure: p0, is_coupled } = wheel();
    figure.figure.hidden = !is_coupled;
    if (!(is_coupled && p0)) return;
    const mouth = mouthOf(state.crack) ?? data.origin;
    const hertz = railcrack.hertzianPressure(contactCentre(), a, p0);
    const nodes = nodalPressures();
    const coupled = nodes ?? hertz;
    /** @param {Pair[]} points */
    const about = (points) => points.map(([x, p]) => /** @type {Pair} */ ([x - mouth, p]));
    const mouths = range(data.cracks.length).flatMap((i) => mouthOf(i + 1) ?? []);
    figure.show("coupled", [
      ...mouths.map((x) => figure.upright(x - mouth, { stroke: "var(--quiet)", "stroke-dasharray": "2 3" })),
      figure.line(about(coupled), { fill: "var(--c1)", "fill-opacity": 0.2, "stroke-width": 0 }),
      figure.curve("uncracked rail (Hertz)", about(hertz), {
        stroke: "var(--ink)",
        "stroke-dasharray": "6 4",
        class: "hertz",
      }),
      figure.curve("coupled wheel", about(coupled), { stroke: "var(--c1)", class: "coupled-wheel" }),
    ]);
    const unknown = state.contact
      ? "So far from the mouths the contact is that on the uncracked rail."
      : "No contact pressures of this step on this page; contact.csv has them.";
    const known =
      "At the mouth itself the pressure grows with the number of surface nodes: the picture ends at 1.6 p_{0}.";
    figure.svg.dataset.nodes = String(nodes?.length ?? 0);
    figure.caption(`Contact pressure about the mouth. ${nodes ? known : unknown}`);
  }

  // ---- K over the passage -----------------------------------------------------------------------

  const MODES = /** @type {const} */ (["ki", "kii"]);

  /** The tips that the K charts show, with their histories: of a row those of the chosen crack. */
  const shownTips = () =>
    step()
      .tips.map((tip, i) => ({ tip, history: historiesHere()[i], colour: colourOf(tip.crack, tip.tip) }))
      .filter(({ tip }) => !isRow || tip.crack === state.crack);

  /** The curves of this step, above those that the program has drawn of some steps under the first wheel. */
  function drawK() {
    for (const mode of MODES) {
      const figure = chart(mode);
      const curves = shownTips().map(({ tip, history, colour }) => {
        const [from, to] = windowUnder(wheel(), tip.crack);
        const own = Array.from(history[mode].slice(from, to + 1));
        const points = own.map((k, p) => /** @type {Pair} */ ([place(from + p), k]));
        const name = isSingle ? `step ${step().step}` : `${tipName(tip)}, step ${step().step}`;
        return figure.curve(name, points, { stroke: colour, "stroke-width": 2.8 });
      });
      // Of many tips the curves of all steps show nothing.
      figure.background(state.wheel === 0 && (isRow || !isMany));
      figure.show("step", curves);
      explainColours(figure);
    }
  }

  /** Puts the wheel on the K charts: a line, and a ring on each curve of this step. */
  function markK() {
    const [x, xcOverA] = [place(state.position), positions()[state.position]];
    for (const mode of MODES) {
      const figure = chart(mode);
      const known = shownTips().filter(({ history }) => Number.isFinite(history[mode][state.position]));
      const rings = known.map(({ history, colour }) => {
        const ring = { r: 5, fill: "var(--ground)", stroke: colour, "stroke-width": 2.5, "data-x": xcOverA };
        return figure.dot([x, history[mode][state.position]], ring);
      });
      const line = figure.upright(x, { stroke: "var(--c1)", "stroke-dasharray": "3 3" });
      figure.show("marks", isNear() ? [line, ...rings] : []);
    }
  }

  // ---- The deformed crack -----------------------------------------------------------------------

  /** 1, 2 or 5 times a power of ten, at most `value`. @param {number} value */
  function roundDown(value) {
    const decade = 10 ** Math.floor(Math.log10(value));
    return (value / decade >= 5 ? 5 : value / decade >= 2 ? 2 : 1) * decade;
  }

  /** The jump at the face points and both ends of a crack. @param {Faces} faces @param {Pair[]} points */
  function stationsOf(faces, points) {
    const column = faceColumn(faces, state.position);
    const stations = Array.from(faces.s, (s, i) => {
      const at = i * faces.row + column;
      return { s, slip: faces.slip[at], opening: faces.opening[at], status: faces.status[at] };
    });
    // The jump ends at a tip; at a mouth it goes on.
    const isBuried = points[0][1] < -1e-9;
    const [mouth, last] = [stations[0], stations[stations.length - 1]];
    const closed = { slip: 0, opening: 0, status: 0 };
    if (mouth.s > 0) stations.unshift({ ...(isBuried ? closed : { ...mouth, status: 0 }), s: 0 });
    if (last.s < lengthOf(points)) stations.push({ ...closed, s: lengthOf(points) });
    return stations;
  }

  function drawDeformed() {
    const [figure, { faces }] = [chart("deformed"), state];
    if (!faces) {
      figure.show("faces", []);
      figure.caption(withoutFaces());
      return;
    }
    const points = pathOf(faces.crack);
    const stations = stationsOf(faces, points);
    // One magnification for the whole passage, so that its pictures compare.
    const most = faces.opening.reduce(
      (most, opening, i) => Math.max(most, Math.hypot(opening, faces.slip[i])),
      0,
    );
    const magnified = most > 0 ? roundDown((0.07 * lengthOf(points)) / most) : 1;
    const from = data.mouths[faces.crack - 1];
    /** The + face moves by half the jump, the − face by as much the other way. @param {1 | -1} side @returns {Pair[]} */
    const face = (side) =>
      stations.map(({ s, slip, opening }) => {
        const { at, t, n } = frameAt(points, s);
        const move = 0.5 * side * magnified;
        const [x, y] = [0, 1].map((c) => at[c] + move * (slip * t[c] + opening * n[c]));
        return [x - from, -y];
      });
    const [plus, minus] = [face(1), face(-1)];
    const fluid = fluidOf(faces.crack);
    const between = [...plus, ...minus.toReversed()];
    const wet = {
      fill: "var(--c5)",
      "fill-opacity": 0.15 + 0.85 * shareOfPressure(fluid),
      "stroke-width": 0,
    };
    figure.show("faces", [
      figure.line(between, { fill: "var(--ground)", "stroke-width": 0 }),
      ...(fluid ? [figure.line(between, wet)] : []),
      figure.line(depths(points, from), {
        stroke: "var(--quiet)",
        "stroke-dasharray": "2 3",
        "stroke-width": 1.4,
      }),
      figure.line(plus, { stroke: "var(--c0)", "stroke-width": 2.2 }),
      figure.line(minus, { stroke: "var(--c1)", "stroke-width": 2.2 }),
      ...stations
        .filter(({ status }) => status > 0)
        .map(({ s, status }) => {
          const [x, y] = frameAt(points, s).at;
          return figure.dot([x - from, -y], {
            r: 3.2,
            fill: STATUS_COLOURS[status],
            stroke: "var(--ground)",
          });
        }),
    ]);
    const opening = microns(ends(stations.map(({ opening }) => opening))[1]);
    const slip = microns(ends(stations.map(({ slip }) => Math.abs(slip)))[1]);
    const where = wheel().fluid_falls ? " at the mouth" : "";
    const pressure = fluid ? `, and the fluid pressure is ${signed(fluid.pressure, 1)} MPa${where}` : "";
    figure.caption(
      `Crack ${faces.crack}, deformed: the displacement jump is magnified ${words(magnified)} times; each face shows ` +
        `half of it. At this position the largest opening is ${opening}, the largest slip ${slip}${pressure}.`,
    );
  }

  /** What the page says where it has no faces. */
  function withoutFaces() {
    const known = steps.filter((step) => step.wheels[state.wheel].faces).map(({ step }) => step);
    const what = data.named ? "this crack" : "this wheel";
    const whose = data.named ? `those of cracks ${data.named.join(", ")}` : "them";
    return `No face data for ${what} in this step. This page includes ${whose} in growth steps ${known.join(" and ")}.`;
  }

  // ---- Maps of the faces ------------------------------------------------------------------------

  const MAPS = [chart("face-status"), chart("face-pressure")];
  const faceValue = MAPS[0].figure.appendChild(document.createElement("p"));
  Object.assign(faceValue, { className: "value screen", id: "face-value" });
  faceValue.textContent = "Point at a map for its values; click to move the wheel there.";
  /** Rows of an image of the faces, even in arc length. */
  const ROWS = 240;

  /** The place among the stored positions of the faces that is nearest to a position. @param {Faces} faces @param {number} position */
  function faceColumn(faces, position) {
    if (position === positions().length - 1) return faces.row - 1;
    return Math.max(0, Math.min(Math.round((position - faces.first) / wheel().face_stride), faces.row - 1));
  }
  /** The face point nearest to the arc length `s`. @param {Faces} faces @param {number} s */
  const nearestPoint = (faces, s) => leastIndex(faces.s.map((at) => Math.abs(at - s)));

  /** A colour of the style as numbers. @param {string} name */
  function rgb(name) {
    const text = getComputedStyle(document.documentElement).getPropertyValue(name).trim();
    return [1, 3, 5].map((at) => Number.parseInt(text.slice(at, at + 2), 16));
  }

  /** An image of the faces, a pixel for each stored position; null: an open face, which has the ground of the chart. @param {Faces} faces @param {(at: number) => number[] | null} colour */
  function mapImage(faces, colour) {
    const [near, length] = [wheel().near, lengthOf(pathOf(faces.crack))];
    const [from, to] = isRow
      ? [0, faces.row - 1]
      : [Math.ceil(near[0] / wheel().face_stride), faceColumn(faces, near[1])];
    const across = to - from + 1;
    const canvas = Object.assign(document.createElement("canvas"), { width: across, height: ROWS });
    const context = canvas.getContext("2d");
    if (!context) throw new Error("no canvas to draw on");
    const image = context.createImageData(across, ROWS);
    const isBackwards = positions()[0] > positions()[positions().length - 1];
    for (let j = 0; j < ROWS; j++) {
      // The top row is the largest arc length.
      const point = nearestPoint(faces, (length * (ROWS - 0.5 - j)) / ROWS);
      for (let i = 0; i < across; i++) {
        const pixel = colour(point * faces.row + (isBackwards ? to - i : from + i));
        if (pixel) image.data.set([...pixel, 255], 4 * (j * across + i));
      }
    }
    context.putImageData(image, 0, 0);
    return canvas.toDataURL("image/png");
  }

  /** Where the map of a crack is: its positions and arc lengths, in pixels of a chart. @param {typeof MAPS[number]} map @param {Faces} faces */
  function mapPlace({ x, y }, faces) {
    const [from, to] = windowUnder(wheel(), faces.crack);
    const [left, right] = ends([x.at(place(from)), x.at(place(to))]);
    const top = y.at(lengthOf(pathOf(faces.crack)));
    return { x: left, y: top, width: right - left, height: y.at(0) - top, preserveAspectRatio: "none" };
  }

  function drawMaps() {
    const { faces } = state;
    faceValue.hidden = !faces;
    for (const map of MAPS) map.figure.hidden = !faces;
    if (!faces) return;
    const status = STATUS.map((name, i) => (i ? rgb(`--${name}`) : null));
    const most = ends(faces.pressure)[1] || 1;
    const shades = range(17).map((i) => rgb(`--m${i}`));
    const colours = [
      (/** @type {number} */ at) => status[faces.status[at]],
      (/** @type {number} */ at) =>
        faces.status[at]
          ? shades[Math.max(0, Math.min(16, Math.round((16 * faces.pressure[at]) / most)))]
          : null,
    ];
    for (const [i, map] of MAPS.entries()) {
      const box = mapPlace(map, faces);
      const image = shape("image", {
        ...box,
        href: mapImage(faces, colours[i]),
        style: "image-rendering: pixelated",
      });
      map.show("map", [shape("rect", { ...box, fill: "var(--open)" }), image]);
    }
    const open = { name: "open", colour: STATUS_COLOURS[0], mark: /** @type {const} */ ("box") };
    MAPS[0].explain(STATUS.map((name, i) => ({ ...open, name, colour: STATUS_COLOURS[i] })));
    MAPS[1].explain([open, { name: `pressure, 0 to ${words(most)} MPa`, mark: "map" }]);
  }

  for (const map of MAPS) {
    /** Position and face point under the pointer. @param {Event} event */
    const under = (event) => {
      const { faces } = state;
      if (!faces) return null;
      const [px, py] = map.pointer(event);
      const [x, s] = [map.x.value(px), map.y.value(py)];
      const slack = 0.01 * lengthOf(pathOf(faces.crack));
      if (s < -slack || s > lengthOf(pathOf(faces.crack)) + slack) return null;
      return {
        position: leastIndex(positions().map((_, i) => Math.abs(place(i) - x))),
        point: nearestPoint(faces, s),
        faces,
      };
    };
    map.svg.addEventListener("pointermove", (event) => {
      const found = under(event);
      if (found) say(faceValue, faceText(found.faces, found.position, found.point));
    });
    map.svg.addEventListener("click", (event) => {
      const found = under(event);
      if (found) moveTo({ position: found.position });
    });
  }

  /** The state of a face point. @param {Faces} faces @param {number} position @param {number} point */
  function faceText(faces, position, point) {
    const at = point * faces.row + faceColumn(faces, position);
    return (
      `x_{c}/a = ${signed(positions()[position], 3)}, s = ${words(faces.s[point])} mm: ${STATUS[faces.status[at]]}, ` +
      `pressure ${words(faces.pressure[at])} MPa, ` +
      `opening ${microns(faces.opening[at])}, slip ${microns(faces.slip[at])}`
    );
  }

  /** Puts the wheel on the maps. */
  function markMaps() {
    const here = { class: "here", stroke: "#d55e00", "stroke-width": 2 };
    for (const map of MAPS)
      map.show(
        "wheel",
        isNear()
          ? [map.upright(place(state.position), { ...here, "data-x": positions()[state.position] })]
          : [],
      );
  }

  // ---- Words ------------------------------------------------------------------------------------

  function describe() {
    const { tips } = step();
    const tip = tips.find((tip) => tip.crack === state.crack) ?? tips[0];
    const whose = data.cracks.length > 1 ? `crack ${tip.crack} ` : "";
    const length = `${step().step} of ${data.last_step}: ${whose}${signed(tip.length, 2)} mm`;
    controls.show(`${length}, ${traffic(tip.cycles, data.axle_load)}`, contactCentre());
    const all = tips.map((_, i) => kText(i));
    const shown = all.length <= 4 ? all.join("; ") : all[Math.max(0, tips.indexOf(tip))];
    const under = wheel().name === null ? "" : `Under \u201c${wheel().name}\u201d: `;
    say(element("readout"), `${under}${shown}. ${kinkText(tip)}${tip.stop ? `; stop: ${tip.stop}` : ""}.`);
  }

  /** The name of a tip where there are several things to name. @param {TipData} tip */
  const nameIfSeveral = (tip) => (data.cracks.length > 1 || step().tips.length > 1 ? tipName(tip) : "");

  /** K of a tip with the wheel at its position. @param {number} i */
  function kText(i) {
    const [tip, { ki, kii }] = [step().tips[i], historiesHere()[i]];
    const name = nameIfSeveral(tip);
    if (Number.isNaN(ki[state.position])) return `${name}: no K at this distance of the wheel`;
    const fluid = fluidOf(tip.crack);
    const wet = fluid
      ? `, fluid p = ${signed(fluid.pressure, 1)} MPa, V = ${words(fluid.volume)} mm\u00b2`
      : "";
    const [one, two] = [ki, kii].map((k) => signed(k[state.position] ?? 0, 3));
    return `${name && `${name}: `}K_{I} = ${one}, K_{II} = ${two} MPa\u221am${wet}`;
  }

  /** How a tip goes on. @param {TipData} tip */
  function kinkText(tip) {
    const name = nameIfSeveral(tip) || "the crack";
    const whose = `${name[0].toUpperCase()}${name.slice(1)}`;
    if (tip.kink === null) return `${whose} is unloaded and does not kink`;
    const best = `the best kink is ${signed(tip.kink, 1)}\u00b0`;
    if (!tip.turn) return `${whose} goes straight ahead, where ${best}`;
    return `${whose} turns by ${signed(tip.turn, 1)}\u00b0, where ${best}`;
  }

  // ---- Everything that follows the sliders ------------------------------------------------------

  let asked = 0;
  async function stepChanged() {
    const turn = ++asked;
    const [faces, contact] = await decode(step().wheels[state.wheel]);
    // A later step has been asked for meanwhile.
    if (turn !== asked) return;
    state.contact = contact;
    state.faces = faces.find((faces) => faces.crack === state.crack) ?? null;
    drawK();
    drawMaps();
    const tips = step().tips.filter((tip) => !isRow || tip.crack === state.crack);
    charts.get("length-cycles")?.mark(tips.map((tip) => [tip.cycles, tip.length]));
    charts.get("rate-length")?.mark(tips.map((tip) => [tip.length, tip.rate]));
    positionChanged();
  }

  function positionChanged() {
    drawScene();
    if (isCoupled) drawContact();
    markK();
    drawDeformed();
    markMaps();
    describe();
  }

  /** @param {Partial<Pick<typeof state, "step" | "position" | "crack" | "wheel">>} change */
  function moveTo(change) {
    const before = { ...state };
    Object.assign(state, change);
    const isOther = state.crack !== before.crack || state.wheel !== before.wheel;
    if (state.step !== before.step || isOther) stepChanged();
    else if (state.position !== before.position) positionChanged();
  }

  const controls = railcrack.passageControls({
    steps: steps.length,
    wheels,
    cracks: data.cracks.length,
    state,
    moveTo,
    // One crack of a row for the whole page.
    chooseCrack: (crack) => (isRow ? railcrack.crack.choose(crack) : moveTo({ crack })),
  });
  if (isRow) {
    // The wheel goes where |K| of the crack is largest.
    railcrack.crack.followers.push((crack) => {
      if (crack !== state.crack) moveTo({ crack, position: loudest(state.step, state.wheel, crack) });
    });
    state.crack = railcrack.crack.chosen;
    state.position = loudest(state.step, state.wheel, state.crack);
  }
  await stepChanged();
});

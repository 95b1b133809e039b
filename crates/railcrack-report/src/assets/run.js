// The explorer of a passage: sliders for growth step and wheel position, and what follows them.
"use strict";

railcrack.viewer("explorer", "The explorer", "the folder plots/ has pictures", async () => {
  const { TIP, charts, element, ends, linear, picture, plain, quantised, say, scaleOf } = railcrack;
  const { shades, signed, singles, sized, toScale, tonnage, unpack, words } = railcrack;
  const data = /** @type {RunData} */ (railcrack.pageData("run-data"));
  const { wheels, steps } = data;
  const first = steps[0];
  /** Half-width of the widest contact, mm. */
  const widest = d3.max(wheels, (wheel) => wheel.half_width) ?? 0;
  const hasWindows = wheels[0].windows !== null;
  // Beyond nine tips colours would repeat: then the chosen crack has one, and the others are quiet.
  const isRow = hasWindows || first.tips.length > 9;

  /**
   * The positions of a wheel near a crack: of a row, those that the page has of it.
   * @param {WheelData} wheel
   * @param {number} crack
   */
  const windowUnder = (wheel, crack) => wheel.windows?.[crack - 1] ?? wheel.near;

  // ---- Histories and faces ----------------------------------------------------------------------

  /**
   * Values over all positions of a wheel; of one crack of a row they are those near to it.
   * @param {Packed | PackedLevels} packed
   * @param {WheelData} wheel
   * @param {number} crack
   */
  async function overPassage(packed, wheel, crack) {
    if (typeof packed === "string") return singles(packed);
    const whole = new Float64Array(wheel.xc_over_a.length).fill(Number.NaN);
    whole.set(await quantised(packed), windowUnder(wheel, crack)[0]);
    return whole;
  }

  /**
   * The histories of a tip of `crack` under a wheel.
   * @param {HistoryData} history
   * @param {WheelData} wheel
   * @param {number} crack
   */
  async function decodeHistory({ ki, kii, fluid }, wheel, crack) {
    /** @param {Packed | PackedLevels | null} packed */
    const history = (packed) => (packed ? overPassage(packed, wheel, crack) : new Float64Array());
    return {
      ki: await history(ki),
      kii: await history(kii),
      fluid: fluid && { pressure: await history(fluid[0]), volume: await history(fluid[1]) },
    };
  }
  /**
   * The histories of the tips of a step under a wheel.
   * @param {RunStepData} step
   * @param {number} wheel
   */
  const decodeStep = (step, wheel) =>
    Promise.all(
      step.wheels[wheel].histories.map((history, i) =>
        decodeHistory(history, wheels[wheel], step.tips[i].crack),
      ),
    );
  /** By wheel, step and tip. */
  const histories = await Promise.all(
    wheels.map((_, wheel) => Promise.all(steps.map((step) => decodeStep(step, wheel)))),
  );

  /**
   * Faces of a crack: values by face point and stored position.
   * @typedef {Awaited<ReturnType<typeof decodeFaces>>} Faces
   */

  /** @param {FacesData} faces */
  async function decodeFaces(faces) {
    const s = await singles(faces.s);
    const status = await unpack(faces.status);
    const row = status.length / s.length;
    const [opening, slip, pressure, shear] = await Promise.all(
      [faces.opening, faces.slip, faces.pressure, faces.shear].map((values) => quantised(values, row)),
    );
    return { crack: faces.crack, first: faces.first ?? 0, s, row, status, opening, slip, pressure, shear };
  }

  /**
   * What is decoded of a step under a wheel, once for all.
   * @template Packed, Decoded
   * @param {(parts: StepUnderWheel) => Packed} partOf
   * @param {(part: Packed) => Promise<Decoded>} decode
   */
  function decodedOnce(partOf, decode) {
    /** @type {Map<StepUnderWheel, Promise<Decoded>>} */
    const decoded = new Map();
    /** @param {number} step @param {number} wheel */
    return (step, wheel) => {
      const parts = steps[step].wheels[wheel];
      const known = decoded.get(parts) ?? decode(partOf(parts));
      decoded.set(parts, known);
      return known;
    };
  }

  /** The faces of a step under a wheel, by crack. */
  const facesOf = decodedOnce(
    (parts) => parts.faces ?? [],
    (faces) => Promise.all(faces.map(decodeFaces)),
  );

  /**
   * The place among the stored positions of the faces that is nearest to a position.
   * @param {Faces} faces
   * @param {number} position
   */
  function faceColumn(faces, position) {
    if (position === positions().length - 1) return faces.row - 1;
    const column = Math.round((position - faces.first) / wheel().face_stride);
    return Math.max(0, Math.min(column, faces.row - 1));
  }

  /**
   * The face point nearest to the arc length `s`.
   * @param {Faces} faces
   * @param {number} s
   */
  function nearestPoint(faces, s) {
    const right = Math.min(d3.bisectLeft(faces.s, s), faces.s.length - 1);
    const left = Math.max(right - 1, 0);
    return s - faces.s[left] < faces.s[right] - s ? left : right;
  }

  /**
   * The pressure of a wheel that feels the cracks, by surface node and position.
   * @typedef {Awaited<ReturnType<typeof decodeContact>>} Contact
   */

  /** @param {ContactData} contact */
  async function decodeContact({ first, positions, x, pressure }) {
    return { first, positions, x: await singles(x), pressure: await quantised(pressure, positions) };
  }

  /** The contact in a step under a wheel, where the page has it. */
  const contactOf = decodedOnce(
    (parts) => parts.contact,
    async (contact) => contact && decodeContact(contact),
  );

  // ---- State ------------------------------------------------------------------------------------

  const firstCrack = data.named?.[0] ?? 1;
  const state = {
    step: 0,
    wheel: 0,
    position: loudest(0, 0, isRow ? firstCrack : null),
    crack: firstCrack,
    /** Steps that are kept on the K charts. */
    kept: steps.length > 1 ? [steps.length - 1] : [],
    faces: /** @type {Faces | null} */ (null),
    contact: /** @type {Contact | null} */ (null),
  };

  const wheel = () => wheels[state.wheel];
  /** The positions of the chosen wheel, over its half-width. */
  const positions = () => wheel().xc_over_a;
  /** The histories of the tips of a step under the chosen wheel. @param {number} step */
  const historiesOf = (step) => histories[state.wheel][step];
  /** The positions of the chosen wheel near a crack. @param {number} crack */
  const windowOf = (crack) => windowUnder(wheel(), crack);

  /**
   * The position with the largest |K| of a step under a wheel, of one crack or of all.
   * @param {number} step
   * @param {number} under
   * @param {number | null} crack
   */
  function loudest(step, under, crack) {
    let [most, at] = [-1, 0];
    for (const { ki, kii } of histories[under][step].filter(
      (_, i) => crack === null || steps[step].tips[i].crack === crack,
    ))
      for (let i = 0; i < ki.length; i++) {
        const size = Math.hypot(ki[i], kii[i]);
        if (size > most) [most, at] = [size, i];
      }
    return at;
  }

  const contactCentre = () => data.origin + positions()[state.position] * wheel().half_width;
  /** The wheel positions that charts of the chosen crack span. */
  const nearDomain = () => {
    const [from, to] = windowOf(state.crack);
    return ends([positions()[from], positions()[to]]);
  };
  /** A rail that bends has positions far beyond the contact, of which the far charts have K. */
  const isNear = () => {
    const [from, to] = windowOf(state.crack);
    return state.position >= from && state.position <= to;
  };

  /** A jump in micrometres: hundredths are known, no more. @param {number} mm */
  const microns = (mm) => `${signed(1e3 * mm, 2)} \u00b5m`;

  // ---- Colours and names ------------------------------------------------------------------------

  const STATUS = ["open", "stick", "slip"];
  const STATUS_COLOURS = ["var(--open)", "#0072b2", "#e69f00"];
  const KEPT_COLOURS = ["var(--c1)", "var(--c2)", "var(--c3)", "var(--c4)", "var(--c5)"];

  /** The colour of the first tip that `matches`. @param {(tip: TipData) => boolean} matches */
  const colourOfFirst = (matches) => `var(--c${Math.max(first.tips.findIndex(matches), 0) % 9})`;

  /** @param {number} crack */
  function crackColour(crack) {
    if (data.cracks.length === 1) return "var(--c0)";
    if (isRow) return crack === state.crack ? "var(--c0)" : "var(--quiet)";
    return colourOfFirst((tip) => tip.crack === crack);
  }

  /** Tips of one crack have colours of their own where there are enough. @param {TipData} tip */
  const tipColour = (tip) =>
    isRow
      ? crackColour(tip.crack)
      : colourOfFirst((other) => other.crack === tip.crack && other.tip === tip.tip);

  const hasSecondTips = first.tips.some((tip) => tip.tip > 1);
  /** @param {TipData} tip */
  const tipName = (tip) => (hasSecondTips ? `crack ${tip.crack}, tip ${tip.tip}` : `crack ${tip.crack}`);

  // ---- Fluid ------------------------------------------------------------------------------------

  /**
   * Pressure and volume of the fluid in a crack at the chosen step and position; null of a dry one.
   * @param {number} crack
   */
  function fluidOf(crack) {
    const tip = steps[state.step].tips.findIndex((tip) => tip.crack === crack);
    const fluid = historiesOf(state.step)[tip]?.fluid;
    return fluid ? { pressure: fluid.pressure[state.position], volume: fluid.volume[state.position] } : null;
  }
  const fluids = histories.flat(2).flatMap(({ fluid }) => fluid ?? []);
  const isWet = fluids.length > 0;
  /** The largest pressure of fluid in the run. */
  const mostPressure = d3.max(fluids, ({ pressure }) => d3.max(pressure)) ?? 0;
  /** The pressure over that. @param {{ pressure: number } | null} fluid */
  const shareOfPressure = (fluid) =>
    fluid && mostPressure > 0 ? Math.max(fluid.pressure, 0) / mostPressure : 0;

  // ---- Geometry ---------------------------------------------------------------------------------

  /** The path of a crack to its tips in a step. @param {number} crack @param {number} step */
  function pathOf(crack, step) {
    const { lines, cracks } = steps[step];
    if (lines) return lines[crack - 1];
    const [from, to] = cracks[crack - 1];
    return data.cracks[crack - 1].points.slice(from, to + 1);
  }
  /** The path of a crack to its tips in the last step. @param {number} crack */
  const wholePathOf = (crack) => steps[state.step].whole?.[crack - 1] ?? data.cracks[crack - 1].points;

  /** @param {Pair[]} points */
  const lengthOf = (points) => d3.sum(d3.pairs(points), ([p, q]) => Math.hypot(q[0] - p[0], q[1] - p[1]));

  /**
   * Points with their depths in the place of their heights.
   * @param {Pair[]} points
   * @returns {Pair[]}
   */
  const depths = (points) => points.map(([x, y]) => [x, -y]);

  /**
   * Point, tangent and normal (x2, the tangent turned by +90°) at the arc length `s`.
   * @param {Pair[]} points
   * @param {number} s
   */
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

  const figures = {
    scene: picture("scene"),
    residual: picture("residual"),
    contact: picture("contact"),
    ki: picture("ki"),
    kii: picture("kii"),
    deformed: picture("deformed"),
    status: picture("face-status"),
    pressure: picture("face-pressure"),
  };
  const SCENE_MARGIN = { top: 6, right: 14, bottom: 40, left: 56 };
  const AREA = { fill: "var(--c4)", fillOpacity: 0.3, stroke: "var(--c4)", strokeDasharray: "4 3" };

  /**
   * The part of the rail around `points`, and the height of the wheel's pressure above it.
   * @param {Pair[]} points
   * @param {number} least
   */
  function viewOf(points, least) {
    const [left, right] = ends(points.map(([x]) => x));
    const deepest = -(d3.min(points, ([, y]) => y) ?? 0);
    const beside = Math.max(least, 0.12 * (right - left));
    const across = right - left + 2 * beside;
    const x = /** @type {Pair} */ ([left - beside, right + beside]);
    return { x, load: 0.1 * across, depth: Math.max(1.15 * deepest, 0.16 * across) };
  }
  const everyPoint = [
    ...data.cracks.flatMap((crack) => crack.points),
    ...data.pieces.flatMap((piece) => piece.outline),
    ...steps.flatMap((step) => (step.lines ?? []).flat()),
  ];
  const wholeView = viewOf(everyPoint, 1.4 * widest);

  /**
   * What the picture of the cracks shows, at one scale both ways: of a row, the surroundings of the
   * chosen crack.
   */
  function sceneView() {
    const view = hasWindows ? viewOf(wholePathOf(state.crack), 2.2 * widest) : wholeView;
    const inside = figures.scene.width - SCENE_MARGIN.left - SCENE_MARGIN.right;
    const fit = toScale(view.x, [-1.75 * view.load, view.depth], inside, { most: 520 });
    const height = Math.round(fit.height) + SCENE_MARGIN.top + SCENE_MARGIN.bottom;
    return { ...view, x: fit.x, y: /** @type {Pair} */ ([fit.y[1], fit.y[0]]), perMm: fit.perUnit, height };
  }

  /** What the picture of the cracks shows. @typedef {ReturnType<typeof sceneView>} View */

  /** Whether something with these points is in view. @param {View} view @param {Pair[]} points */
  function isSeen({ x }, points) {
    const [left, right] = ends(points.map(([px]) => px));
    return !isRow || (right >= x[0] && left <= x[1]);
  }

  /**
   * What a step encloses is there at the start of the next one; of the last step, at its end.
   * @param {{ step: number }} thing
   */
  const isThere = ({ step }) => steps[state.step].step >= step || steps[state.step].step === data.last_step;

  function drawScene() {
    if (!figures.scene.width) return;
    const view = sceneView();
    const { x, y, height } = view;
    const svg = Plot.plot({
      ...sized(figures.scene.width, height, SCENE_MARGIN),
      x: { ...linear("x (mm)", x), grid: false },
      y: {
        ...linear("Depth (mm)", y),
        grid: false,
        ticks: d3.ticks(0, y[0], Math.max(2, Math.round((height - 60) / 55))),
      },
      ariaLabel: "Cracks to scale below the wheel",
      marks: [
        Plot.rect([0], { x1: x[0], x2: x[1], y1: 0, y2: y[0], fill: "var(--rail)" }),
        Plot.ruleY([0], { stroke: "var(--ink)", strokeWidth: 2 }),
        ...pieceMarks(view),
        ...crackMarks(view),
        ...wheelMarks(view),
      ],
    });
    svg.dataset.centre = String(contactCentre());
    if (isWet) svg.dataset.fluid = data.cracks.map((_, i) => fluidOf(i + 1)?.pressure ?? 0).join(" ");
    svg.dataset.pieces = String(data.pieces.filter(isThere).length);
    figures.scene.show(svg);
  }

  /** Pieces of rail that cracks enclose. @param {View} view */
  function pieceMarks(view) {
    const pieces = data.pieces.filter((piece) => isThere(piece) && isSeen(view, piece.outline));
    return pieces.flatMap(({ outline, area, kind, crack }) => {
      const corners = depths([...outline, outline[0]]);
      const filled = Plot.line(corners, { ...AREA, className: "piece", clip: isRow });
      const middle = d3.polygonCentroid(corners);
      if (middle[0] < view.x[0] || middle[0] > view.x[1]) return [filled];
      const title = () => `${kind} at crack ${crack}\n${words(area)} mm\u00b2`;
      const name = { x: middle[0], y: middle[1], fill: "var(--ink)", stroke: "var(--rail)", strokeWidth: 4 };
      return [
        filled,
        Plot.dot([middle], { r: 7, fill: "transparent", tip: TIP, title }),
        Plot.text([`${kind} ${words(area)} mm\u00b2`], name),
      ];
    });
  }

  /** Cracks with their fluid, tips and junctions. @param {View} view */
  function crackMarks(view) {
    const paths = data.cracks.flatMap((_, i) => {
      const whole = wholePathOf(i + 1);
      if (!isSeen(view, whole)) return [];
      const later = { stroke: crackColour(i + 1), strokeWidth: 1.6, strokeDasharray: "2 3", clip: isRow };
      const stroke = data.cracks.length === 1 ? "var(--ink)" : crackColour(i + 1);
      return [
        Plot.line(depths(whole), later),
        Plot.line(depths(pathOf(i + 1, state.step)), { stroke, strokeWidth: 3, clip: isRow }),
      ];
    });
    const fluids = isWet ? data.cracks.flatMap((_, i) => fluidMarks(i + 1)) : [];
    const tips = steps[state.step].tips.filter(
      (tip) => !isRow || (tip.x > view.x[0] && tip.x < view.x[1] && -tip.y < view.y[0]),
    );
    /** @param {TipData} tip */
    const tipTitle = (tip) =>
      `crack ${tip.crack}, tip ${tip.tip}\nx = ${words(tip.x)} mm, depth ${words(-tip.y)} mm\nlength ${words(tip.length)} mm`;
    /** @param {RunData["junctions"][number]} junction */
    const junctionTitle = ({ crack, onto, x, y }) =>
      `crack ${crack} has joined crack ${onto}\nx = ${words(x)} mm, depth ${words(-y)} mm`;
    return [
      ...paths,
      ...fluids,
      Plot.dot(tips, {
        x: "x",
        y: (tip) => -tip.y,
        r: 4,
        fill: "var(--ground)",
        stroke: "var(--ink)",
        strokeWidth: 1.5,
        channels: { crack: "crack", length: "length" },
        title: tipTitle,
        tip: TIP,
      }),
      Plot.dot(
        data.junctions.filter((junction) => isThere(junction) && isSeen(view, [[junction.x, junction.y]])),
        {
          x: "x",
          y: (junction) => -junction.y,
          r: 5,
          symbol: "diamond",
          fill: "var(--ink)",
          title: junctionTitle,
          tip: TIP,
        },
      ),
    ];
  }

  /**
   * The fluid in a crack: the stronger its colour, the higher its pressure.
   * @param {number} crack
   */
  function fluidMarks(crack) {
    const share = shareOfPressure(fluidOf(crack));
    if (!(share > 0)) return [];
    const points = pathOf(crack, state.step);
    const falls = wheel().fluid_falls;
    const parts = falls ? 24 : 1;
    const stations = d3.range(parts + 1).map((k) => (k * lengthOf(points)) / parts);
    return d3.range(parts).map((k) => {
      // A single part has the kinks of the crack between its ends.
      const ends = stations.slice(k, k + 2).map((s) => /** @type {Pair} */ (frameAt(points, s).at));
      const here = falls ? share * (1 - (k + 0.5) / parts) : share;
      return Plot.line(depths(parts === 1 ? points : ends), {
        stroke: "var(--c5)",
        strokeWidth: 4 + 5 * here,
        strokeOpacity: 0.15 + 0.85 * here,
        strokeLinecap: "round",
        className: "fluid",
      });
    });
  }

  /**
   * The pressure of the wheel with the direction of its shear, or where the wheel is.
   * @param {View} view
   */
  function wheelMarks(view) {
    const { x, load } = view;
    const [xc, a] = [contactCentre(), wheel().half_width];
    if (xc + a < x[0]) return [farWheel(`\u2190 wheel at x = ${signed(xc, 1)} mm`, view, "start")];
    if (xc - a > x[1]) return [farWheel(`wheel at x = ${signed(xc, 1)} mm \u2192`, view, "end")];
    return [
      Plot.areaY(railcrack.hertzianPressure(xc, a, load), {
        x: "x",
        y1: 0,
        y2: "y",
        fill: "var(--c1)",
        fillOpacity: 0.3,
        stroke: "var(--c1)",
        clip: true,
      }),
      Plot.ruleX([xc], { y1: 0, y2: -load, stroke: "var(--c1)", strokeDasharray: "3 3" }),
      ...shearMarks(view),
    ];
  }

  /**
   * Where the wheel is, at an edge of the picture.
   * @param {string} text
   * @param {View} view
   * @param {"start" | "end"} edge
   */
  const farWheel = (text, { x, load }, edge) =>
    Plot.text([text], {
      x: edge === "start" ? x[0] : x[1],
      y: -0.6 * load,
      dx: edge === "start" ? 8 : -8,
      textAnchor: edge,
      fill: "var(--c1)",
    });

  /** The shear of the wheel as an arrow, and its words. @param {View} view */
  function shearMarks({ x, load, perMm }) {
    const xc = contactCentre();
    const { half_width: a, peak_pressure: peak } = wheel();
    const friction = wheel().friction ?? 0;
    const y = -1.12 * load;
    const name = peak ? `p_{0} = ${words(peak)} MPa` : "wheel";
    const label = friction ? `${name}, friction ${signed(friction, 3).replace(/0+$/, "")}` : name;
    // The label ends within the picture: half its width, from the usual one of letters.
    const half = Math.min((3.5 * plain(label).length) / perMm, 0.5 * (x[1] - x[0]));
    const middle = Math.min(Math.max(xc, x[0] + half), x[1] - half);
    // Above the arrow by the height of the letters, whatever the scale.
    const text = Plot.text([label], { x: middle, y, dy: friction ? -13 : -6, fill: "var(--c1)" });
    if (!friction) return [text];
    const reach = 0.6 * a * Math.sign(friction);
    // The arrow ends within the picture.
    const from = Math.min(Math.max(xc, x[0] - Math.min(reach, 0)), x[1] - Math.max(reach, 0));
    const ends = { x1: from, x2: from + reach, y1: y, y2: y };
    return [
      Plot.arrow([0], { ...ends, stroke: "var(--c1)", strokeWidth: 2, headLength: 9, clip: true }),
      text,
    ];
  }

  function drawResidual() {
    if (!(data.residual && figures.scene.width)) return;
    const { y, height } = sceneView();
    const { depth, sxx } = data.residual;
    const rows = depth.map((depth, i) => ({ depth, sxx: sxx[i] }));
    // Zero beyond the last row, as the computation takes it.
    const last = rows[rows.length - 1];
    if (last.depth < y[0]) rows.push({ depth: last.depth, sxx: 0 }, { depth: y[0], sxx: 0 });
    const [low, high] = ends(rows.map((row) => row.sxx));
    /** @param {(typeof rows)[number]} row */
    const title = (row) => `depth ${words(row.depth)} mm\n\u03c3xx = ${words(row.sxx)} MPa`;
    const svg = Plot.plot({
      ...sized(240, height, { ...SCENE_MARGIN, left: 12, right: 12 }),
      x: { ...linear("\u03c3_{xx} (MPa)"), ticks: 3, nice: true },
      y: { domain: y, axis: null },
      ariaLabel: "Residual stress by depth, at the scale of the cracks",
      marks: [
        Plot.rect([0], { x1: low, x2: high, y1: 0, y2: y[0], fill: "var(--rail)" }),
        Plot.ruleX([0], { y1: 0, y2: y[0], stroke: "var(--quiet)" }),
        Plot.line(rows, { x: "sxx", y: "depth", stroke: "var(--c0)", strokeWidth: 1.8, clip: true }),
        Plot.tip(
          rows.filter((row) => row.depth <= y[0]),
          Plot.pointerY({ x: "sxx", y: "depth", ...TIP, title }),
        ),
      ],
    });
    figures.residual.show(svg);
  }

  // ---- Contact pressure over the mouth ----------------------------------------------------------

  /** Distance from a mouth over a within which the contact load is that on its lips. */
  const LIP = 0.1;
  /** Extent of the picture about the mouth over a, and its height over p0. */
  const CONTACT_REACH = 2;
  const CONTACT_HEIGHT = 1.6;

  /** The mouth of a crack in this step; null of a buried one. @param {number} crack */
  function mouthOf(crack) {
    const points = pathOf(crack, state.step);
    const ends = [points[0], points[points.length - 1]];
    return ends.find(([, y]) => y > -1e-9)?.[0] ?? null;
  }

  /** A pressure at a place of the surface. @typedef {{ x: number, p: number }} SurfacePressure */

  /**
   * The pressure at the surface nodes at the wheel position; null where the wheel does not feel the
   * cracks.
   * @returns {SurfacePressure[] | null}
   */
  function nodalPressures() {
    const { contact } = state;
    const column = state.position - (contact?.first ?? 0);
    if (!contact || column < 0 || column >= contact.positions) return null;
    return Array.from(contact.x, (x, i) => ({ x, p: contact.pressure[i * contact.positions + column] }));
  }

  /**
   * The load within `reach` of `mouth`, where the pressure is linear between `points`.
   * @param {SurfacePressure[]} points
   * @param {number} mouth
   * @param {number} reach
   */
  function loadAround(points, mouth, reach) {
    return d3.sum(d3.pairs(points), ([from, to]) => {
      const [left, right] = [Math.max(from.x, mouth - reach), Math.min(to.x, mouth + reach)];
      if (right <= left) return 0;
      const middle = (0.5 * (left + right) - from.x) / (to.x - from.x);
      return (right - left) * (from.p + middle * (to.p - from.p));
    });
  }

  function drawContact() {
    const figure = figures.contact;
    const { half_width: a, peak_pressure: p0, is_coupled: isCoupled } = wheel();
    element("contact").hidden = !isCoupled;
    if (!(isCoupled && p0 && figure.width)) return;
    const mouth = mouthOf(state.crack) ?? data.origin;
    const domain = [mouth - CONTACT_REACH * a, mouth + CONTACT_REACH * a];
    const hertz = railcrack
      .hertzianPressure(contactCentre(), a, p0)
      .map(({ x, y }) => ({ x, p: Math.abs(y) }));
    const nodes = nodalPressures();
    const felt = nodes ?? hertz;
    const mouths = data.cracks.flatMap((_, i) => mouthOf(i + 1) ?? []);
    const seen = felt.filter(({ x }) => x >= domain[0] && x <= domain[1]);
    /** @param {SurfacePressure} point */
    const title = ({ x, p }) => `x = ${signed(x, 2)} mm\np = ${words(p)} MPa`;
    const svg = Plot.plot({
      ...sized(figure.width, 280, { left: 62, right: 20, top: 10, bottom: 44 }),
      x: linear("x (mm)", /** @type {Pair} */ (domain)),
      y: linear("p (MPa)", [0, CONTACT_HEIGHT * p0]),
      ariaLabel: "Contact pressure over the mouth",
      marks: [
        Plot.frame({ stroke: "var(--line)" }),
        Plot.ruleX(
          mouths.filter((x) => x >= domain[0] && x <= domain[1]),
          { stroke: "var(--quiet)", strokeDasharray: "2 3" },
        ),
        Plot.areaY(felt, { x: "x", y: "p", fill: "var(--c1)", fillOpacity: 0.2, clip: true }),
        Plot.line(hertz, {
          x: "x",
          y: "p",
          stroke: "var(--ink)",
          strokeWidth: 1.4,
          strokeDasharray: "6 4",
          clip: true,
          className: "hertz",
        }),
        Plot.line(felt, {
          x: "x",
          y: "p",
          stroke: "var(--c1)",
          strokeWidth: 2,
          clip: true,
          className: "felt",
        }),
        Plot.tip(seen, Plot.pointer({ x: "x", y: "p", ...TIP, title })),
      ],
    });
    const lip = LIP * a;
    const load = loadAround(felt, mouth, lip);
    svg.dataset.load = String(nodes ? load : "");
    figure.show(svg);
    figure.explain([
      { name: "wheel that feels the cracks", colour: "var(--c1)" },
      { name: "uncracked rail (Hertz)", colour: "var(--ink)", dashes: "6 4" },
      { name: "mouth", colour: "var(--quiet)", dashes: "2 3" },
    ]);
    figure.caption(nodes ? contactText(load, loadAround(hertz, mouth, lip), lip) : withoutContact());
  }

  /** @param {number} load @param {number} hertz @param {number} lip */
  const contactText = (load, hertz, lip) =>
    `${words(load)} N/mm lie on the lips, within ${words(lip)} mm (0.1 a) of the mouth; on the uncracked rail it ` +
    `would be ${words(hertz)} N/mm. At the lips themselves the pressure grows with the number of surface nodes, ` +
    `and the picture ends at ${CONTACT_HEIGHT} times the Hertzian peak; that load does not depend on it.`;

  /** What the page says where it has no pressures of the wheel. */
  function withoutContact() {
    if (!state.contact) return "No contact pressures of this step on this page; contact.csv has them.";
    return "So far from the mouths the contact is that on the uncracked rail.";
  }

  // ---- K over the passage -----------------------------------------------------------------------

  /** @typedef {"ki" | "kii"} Mode */
  const MODES = /** @type {const} */ (["ki", "kii"]);
  const K_TITLES = { ki: "K_{I} (MPa\u221am)", kii: "K_{II} (MPa\u221am)" };

  /** A history on a K chart. @typedef {ReturnType<typeof kCurves>[number]} KCurve */

  /**
   * The curves of a K chart: this step, and those that are kept.
   * @param {Mode} mode
   */
  function kCurves(mode) {
    const hasTips = first.tips.length > 1;
    /** @param {number} index @param {string} colour @param {boolean} isKept */
    const ofStep = (index, colour, isKept) =>
      steps[index].tips.map((tip, i) => {
        const step = `step ${steps[index].step}`;
        const [from, to] = windowOf(tip.crack);
        const history = historiesOf(index)[i][mode];
        return {
          name: hasTips ? `${tipName(tip)}, ${step}` : step,
          step,
          tip,
          isKept,
          colour: hasTips ? tipColour(tip) : colour,
          history,
          points: Array.from(history.slice(from, to + 1), (k, p) => ({ x: positions()[from + p], k })),
        };
      });
    const kept = state.kept.filter((index) => index !== state.step);
    const curves = [
      ...kept.flatMap((index, i) => ofStep(index, KEPT_COLOURS[i % KEPT_COLOURS.length], true)),
      ...ofStep(state.step, "var(--c0)", false),
    ];
    if (!isRow) return curves;
    // Of the quiet cracks this step only, below the chosen one.
    const [from, to] = nearDomain();
    const others = curves.filter(({ tip, isKept, points }) => {
      if (tip.crack === state.crack || isKept || !points.length) return false;
      const [left, right] = ends(points.map((point) => point.x));
      return right >= from && left <= to;
    });
    return [...others, ...curves.filter((curve) => curve.tip.crack === state.crack)];
  }

  /** What the K charts span, in all steps under all wheels, so that they compare. @type {Record<Mode, Pair>} */
  const kExtents = { ki: kExtent("ki"), kii: kExtent("kii") };

  /** @param {Mode} mode @returns {Pair} */
  function kExtent(mode) {
    const [low, high] = ends(histories.flat(2).flatMap((history) => Array.from(history[mode])));
    const air = 0.05 * (high - low || 1);
    return [Math.min(low, 0) - air, Math.max(high, 0) + air];
  }
  // A K_I that is hardly there gets the scale of something, not that of noise.
  const largest = Math.max(...[...kExtents.ki, ...kExtents.kii].map(Math.abs));
  if (kExtents.ki[1] - kExtents.ki[0] < 0.1 * largest) kExtents.ki = [-0.01 * largest, 0.1 * largest];

  /**
   * The charts, with the curves on which rings say where the wheel is.
   * @type {Partial<Record<Mode, { svg: Plotted, curves: KCurve[] }>>}
   */
  const kCharts = {};

  /** @param {Mode} mode */
  function drawK(mode) {
    const figure = figures[mode];
    if (!figure.width) return;
    const curves = kCurves(mode);
    const [from, to] = nearDomain();
    const all = curves
      .flatMap(({ points, name }) => points.map((point) => ({ ...point, name })))
      .filter(({ x }) => !isRow || (x >= from && x <= to));
    /** @param {(typeof all)[number]} point */
    const title = ({ name, x, k }) =>
      `${name}\nx_c/a = ${words(x)}\n${mode === "ki" ? "K_I" : "K_II"} = ${words(k)} MPa\u221am`;
    const lines = curves.map(({ points, colour, isKept }) => {
      const isQuiet = colour === "var(--quiet)";
      return Plot.line(points, {
        x: "x",
        y: "k",
        stroke: colour,
        strokeOpacity: isQuiet ? 0.45 : 1,
        strokeWidth: isKept ? 1.4 : isQuiet ? 1 : 2.2,
        strokeDasharray: isKept ? "5 4" : undefined,
        clip: isRow,
      });
    });
    const svg = Plot.plot({
      ...sized(figure.width, 300, { left: 56, right: 20, top: 10, bottom: 44 }),
      x: linear("Wheel position x_{c}/a", [from, to]),
      y: linear(K_TITLES[mode], kExtents[mode]),
      ariaLabel: `${mode === "ki" ? "K I" : "K II"} against the wheel position`,
      marks: [
        Plot.frame({ stroke: "var(--line)" }),
        Plot.ruleY([0], { stroke: "var(--quiet)" }),
        ...lines,
        Plot.tip(all, Plot.pointer({ x: "x", y: "k", ...TIP, title })),
      ],
    });
    figure.show(svg);
    const chosen = isRow ? curves.filter((curve) => curve.tip.crack === state.crack) : curves;
    figure.explain(kLegend(chosen));
    kCharts[mode] = { svg, curves: chosen.filter((curve) => !curve.isKept) };
    markK(mode);
  }

  /**
   * Of several tips the colours are explained once, and a kept step by its dashes.
   * @param {KCurve[]} curves
   */
  function kLegend(curves) {
    if (first.tips.length === 1) return curves.map(({ name, colour, isKept }) => entry(name, colour, isKept));
    const tips = curves
      .filter((curve) => !curve.isKept)
      .map(({ tip, colour }) => entry(tipName(tip), colour, false));
    const others = isRow ? [entry("other cracks", "var(--quiet)", false)] : [];
    const kept = new Set(curves.filter((curve) => curve.isKept).map(({ step }) => step));
    return [
      ...tips,
      ...others,
      ...[...kept].map((step) => entry(step, "var(--quiet)", true)),
      entry(`step ${steps[state.step].step}`, "var(--quiet)", false),
    ];
  }
  /** @param {string} name @param {string} colour @param {boolean} isKept */
  const entry = (name, colour, isKept) => ({ name, colour, dashes: isKept ? "6 4" : null });

  /**
   * Puts the wheel on a K chart: a line, and a ring on each curve of this step.
   * @param {Mode} mode
   */
  function markK(mode) {
    const chart = kCharts[mode];
    if (!chart) return;
    const [x, y] = [scaleOf(chart.svg, "x"), scaleOf(chart.svg, "y")];
    const at = x.at(positions()[state.position]);
    const group = d3
      .select(chart.svg)
      .selectAll("g.marks")
      .data(isNear() ? [0] : [])
      .join("g");
    group.attr("class", "marks").attr("pointer-events", "none");
    const line = group.selectAll("line").data([at]).join("line").attr("x1", at).attr("x2", at);
    line.attr("y1", y.from).attr("y2", y.to).attr("stroke", "var(--c1)").attr("stroke-dasharray", "3 3");
    group
      .selectAll("circle")
      .data(chart.curves)
      .join("circle")
      .attr("cx", at)
      .attr("cy", ({ history }) => y.at(history[state.position] ?? 0))
      .attr("data-x", positions()[state.position])
      .attr("data-y", ({ history }) => history[state.position])
      .attr("r", 5)
      .attr("fill", "var(--ground)")
      .attr("stroke", ({ colour }) => colour)
      .attr("stroke-width", 2.5);
  }

  // ---- The deformed crack -----------------------------------------------------------------------

  /** 1, 2 or 5 times a power of ten, at most `value`. @param {number} value */
  function roundDown(value) {
    const decade = 10 ** Math.floor(Math.log10(value));
    return (value / decade >= 5 ? 5 : value / decade >= 2 ? 2 : 1) * decade;
  }

  /**
   * The jump at the face points and both ends of a crack, at the wheel position.
   * @param {Faces} faces
   * @param {Pair[]} points
   */
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
    const figure = figures.deformed;
    const faces = state.faces;
    if (!figure.width) return;
    if (!faces) return figure.clear(withoutFaces());
    const points = pathOf(faces.crack, state.step);
    const stations = stationsOf(faces, points);
    const length = lengthOf(points);
    // One magnification for the whole passage, so that its pictures compare.
    const most = d3.max(faces.opening, (opening, i) => Math.hypot(opening, faces.slip[i])) || 0;
    const magnified = most > 0 ? roundDown((0.07 * length) / most) : 1;
    /**
     * The + face moves by half the jump, the − face by as much the other way.
     * @param {1 | -1} side
     */
    const face = (side) =>
      stations.map(({ s, slip, opening }) => {
        const { at, t, n } = frameAt(points, s);
        const move = 0.5 * side * magnified;
        const [x, y] = [
          at[0] + move * (slip * t[0] + opening * n[0]),
          at[1] + move * (slip * t[1] + opening * n[1]),
        ];
        return /** @type {Pair} */ ([x, -y]);
      });
    const [plus, minus] = [face(1), face(-1)];
    const between = [...plus, ...minus.toReversed()];
    const fluid = fluidOf(faces.crack);
    const inContact = stations.filter(({ status }) => status > 0);
    const contacts = inContact.map(({ s, status }) => ({ at: frameAt(points, s).at, status }));
    const { x, y, height } = deformedView(points);
    const isBuried = points[0][1] < -1e-9;
    const filled = { fill: "var(--c5)", fillOpacity: 0.15 + 0.85 * shareOfPressure(fluid), stroke: "none" };
    const svg = Plot.plot({
      ...sized(figure.width, height, SCENE_MARGIN),
      x: { ...linear("x (mm)", x), grid: false },
      y: {
        ...linear("Depth (mm)", y),
        grid: false,
        ticks: d3.ticks(Math.max(0, y[1]), y[0], Math.max(2, Math.round(height / 60))),
      },
      ariaLabel: "Deformed crack",
      marks: [
        Plot.rect([0], { x1: x[0], x2: x[1], y1: Math.max(0, y[1]), y2: y[0], fill: "var(--rail)" }),
        Plot.line(between, { fill: "var(--ground)", stroke: "none" }),
        fluid ? Plot.line(between, { ...filled, className: "fluid" }) : null,
        isBuried ? null : Plot.ruleY([0], { stroke: "var(--ink)", strokeWidth: 1.5 }),
        Plot.line(depths(points), { stroke: "var(--quiet)", strokeDasharray: "2 3" }),
        Plot.line(plus, { stroke: "var(--c0)", strokeWidth: 2.2 }),
        Plot.line(minus, { stroke: "var(--c1)", strokeWidth: 2.2 }),
        Plot.dot(contacts, {
          x: ({ at }) => at[0],
          y: ({ at }) => -at[1],
          r: 3.5,
          symbol: ({ status }) => (status === 1 ? "square" : "diamond"),
          fill: ({ status }) => STATUS_COLOURS[status],
          stroke: "var(--ground)",
          strokeWidth: 0.8,
        }),
      ],
      symbol: { range: ["square", "diamond"], type: "identity" },
      color: { type: "identity" },
    });
    figure.show(svg);
    figure.explain([
      { name: "+ face", colour: "var(--c0)" },
      { name: "\u2212 face", colour: "var(--c1)" },
      { name: "undeformed", colour: "var(--quiet)", dashes: "6 4" },
      { name: "stick", colour: STATUS_COLOURS[1], dots: "only" },
      { name: "slip", colour: STATUS_COLOURS[2], dots: "only" },
      ...(fluid ? [{ name: "fluid, darker at higher pressure", colour: "var(--c5)" }] : []),
    ]);
    const opening = microns(d3.max(stations, ({ opening }) => opening) ?? 0);
    const slip = microns(d3.max(stations, ({ slip }) => Math.abs(slip)) ?? 0);
    const where = wheel().fluid_falls ? " at the mouth" : "";
    const wet = fluid ? `, and the fluid pressure is ${signed(fluid.pressure, 1)} MPa${where}` : "";
    figure.caption(
      `Crack ${faces.crack}. The displacement jump is magnified ${words(magnified)} times; each face shows half of it. ` +
        `At this position the largest opening is ${opening}, the largest slip ${slip}${wet}.`,
    );
  }

  /** What the picture of a deformed crack shows; y by depth, downwards. @param {Pair[]} points */
  function deformedView(points) {
    const air = 0.09 * lengthOf(points);
    const [left, right] = ends(points.map(([x]) => x));
    const [top, bottom] = ends(points.map(([, y]) => -y));
    const above = points[0][1] < -1e-9 ? Math.max(top - air, -air) : -air;
    const inside = figures.deformed.width - SCENE_MARGIN.left - SCENE_MARGIN.right;
    const fit = toScale([left - air, right + air], [above, bottom + air], inside, { most: 400 });
    return {
      x: fit.x,
      y: [fit.y[1], fit.y[0]],
      height: Math.round(fit.height) + SCENE_MARGIN.top + SCENE_MARGIN.bottom,
    };
  }

  /** What the page says where it has no faces. */
  function withoutFaces() {
    const known = steps.filter((step) => step.wheels[state.wheel].faces).map(({ step }) => step);
    if (!data.named && state.wheel === 0) return "No crack-face data for this step.";
    const whose = data.named ? `cracks ${d3.sort(data.named).join(", ")}` : "the faces under this wheel";
    const what = data.named ? "this crack" : "this wheel";
    const rest = state.wheel === 0 ? "; faces.csv has all" : "";
    return `No face data for ${what} in this step. This page includes ${whose} in growth steps ${known.join(" and ")}${rest}.`;
  }

  // ---- Maps of the faces ------------------------------------------------------------------------

  /** @typedef {"status" | "pressure"} MapName */
  /** @type {Partial<Record<MapName, Plotted>>} */
  const maps = {};

  /**
   * An image of the faces: a pixel for each stored position, rows even in arc length.
   * @param {Faces} faces
   * @param {number} length
   * @param {(at: number) => d3.RGBColor} colour
   */
  function mapImage(faces, length, colour) {
    const rows = 240;
    const [nearFirst, nearLast] = wheel().near;
    const [from, to] = hasWindows
      ? [0, faces.row - 1]
      : [Math.ceil(nearFirst / wheel().face_stride), faceColumn(faces, nearLast)];
    const across = to - from + 1;
    const canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = [across, rows];
    const context = canvas.getContext("2d");
    if (!context) throw new Error("no canvas to draw on");
    const image = context.createImageData(across, rows);
    const isBackwards = positions()[0] > positions()[positions().length - 1];
    for (let j = 0; j < rows; j++) {
      // The top row is the largest arc length.
      const point = nearestPoint(faces, (length * (rows - 0.5 - j)) / rows);
      for (let i = 0; i < across; i++) {
        const { r, g, b } = colour(point * faces.row + (isBackwards ? to - i : from + i));
        image.data.set([r, g, b, 255], 4 * (j * across + i));
      }
    }
    context.putImageData(image, 0, 0);
    return canvas.toDataURL("image/png");
  }

  /**
   * @param {MapName} name
   * @param {Faces} faces
   * @param {(at: number) => d3.RGBColor} colour
   * @param {string} ariaLabel
   */
  function drawMap(name, faces, colour, ariaLabel) {
    const figure = figures[name];
    if (!figure.width) return;
    const length = lengthOf(pathOf(faces.crack, state.step));
    const svg = Plot.plot({
      ...sized(figure.width, 250, { left: 56, right: 20, top: 8, bottom: 44 }),
      x: { ...linear("Wheel position x_{c}/a", nearDomain()), grid: false },
      y: { ...linear("Arc length s (mm)", [0, length]), grid: false },
      ariaLabel,
      marks: [
        railcrack.imageMark(mapImage(faces, length, colour), "pixelated"),
        Plot.frame({ stroke: "var(--line)" }),
      ],
    });
    figure.show(svg);
    maps[name] = svg;
    /** @param {Event} event */
    const place = (event) => {
      const [px, py] = d3.pointer(event, svg);
      const [x, y] = [scaleOf(svg, "x").value(px), scaleOf(svg, "y").value(py)];
      const position = d3.leastIndex(positions(), (p) => Math.abs(p - x));
      return y >= 0 && y <= length && position !== undefined
        ? { position, point: nearestPoint(faces, y) }
        : null;
    };
    svg.style.cursor = "crosshair";
    svg.addEventListener("pointermove", (event) => {
      const under = place(event);
      if (under) say(faceValue, faceText(faces, under.position, under.point));
    });
    svg.addEventListener("click", (event) => {
      const under = place(event);
      if (under) moveTo({ position: under.position });
    });
    markMap(name);
  }

  const faceValue = element("face-value");

  /**
   * The state of a face point.
   * @param {Faces} faces
   * @param {number} position
   * @param {number} point
   */
  function faceText(faces, position, point) {
    const at = point * faces.row + faceColumn(faces, position);
    return (
      `x_{c}/a = ${signed(positions()[position], 3)}, s = ${words(faces.s[point])} mm: ${STATUS[faces.status[at]]}, ` +
      `pressure ${words(faces.pressure[at])} MPa, shear ${words(faces.shear[at])} MPa, ` +
      `opening ${microns(faces.opening[at])}, slip ${microns(faces.slip[at])}`
    );
  }

  /** Puts the wheel on a map. @param {MapName} name */
  function markMap(name) {
    const svg = maps[name];
    if (!svg) return;
    const [x, y] = [scaleOf(svg, "x"), scaleOf(svg, "y")];
    const at = x.at(positions()[state.position]);
    const line = d3
      .select(svg)
      .selectAll("line.here")
      .data(isNear() ? [at] : [])
      .join("line");
    line.attr("class", "here").attr("pointer-events", "none").attr("x1", at).attr("x2", at);
    line.attr("y1", y.from).attr("y2", y.to).attr("data-x", positions()[state.position]);
    line.attr("stroke", "#d55e00").attr("stroke-width", 2);
  }

  /** The colours of an image: what is open has that of the theme. */
  const statusRgb = () => [
    railcrack.colourOf("--open"),
    ...STATUS_COLOURS.slice(1).map((colour) => d3.rgb(colour)),
  ];
  const PRESSURE_RGB = shades(256).map((colour) => d3.rgb(colour));

  function drawMaps() {
    const faces = state.faces;
    faceValue.hidden = !faces;
    if (!faces) {
      for (const name of /** @type {const} */ (["status", "pressure"])) {
        delete maps[name];
        figures[name].clear();
      }
      return;
    }
    const status = statusRgb();
    drawMap("status", faces, (at) => status[faces.status[at]], "Status of the crack faces");
    figures.status.explain(STATUS.map((name, i) => ({ name, colour: STATUS_COLOURS[i], box: true })));
    const most = d3.max(faces.pressure) || 1;
    /** @param {number} at */
    const pressureColour = (at) => {
      const level = Math.round((255 * faces.pressure[at]) / most);
      return faces.status[at] === 0 ? status[0] : PRESSURE_RGB[Math.max(0, Math.min(255, level))];
    };
    drawMap("pressure", faces, pressureColour, "Contact pressure on the crack faces");
    figures.pressure.explain([
      { name: "open", colour: STATUS_COLOURS[0], box: true },
      { name: `pressure, 0 to ${words(most)} MPa`, colours: shades(9) },
    ]);
  }

  // ---- Words ------------------------------------------------------------------------------------

  const [readout, keep, clear] = [element("readout"), element("keep", HTMLButtonElement), element("clear")];
  const crackMenu = element("crack", HTMLSelectElement);
  const wheelMenu = railcrack.wheelMenu(wheels, chooseWheel);

  function describe() {
    const step = steps[state.step];
    const tip = step.tips.find((tip) => tip.crack === state.crack) ?? step.tips[0];
    const whose = data.cracks.length > 1 ? `crack ${tip.crack} ` : "";
    const cycles = `${words(tip.cycles)} cycles${tonnage(tip.cycles, data.axle_load)}`;
    const stepText = `${step.step} of ${data.last_step}: ${whose}${signed(tip.length, 2)} mm, ${cycles}`;
    controls.show(stepText, positions()[state.position], contactCentre());
    crackMenu.value = String(state.crack);
    wheelMenu.value = String(state.wheel);
    const k = step.tips.map((_, i) => kText(i));
    const shown = k.length <= 4 ? k.join("; ") : k[Math.max(0, step.tips.indexOf(tip))];
    const event = step.tips.some((tip) => tip.crack === state.crack) ? "" : joined();
    const { name } = wheel();
    const under = name === null ? "" : `Under \u201c${name}\u201d: `;
    say(readout, `${event}${under}${shown}. ${kinkText(tip)}${tip.stop ? `; stop: ${tip.stop}` : ""}.`);
    keep.disabled = state.kept.includes(state.step);
    clear.hidden = state.kept.length === 0;
  }

  /** The name of a tip where there are several things to name. @param {TipData} tip */
  const nameIfSeveral = (tip) =>
    data.cracks.length > 1 || steps[state.step].tips.length > 1 ? tipName(tip) : "";

  /** K of a tip with the wheel at its position. @param {number} i */
  function kText(i) {
    const tip = steps[state.step].tips[i];
    const { ki, kii } = historiesOf(state.step)[i];
    const name = nameIfSeveral(tip);
    if (Number.isNaN(ki[state.position])) return `${name}: no K at this distance of the wheel`;
    const fluid = fluidOf(tip.crack);
    const wet = fluid
      ? `, fluid p = ${signed(fluid.pressure, 1)} MPa, V = ${words(fluid.volume)} mm\u00b2`
      : "";
    const modes = `K_{I} = ${signed(ki[state.position] ?? 0, 3)}, K_{II} = ${signed(kii[state.position] ?? 0, 3)}`;
    return `${name && `${name}: `}${modes} MPa\u221am${wet}`;
  }

  /** How a tip goes on. @param {TipData} tip */
  function kinkText(tip) {
    const name = nameIfSeveral(tip) || "the crack";
    const whose = `${name[0].toUpperCase()}${name.slice(1)}`;
    if (tip.kink === null) return `${whose} is unloaded and does not kink`;
    const kink = `${whose} kinks by ${signed(tip.kink, 1)}\u00b0 at the end of the step`;
    if (tip.rival === null) return kink;
    const share = signed(tip.ratio ?? 0, 3);
    return `${kink} (secondary maximum at ${signed(tip.rival, 1)}\u00b0, ${share} times the selected one)`;
  }

  /** What has become of the chosen crack where it has no tip any more. */
  function joined() {
    const onto = data.junctions.find(
      ({ crack, step }) => crack === state.crack && steps[state.step].step >= step,
    );
    return onto ? `Crack ${state.crack} has joined crack ${onto.onto}. ` : "";
  }

  // ---- Everything that follows the sliders ------------------------------------------------------

  let asked = 0;

  async function stepChanged() {
    const turn = ++asked;
    const [all, contact] = await Promise.all([
      facesOf(state.step, state.wheel),
      contactOf(state.step, state.wheel),
    ]);
    // A later step has been asked for meanwhile.
    if (turn !== asked) return;
    state.contact = contact;
    state.faces = all.find((faces) => faces.crack === state.crack) ?? null;
    for (const mode of MODES) drawK(mode);
    drawMaps();
    const tips = steps[state.step].tips.filter((tip) => !hasWindows || tip.crack === state.crack);
    charts.get("length-cycles")?.mark(tips.map((tip) => ({ x: tip.cycles, y: tip.length })));
    charts.get("rate-length")?.mark(tips.map((tip) => ({ x: tip.length, y: tip.rate })));
    positionChanged();
  }

  function positionChanged() {
    drawScene();
    drawContact();
    for (const mode of MODES) markK(mode);
    drawDeformed();
    markMap("status");
    markMap("pressure");
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
    positions: () => positions().length,
    state,
    moveTo,
  });

  /** Another wheel, at its position nearest to that of the wheel before. @param {number} under */
  function chooseWheel(under) {
    controls.stop();
    const { xc_over_a: others, half_width: a } = wheels[under];
    const position = railcrack.nearestPosition(others, a, contactCentre() - data.origin);
    moveTo({ wheel: under, position });
  }

  /** @param {number[]} kept */
  const keepSteps = (kept) => {
    state.kept = kept;
    stepChanged();
  };
  keep.hidden = clear.hidden = steps.length < 2;
  keep.addEventListener("click", () => keepSteps([...state.kept, state.step].slice(-KEPT_COLOURS.length)));
  clear.addEventListener("click", () => keepSteps([]));

  element("which").hidden = data.cracks.length < 2;
  crackMenu.append(...data.cracks.map((_, i) => new Option(`${i + 1}`)));
  if (hasWindows) {
    // One crack for the whole page; the wheel goes where its |K| is largest.
    crackMenu.addEventListener("change", () => railcrack.crack.choose(+crackMenu.value));
    railcrack.crack.follow((crack) => {
      if (crack !== state.crack) moveTo({ crack, position: loudest(state.step, state.wheel, crack) });
    });
    state.crack = railcrack.crack.now;
    state.position = loudest(state.step, state.wheel, state.crack);
  } else crackMenu.addEventListener("change", () => moveTo({ crack: +crackMenu.value }));

  if (isWet) {
    const caption = railcrack.within(element("scene"), "figcaption");
    caption.append(" Blue bands: fluid in the cracks, wider at higher pressure.");
  }

  element("residual").hidden = !data.residual;
  const isCoupled = wheels.some((wheel) => wheel.is_coupled);
  if (isCoupled) {
    const caption = railcrack.within(element("scene"), "figcaption");
    const whose =
      wheels.length > 1 ? "A wheel that feels the cracks has" : "The wheel of this run feels the cracks:";
    caption.append(` ${whose} its true pressure ${wheels.length > 1 ? "" : "is "}in the next figure.`);
  }
  await stepChanged();
  figures.scene.follow(() => {
    drawScene();
    drawResidual();
  });
  if (isCoupled) figures.contact.follow(drawContact);
  else element("contact").hidden = true;
  figures.ki.follow(() => drawK("ki"));
  figures.kii.follow(() => drawK("kii"));
  figures.deformed.follow(drawDeformed);
  figures.status.follow(drawMaps);
  figures.pressure.follow(drawMaps);
  railcrack.onTheme(drawMaps);
  if (data.residual) railcrack.tools(element("residual"));
});

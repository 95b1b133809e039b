// Shapes of the data that the program writes into a page, for the type checker alone: no page
// contains this file. Lengths are in mm, stresses in MPa, K in MPa√m.

/** Deflated bytes in base64. */
type Packed = string;

/** Numbers quantised to 65536 levels above `low`. */
interface PackedLevels {
  low: number;
  step: number;
  data: Packed;
}

type Pair = [number, number];

// ---- Charts and switches ----------------------------------------------------------------------

type Attributes = Record<string, string | number | undefined>;

/** An axis of a chart: values and pixels at its ends, and one from the other. */
interface ChartAxis {
  title: string;
  from: number;
  to: number;
  start: number;
  end: number;
  log: boolean;
  at(value: number): number;
  value(pixel: number): number;
}

/** An entry of a legend: a line, a dot, a box, the colours of a map, or those of an ordered quantity. */
interface LegendEntry {
  name: string;
  colour?: string;
  dashes?: string;
  mark?: "dot" | "box" | "map" | "ramp";
}

interface MenuOption {
  name: string;
  value: string | number;
}

interface ChoiceGroup {
  name: string;
  values: { name: string; shown: boolean; colour: string | null; dashes: string | null }[];
}

/** Growth step and wheel position, by their places among those of the page; crack from 1. */
interface PassageState {
  step: number;
  position: number;
  wheel: number;
  crack: number;
}

interface WheelOfPassage {
  /** Name and share of the axles in a mix. */
  name: string | null;
  share: number | null;
  half_width: number;
  xc_over_a: number[];
}

/** What the controls of a passage need. */
interface Passage {
  steps: number;
  wheels: WheelOfPassage[];
  cracks: number;
  state: PassageState;
  moveTo(change: Partial<PassageState>): void;
  chooseCrack(crack: number): void;
}

// ---- A run in the plane -----------------------------------------------------------------------

interface TipData {
  crack: number;
  tip: number;
  x: number;
  y: number;
  length: number;
  cycles: number;
  delta_keq: number;
  rate: number;
  /** Best kink of the direction criterion, degrees; null for a tip without load. */
  kink: number | null;
  /** By how much its path turns in the step, degrees; null where that is not known. */
  turn: number | null;
  stop: string;
}

/** Histories of a tip over the positions of a wheel; of many cracks over its window. */
interface HistoryData {
  ki: PackedLevels | null;
  kii: PackedLevels | null;
  /** Pressure and volume. */
  fluid: [PackedLevels, PackedLevels] | null;
}

/** Faces of a crack by face point and stored position. */
interface FacesData {
  crack: number;
  /** The first stored position. */
  first?: number;
  s: PackedLevels;
  status: Packed;
  opening: PackedLevels;
  slip: PackedLevels;
  pressure: PackedLevels;
}

/** Pressures of a wheel that feels the cracks, by surface node and position. */
interface ContactData {
  /** The first position at which it feels them, and their number. */
  first: number;
  positions: number;
  x: Packed;
  pressure: PackedLevels;
}

interface RunStepData {
  step: number;
  /** First and last final point that each crack has in the step. */
  cracks: Pair[];
  /** Paths below a surface that has come down: to the tip of this step, and of the last one. */
  lines: Pair[][] | null;
  whole: Pair[][] | null;
  tips: TipData[];
  /** By wheel. */
  wheels: StepUnderWheel[];
}

/** A step under one wheel; of a mix the wheels but the first have faces in the first and the last step. */
interface StepUnderWheel {
  /** By tip. */
  histories: HistoryData[];
  faces: FacesData[] | null;
  contact: ContactData | null;
}

interface WheelData extends WheelOfPassage {
  is_coupled: boolean;
  peak_pressure: number | null;
  friction: number | null;
  fluid_falls: boolean;
  near: Pair;
  /** Of each of many cracks the first and the last position near it. */
  windows: Pair[] | null;
  /** Stride of the positions of its faces. */
  face_stride: number;
}

interface PieceData {
  kind: string;
  crack: number;
  step: number;
  area: number;
  outline: Pair[];
}

interface RunData {
  wheels: WheelData[];
  /** Numbers of the named cracks of a row. */
  named: number[] | null;
  origin: number;
  axle_load: number | null;
  last_step: number;
  cracks: { points: Pair[] }[];
  /** Where each crack begins along the rail. */
  mouths: number[];
  pieces: PieceData[];
  junctions: { crack: number; onto: number; x: number; y: number; step: number }[];
  steps: RunStepData[];
}

/** What a crack of a row has in a step. */
interface RowQuantity {
  name: string;
  unit: string;
  of(step: number, i: number): number;
}

/** A row of cracks: what has a value for each growth step and crack is in that order. */
interface RowData {
  steps: number[];
  last_step: number;
  cycles: number[];
  axle_load: number | null;
  mouth: number[];
  length: Packed;
  depth: Packed;
  keq: Packed;
  rate: Packed;
  stop: Packed;
  stops: string[];
  ends: Packed;
  removed: number[];
  paths: Pair[][] | null;
  pieces: PieceData[];
  /** Number and distinction of the named cracks. */
  named: [number, string][];
}

interface FieldData {
  steps: {
    step: number;
    x: PackedLevels;
    y: PackedLevels;
    /** Four points of each cell. */
    corners: Packed;
    snapshots: { position: number; ux: PackedLevels; uy: PackedLevels; stress: PackedLevels }[];
  }[];
}

// ---- A run in space ---------------------------------------------------------------------------

interface FrontPlace {
  x: number;
  depth: number;
  /** Distance from the mouth down the dip, over a fold. */
  down: number;
  z: number;
}

interface FrontPoint extends FrontPlace {
  /** Parametric angle along the front, degrees; 90 at the deepest point. */
  phi: number;
  delta_keq: number;
  rate: number;
  /** Kink that the direction criterion asks for, degrees. */
  wanted: number | null;
  /** K by wheel. */
  wheels: { ki: Packed | null; kii: Packed | null; kiii: Packed | null }[];
}

interface SpaceWheel extends WheelOfPassage {
  lateral_half_width: number;
  lateral: number;
}

interface SpaceData {
  wheels: SpaceWheel[];
  origin: number;
  /** Dip and strike in radians; of a folded crack, of its branch. */
  cracks: { dip: number; strike: number; middle: number[]; buried: boolean }[];
  /** Angle of the layer at the surface, degrees. */
  layer: number;
  last_step: number;
  steps: {
    step: number;
    cycles: number;
    /** With the distance of the fold of a folded crack from the mouth. */
    cracks: {
      depth: number;
      half_length: number;
      fold: number | null;
      /** A smooth line through the points of the front, closed for a buried crack. */
      outline: FrontPlace[];
      front: FrontPoint[];
    }[];
  }[];
}

// ---- A study ----------------------------------------------------------------------------------

/** An axis of a study, laid out by the program. */
interface ColumnAxis {
  from: number;
  to: number;
  log: boolean;
  ticks: [number, string][];
}

interface ColumnData {
  name: string;
  title: string;
  /** Whether it is a key of the case, not a result. */
  key: boolean;
  axis: ColumnAxis;
  /** The values of a list, which lie one by one on the axis. */
  levels: number[] | null;
  /** Words that the values count. */
  words: string[] | null;
  data: Packed;
}

interface StudyData {
  columns: ColumnData[];
  /** Where the states of each run begin. */
  first: Packed;
  cycles: Packed;
  lengths: Packed;
}

// ---- What if -----------------------------------------------------------------------------------

interface WhatIfData {
  version: string;
  /** The engine, a WebAssembly module. */
  module: Packed;
  /** Text of the worker that runs it. */
  worker: string;
  /** The case of the page. */
  case: string;
  /** What the curves of that case are called. */
  first: string;
}

/** The case of a life, as the engine has read it. */
interface WhatIfCase {
  title: string;
  toml: string;
  steps: number;
  half_width_mm: number;
  axle_load_t: number | null;
  face_points: number;
}

/** A growth step, as the engine gives it. */
interface WhatIfStep {
  step: number;
  load_cycles: number;
  mgt: number | null;
  removed_mm: number;
  stop: string | null;
  tips: { depth_mm: number; delta_ki_mpa_sqrt_m: number; delta_kii_mpa_sqrt_m: number }[];
  cracks: Pair[][];
  passage: { xc_mm: number[]; tips: { ki_mpa_sqrt_m: number[]; kii_mpa_sqrt_m: number[] }[] } | null;
}

/** A curve of a chart that the engine draws; without a colour it is dashed and quiet. */
interface DrawnCurve {
  name: string;
  colour: number | null;
  points: Pair[];
}

interface DrawnChart {
  kind: "kii" | "ki" | "depth" | "depth-mgt" | "path";
  curves: DrawnCurve[];
}

/** A life, as far as it is computed. */
interface Life {
  case: WhatIfCase;
  steps: WhatIfStep[];
  // biome-ignore lint/suspicious/noExplicitAny: summary.json, of which the page uses little
  summary: any;
}

/** The lines of a section of a case, from its header on, as places in the text. */
interface CaseLines {
  from: number;
  to: number;
}

/** A value of the case that a slider sets: the first of `keys` that the case has, or the only one where it may lack it. */
interface Dial {
  name: string;
  /** By key. */
  units?: string[];
  section: string;
  keys: string[];
  /** Its value where the case lacks the key. */
  absent?: string;
  /** A section without which it means nothing. */
  needs?: string;
  /** Ends and step. */
  range(value: number): [number, number, number];
}

/** An answer of the module: 0, or 1 where no step follows, or 2 for errors. */
interface EngineAnswer {
  code: number;
  // biome-ignore lint/suspicious/noExplicitAny: JSON of the module
  value: any;
}

/** What the module exports. */
interface EngineExports {
  memory: WebAssembly.Memory;
  input(length: number): number;
  output(): number;
  output_length(): number;
  begin(): number;
  step(): number;
  summary(): number;
  decide(): number;
  tables(): number;
  draw(): number;
}

/** What the page asks for: the life of a case, or something about the last one. */
interface EngineRequest {
  id: number;
  text?: string;
  about?: "decide" | "tables";
}

/** What a condition on runs needs of a column. */
interface SelectedColumn {
  name: string;
  words: string[] | null;
  values: ArrayLike<number>;
  text(i: number): string;
}

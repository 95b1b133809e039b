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

type Look = "line" | "dashed" | "fine" | "dash-dot" | "dots" | `varied-${number}`;

interface AxisData {
  title: string;
  scale: "linear" | "log" | "depth";
  /** Whether zero is on the axis. */
  zero?: boolean;
  /** Exact ends. */
  range?: Pair | null;
}

interface CurveData {
  name: string;
  note: string;
  look: Look;
  /** All points, none, or those at these places carry a dot. */
  dots: boolean | number[];
  colour: string;
  wide: boolean;
  fine: boolean;
  /** Of each group of switches the value that the curve belongs to. */
  choices: number[];
  x: (number | null)[];
  y: (number | null)[];
}

interface ChartData {
  x: AxisData;
  y: AxisData;
  equal: boolean;
  legend: boolean;
  caption: string;
  curves: CurveData[];
  areas?: { name: string; x: number[]; y: number[] }[];
  notes?: { at: Pair; words: string }[];
}

interface ChoiceGroup {
  name: string;
  values: { name: string; shown: boolean; colour: string | null; look: Look | null }[];
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
  /** Kink at the end of the step, degrees; null for a tip without load. */
  kink: number | null;
  /** Angle of the secondary maximum of the direction criterion, degrees. */
  rival: number | null;
  /** Value of the secondary maximum over that of the chosen one. */
  ratio: number | null;
  stop: string;
}

/** Histories of a tip over the positions of a wheel; of many cracks over its window. */
interface HistoryData {
  ki: Packed | PackedLevels | null;
  kii: Packed | PackedLevels | null;
  /** Pressure and volume. */
  fluid: [Packed | PackedLevels, Packed | PackedLevels] | null;
}

/** Faces of a crack by face point and stored position. */
interface FacesData {
  crack: number;
  /** The first stored position. */
  first?: number;
  s: Packed;
  status: Packed;
  opening: PackedLevels;
  slip: PackedLevels;
  pressure: PackedLevels;
  shear: PackedLevels;
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

interface WheelData {
  /** Name and share of the axles in a mix. */
  name: string | null;
  share: number | null;
  half_width: number;
  is_coupled: boolean;
  peak_pressure: number | null;
  friction: number | null;
  fluid_falls: boolean;
  near: Pair;
  /** Of each of many cracks the first and the last position near it. */
  windows: Pair[] | null;
  xc_over_a: number[];
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
  pieces: PieceData[];
  junctions: { crack: number; onto: number; x: number; y: number; step: number }[];
  residual: { depth: number[]; sxx: number[] } | null;
  steps: RunStepData[];
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

interface FrontPoint {
  /** Parametric angle along the front, degrees; 90 at the deepest point. */
  phi: number;
  x: number;
  depth: number;
  /** Distance from the mouth down the dip, over a fold. */
  down: number;
  z: number;
  delta_keq: number;
  rate: number;
  /** Kink that the direction criterion asks for, degrees. */
  wanted: number | null;
  /** K by wheel. */
  wheels: { ki: Packed | null; kii: Packed | null; kiii: Packed | null }[];
}

interface SpaceWheel {
  /** Name and share of the axles in a mix. */
  name: string | null;
  share: number | null;
  half_width: number;
  lateral_half_width: number;
  lateral: number;
  positions: number[];
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
    cracks: { depth: number; half_length: number; fold: number | null; front: FrontPoint[] }[];
  }[];
}

// ---- A study ----------------------------------------------------------------------------------

interface ColumnData {
  name: string;
  title: string;
  /** Whether it is a key of the case, not a result. */
  key: boolean;
  log: boolean;
  /** Words that the values count. */
  words: string[] | null;
  data: Packed;
}

/** An estimate with its interval of 95 %, for each key. */
type Estimates = { key: string; estimate: [number, number, number] | null }[];

interface StudyData {
  columns: ColumnData[];
  results: { name: string; title: string; rank: Estimates; sobol: Estimates }[];
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

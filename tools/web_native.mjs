// The module of a page against the program of this system:
//
//     node tools/web_native.mjs MODULE PROGRAM CASE...
//
// Each case is computed by both, the program's into a temporary folder. Every number of sif.csv and
// growth.csv must agree to 1e-6 of the largest in its column (pages have no fused multiply-add, and a path that turns
// under a patch amplifies rounding; under a line contact it is 1e-9), and every word must be the same; likewise in
// the decision of summary.json, where a column is what has the same key. Ends with 1 where something
// differs.
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

/** WebAssembly has no fused multiply-add, and its mathematical functions are others: last digits differ. */
const TOLERANCE = 1e-6;

const [modulePath, program, ...cases] = process.argv.slice(2);
const engineText = readFileSync(
  new URL("../crates/railcrack-report/src/assets/engine.js", import.meta.url),
  "utf8",
);
const openEngine = new Function(`${engineText}; return openEngine;`)();
const module = new WebAssembly.Module(readFileSync(modulePath));
const scratch = mkdtempSync(join(tmpdir(), "railcrack-web-"));
const faults = [];

/** Rows of a table as arrays of fields, column names first. */
const rows = (text) =>
  text
    .split("\n")
    .filter((line) => line && !line.startsWith("#"))
    .map((line) => line.split(","));

/** The largest difference of two tables, relative to the largest number of its column. */
function compare(name, ours, theirs) {
  const [one, other] = [rows(ours), rows(theirs)];
  if (one.length !== other.length || one[0].join() !== other[0].join()) {
    faults.push(`${name}: ${one.length} rows in the page, ${other.length} of the program`);
    return Number.POSITIVE_INFINITY;
  }
  let worst = 0;
  for (const [column, title] of one[0].entries()) {
    const values = other.slice(1).map((row) => row[column]);
    const largest = Math.max(...values.map((value) => Math.abs(Number(value)) || 0), Number.MIN_VALUE);
    for (let i = 1; i < one.length; i++) {
      const [a, b] = [one[i][column], other[i][column]];
      if (a === b) continue;
      const difference = Math.abs(Number(a) - Number(b)) / largest;
      worst = Math.max(worst, difference);
      if (!(difference <= TOLERANCE)) {
        faults.push(`${name}, row ${i}, ${title}: ${a} in the page, ${b} of the program`);
        break;
      }
    }
  }
  return worst;
}

/** The largest number under each key of a value of JSON; of the members of an array, under that of the array. */
function largestByKey(value, key = "", found = new Map()) {
  if (typeof value === "number") found.set(key, Math.max(found.get(key) ?? 0, Math.abs(value)));
  else if (value && typeof value === "object")
    for (const [name, inner] of Object.entries(value)) largestByKey(inner, Array.isArray(value) ? key : name, found);
  return found;
}

/** The same for two values of JSON, `scale` the largest numbers by key. */
function compareValues(name, ours, theirs, scale, key = "") {
  if (typeof theirs === "number" && typeof ours === "number") {
    // Probabilities are compared with 1, and shares of a life with the life: round-off of one is not a tenth
    // of nothing.
    const whole = { probability: 1, left_out_percent: 100 };
    const size = whole[key] ?? (scale.get(key) || Number.MIN_VALUE);
    const difference = ours === theirs ? 0 : Math.abs(ours - theirs) / size;
    if (!(difference <= TOLERANCE)) faults.push(`${name}: ${ours} in the page, ${theirs} of the program`);
    return difference;
  }
  if (theirs && ours && typeof theirs === "object" && typeof ours === "object") {
    const names = new Set([...Object.keys(ours), ...Object.keys(theirs)]);
    const of = (inner) => (Array.isArray(theirs) ? key : inner);
    return Math.max(0, ...[...names].map((inner) => compareValues(`${name}.${inner}`, ours[inner], theirs[inner], scale, of(inner))));
  }
  if (ours !== theirs) faults.push(`${name}: ${ours} in the page, ${theirs} of the program`);
  return 0;
}

for (const file of cases) {
  const folder = join(scratch, `run-${cases.indexOf(file)}`);
  execFileSync(program, ["run", file, "--engine", "dislocation", "--out", folder, "--quiet"]);
  const text = readFileSync(join(folder, "case.toml"), "utf8");
  const engine = openEngine(new WebAssembly.Instance(module, {}));
  const begun = engine.begin(text);
  if (begun.code === 2) {
    faults.push(`${file}: ${JSON.stringify(begun.value)}`);
    continue;
  }
  const times = [];
  for (let code = 0; code === 0; ) {
    const before = performance.now();
    const answer = engine.step();
    code = answer.code;
    if (code === 2) faults.push(`${file}: ${JSON.stringify(answer.value)}`);
    times.push(performance.now() - before);
  }
  const before = performance.now();
  const summary = engine.decide().value;
  const decided = performance.now() - before;
  const tables = engine.tables().value;
  const stored = (name) => readFileSync(join(folder, name), "utf8");
  const differences = ["sif.csv", "growth.csv"].map((name) =>
    compare(`${file}: ${name}`, tables[name], stored(name)),
  );
  const decision = JSON.parse(stored("summary.json")).decision;
  differences.push(compareValues(`${file}: decision`, summary.decision, decision, largestByKey(decision)));
  const [mean, most] = [times.reduce((a, b) => a + b) / times.length, Math.max(...times)];
  const shown = differences.map((value) => value.toExponential(1)).join(", ");
  process.stdout.write(
    `${file}: ${times.length} steps, ${mean.toFixed(0)} ms a step, at most ${most.toFixed(0)}, decision ${decided.toFixed(0)} ms; ` +
      `differences of sif.csv, growth.csv, decision: ${shown}\n`,
  );
}
rmSync(scratch, { recursive: true, force: true });
for (const fault of faults.slice(0, 20)) process.stderr.write(`${fault}\n`);
process.exit(faults.length ? 1 : 0);

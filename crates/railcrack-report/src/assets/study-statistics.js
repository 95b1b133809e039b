// Estimates of what a result depends on, for the runs that conditions leave. Of all runs the page
// has those of the program, which the same formulas give (sensitivity.rs); the test of the pages
// compares both.
"use strict";

const studyStatistics = (() => {
  /** Fewest runs for an estimate. */
  const FEWEST = 20;
  /** Parts into which the values of a key are divided, at most. */
  const PARTS = 24;
  /** Fewest runs in a part. */
  const LEAST = 8;
  /** Samples of the runs for the interval of an index. */
  const RESAMPLED = 100;

  /** Places of `x` in ascending order. @param {ArrayLike<number>} x */
  const ordered = (x) => d3.range(x.length).sort((i, j) => x[i] - x[j]);

  /** Ranks from 0; equal values have the mean of theirs. @param {number[]} values */
  function ranks(values) {
    const order = ordered(values);
    const found = new Float64Array(values.length);
    for (let first = 0; first < order.length; ) {
      let next = first;
      while (next < order.length && values[order[next]] === values[order[first]]) next++;
      for (const i of order.slice(first, next)) found[i] = 0.5 * (first + next - 1);
      first = next;
    }
    return found;
  }

  /**
   * Spearman's rank correlation with the interval of Fisher's transform, variance after Bonett and
   * Wright (2000).
   * @param {number[]} x
   * @param {number[]} y
   * @returns {[number, number, number] | null}
   */
  function rankCorrelation(x, y) {
    if (x.length < FEWEST) return null;
    const [a, b] = [ranks(x), ranks(y)];
    const mean = 0.5 * (x.length - 1);
    /** @param {Float64Array} one @param {Float64Array} other */
    const product = (one, other) => d3.sum(one, (value, i) => (value - mean) * (other[i] - mean));
    const size = Math.sqrt(product(a, a) * product(b, b));
    if (!(size > 0)) return null;
    const value = Math.max(-1, Math.min(1, product(a, b) / size));
    const deviation = Math.sqrt((1 + 0.5 * value * value) / (x.length - 3));
    const centre = Math.atanh(Math.max(-0.999999, Math.min(0.999999, value)));
    const [low, high] = [-1.96, 1.96].map((by) => Math.tanh(centre + by * deviation));
    return [value, Math.min(low, value), Math.max(high, value)];
  }

  /**
   * The part of each value: one for each value of a few, else of equal numbers of runs.
   * @param {number[]} x
   */
  function parts(x) {
    const values = d3.sort(new Set(x));
    if (values.length <= PARTS) return x.map((value) => d3.bisectLeft(values, value));
    const count = Math.max(2, Math.min(PARTS, Math.floor(x.length / LEAST)));
    const found = new Array(x.length).fill(0);
    for (const [rank, i] of ordered(x).entries()) found[i] = Math.floor((rank * count) / x.length);
    return found;
  }

  /**
   * The adjusted correlation ratio of `y` over the parts, of the runs `sample`.
   * @param {number[]} part
   * @param {number[]} y
   * @param {ArrayLike<number>} sample
   */
  function ratio(part, y, sample) {
    const count = (d3.max(part) ?? 0) + 1;
    const [sums, counts] = [new Float64Array(count), new Uint32Array(count)];
    let mean = 0;
    for (let k = 0; k < sample.length; k++) mean += y[sample[k]] / sample.length;
    let total = 0;
    for (let k = 0; k < sample.length; k++) {
      const i = sample[k];
      sums[part[i]] += y[i] - mean;
      counts[part[i]]++;
      total += (y[i] - mean) ** 2;
    }
    const used = counts.filter((n) => n > 0).length;
    const rest = sample.length - used;
    if (rest <= 0 || !(total > 0)) return null;
    let between = 0;
    for (let p = 0; p < count; p++) if (counts[p]) between += sums[p] ** 2 / counts[p];
    const within = (total - between) / rest;
    return Math.max(0, Math.min(1, (between - (used - 1) * within) / total));
  }

  /** Numbers in [0, 1) without order, the same on every page (mulberry32). @param {number} seed */
  function random(seed) {
    let state = seed;
    return () => {
      state = (state + 0x6d2b79f5) | 0;
      let bits = Math.imul(state ^ (state >>> 15), state | 1);
      bits ^= bits + Math.imul(bits ^ (bits >>> 7), bits | 61);
      return ((bits ^ (bits >>> 14)) >>> 0) / 2 ** 32;
    };
  }

  /**
   * The first-order Sobol index of `x` by the adjusted correlation ratio (Kelley 1935), with the
   * interval of samples of the runs (Efron 1979).
   * @param {number[]} x
   * @param {number[]} y
   * @returns {[number, number, number] | null}
   */
  function firstOrder(x, y) {
    if (x.length < FEWEST) return null;
    const part = parts(x);
    const value = ratio(part, y, d3.range(x.length));
    if (value === null) return null;
    const next = random(x.length);
    const others = d3
      .range(RESAMPLED)
      .flatMap(
        () =>
          ratio(
            part,
            y,
            Uint32Array.from(x, () => Math.floor(next() * x.length)),
          ) ?? [],
      )
      .sort(d3.ascending);
    if (!others.length) return null;
    /** @param {number} share */
    const at = (share) => others[Math.round((others.length - 1) * share)];
    // A sample with repetition has a ratio of its own: only its spread counts.
    /** @param {number} share */
    const shifted = (share) => Math.max(0, Math.min(1, at(share) - at(0.5) + value));
    return [value, Math.min(shifted(0.025), value), Math.max(shifted(0.975), value)];
  }

  return { rankCorrelation, firstOrder };
})();

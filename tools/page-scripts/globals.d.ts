// Observable Plot, which a page holds as a script of its own; d3 says the same of itself.

declare const Plot: typeof import("@observablehq/plot");

/** A drawn chart. `value` is the datum under the pointer. */
type Plotted = ReturnType<typeof Plot.plot>;

// Conditions that select runs of a study: `contact.friction > 0.1, stop = arrest`.
"use strict";

const studyConditions = (() => {
  /**
   * What a condition needs of a column.
   * @typedef {{ name: string, words: string[] | null, values: ArrayLike<number>, text: (i: number) => string }} Selected
   */

  /** @type {Record<string, (a: string | number, b: string | number) => boolean>} */
  const COMPARED = {
    "<": (a, b) => a < b,
    "<=": (a, b) => a <= b,
    ">": (a, b) => a > b,
    ">=": (a, b) => a >= b,
    "=": (a, b) => a === b,
    "!=": (a, b) => a !== b,
  };
  const SIGNS = { "==": "=", "\u2264": "<=", "\u2265": ">=", "\u2260": "!=", "<>": "!=" };

  /**
   * The column called `name`, in full or by its end after a dot; or why there is none.
   * @param {string} name
   * @param {Selected[]} columns
   * @returns {Selected | string}
   */
  function called(name, columns) {
    const exact = columns.find((column) => column.name === name);
    const ends = columns.filter((column) => column.name.endsWith(`.${name}`));
    if (exact || ends.length === 1) return exact ?? ends[0];
    if (ends.length > 1) return `\u201c${name}\u201d may be ${ends.map(({ name }) => name).join(" or ")}`;
    return `no column is called \u201c${name}\u201d; there are ${columns.map(({ name }) => name).join(", ")}`;
  }

  /**
   * Whether run `i` meets the condition `text`; or what of it is not understood.
   * @param {string} text
   * @param {Selected[]} columns
   * @returns {((i: number) => boolean) | string}
   */
  function condition(text, columns) {
    const [, name, given, value] =
      /^(.+?)\s*(<=|>=|!=|==|<>|<|>|=|\u2264|\u2265|\u2260)\s*(.+)$/.exec(text) ?? [];
    if (!name) return `\u201c${text}\u201d is no condition such as ${columns[1]?.name ?? "run"} > 0.1`;
    const sign = SIGNS[/** @type {keyof typeof SIGNS} */ (given)] ?? given;
    const column = called(name, columns);
    if (typeof column === "string") return column;
    const compare = COMPARED[sign];
    if (!column.words) {
      const number = Math.fround(Number(value.replace("\u2212", "-")));
      if (Number.isNaN(number)) return `\u201c${value}\u201d is not a number, which ${column.name} has`;
      return (i) => compare(column.values[i], number);
    }
    const word = value.replace(/^["']|["']$/g, "");
    if (sign !== "=" && sign !== "!=") return `${column.name} has words, which only = and != compare`;
    if (!column.words.includes(word))
      return `\u201c${word}\u201d is no value of ${column.name}; there are ${column.words.join(", ")}`;
    return (i) => compare(column.text(i), word);
  }

  /**
   * The conditions in `text`, separated by commas, semicolons or "and", and what of it is not
   * understood.
   * @param {string} text
   * @param {Selected[]} columns
   */
  function read(text, columns) {
    const parts = text.split(/\s*(?:[,;]|&&?|\band\b)\s*/i).filter((part) => part.trim());
    const all = parts.map((part) => condition(part.trim(), columns));
    return {
      conditions: all.flatMap((one) => (typeof one === "string" ? [] : [one])),
      faults: all.filter((one) => typeof one === "string"),
    };
  }

  return { read };
})();

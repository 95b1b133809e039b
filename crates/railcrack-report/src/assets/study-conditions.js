// Conditions that select runs of a study: `contact.friction > 0.1, stop = arrest`.
"use strict";

const studyConditions = (() => {
  /** @type {Record<string, (a: string | number, b: string | number) => boolean>} */
  const COMPARED = {
    "<": (a, b) => a < b,
    "<=": (a, b) => a <= b,
    ">": (a, b) => a > b,
    ">=": (a, b) => a >= b,
    "=": (a, b) => a === b,
    "!=": (a, b) => a !== b,
  };

  /** Whether run `i` meets the condition `text`; or what of it is not understood. @param {string} text @param {SelectedColumn[]} columns @returns {((i: number) => boolean) | string} */
  function condition(text, columns) {
    const [, name, sign, value] = /^(.+?)\s*(<=|>=|!=|<|>|==?)\s*(.+)$/.exec(text) ?? [];
    if (!name) return `\u201c${text}\u201d is no condition such as run > 10`;
    // In full, or by its end after a dot.
    const ends = columns.filter((column) => column.name.endsWith(`.${name}`));
    const column = columns.find((column) => column.name === name) ?? (ends.length === 1 ? ends[0] : null);
    const names = columns.map((column) => column.name).join(", ");
    if (!column) return `no column is called \u201c${name}\u201d; there are ${names}`;
    const compare = COMPARED[sign === "==" ? "=" : sign];
    if (!column.words) {
      const number = Math.fround(Number(value.replace("\u2212", "-")));
      if (Number.isNaN(number)) return `\u201c${value}\u201d is not a number, which ${column.name} has`;
      return (i) => compare(column.values[i], number);
    }
    const word = value.replace(/^["']|["']$/g, "");
    if (/[<>]/.test(sign)) return `${column.name} has words, which only = and != compare`;
    if (column.words.includes(word)) return (i) => compare(column.text(i), word);
    return `\u201c${word}\u201d is no value of ${column.name}; there are ${column.words.join(", ")}`;
  }

  /** The conditions in `text`, separated by commas, semicolons or "and", and what of it is not understood. @param {string} text @param {SelectedColumn[]} columns */
  function read(text, columns) {
    const parts = text.split(/[,;]|\band\b/i).map((part) => part.trim());
    const all = parts.filter((part) => part).map((part) => condition(part, columns));
    const conditions = all.flatMap((one) => (typeof one === "string" ? [] : [one]));
    return { conditions, faults: all.filter((one) => typeof one === "string") };
  }
  return { read };
})();

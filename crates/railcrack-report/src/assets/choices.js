// Switches for the curves of all charts and the rows of tables.
"use strict";

(() => {
  const { DASHES, bringOut, button, charts, element, inParts, legend, pageData, plain } = railcrack;
  const place = element("choices");
  /** @type {ChoiceGroup[]} */
  const groups = pageData("choices-data");
  /** Places of the values that are on, by group; a group without values is always shown. */
  const on = groups.map(({ values }) =>
    values.length ? new Set(values.flatMap((value, i) => (value.shown ? [i] : []))) : null,
  );

  function show() {
    for (const chart of charts.values()) chart.choose(on);
    const rows = /** @type {NodeListOf<HTMLElement>} */ (document.querySelectorAll("tr[data-choices]"));
    for (const row of rows) {
      const values = row.dataset.choices ? row.dataset.choices.split(",") : [];
      row.hidden = !values.every((value, group) => on[group]?.has(+value) ?? true);
    }
  }

  for (const [g, group] of groups.entries()) {
    if (!group.values.length) continue;
    /** @param {number[]} values */
    const turnOn = (values) => {
      on[g] = new Set(values);
      show();
    };
    const set = document.createElement("fieldset");
    const name = document.createElement("legend");
    inParts(name, plain(group.name));
    set.append(name);
    const boxes = group.values.map((value) => {
      const label = document.createElement("label");
      const box = document.createElement("input");
      box.type = "checkbox";
      box.checked = value.shown;
      box.addEventListener("change", () => turnOn(checked()));
      const colour = value.colour ? `var(--${value.colour})` : "var(--quiet)";
      const dashes = value.look && DASHES[value.look];
      const mark =
        value.colour || value.look ? legend([{ name: "", colour, dashes }]).querySelector("svg") : null;
      label.append(box, mark ?? "", plain(value.name));
      set.append(label);
      return box;
    });
    const checked = () => boxes.flatMap((box, i) => (box.checked ? [i] : []));
    if (group.values.length > 2) {
      const all = button("all", () => {
        // A second click goes back to the first value alone.
        const every = boxes.every((box) => box.checked);
        for (const [i, box] of boxes.entries()) box.checked = !every || i === 0;
        turnOn(checked());
      });
      set.append(all);
    }
    place.append(set);
  }

  for (const row of /** @type {NodeListOf<HTMLElement>} */ (document.querySelectorAll("tr[data-name]"))) {
    row.addEventListener("pointerenter", () => bringOut(row.dataset.name));
    row.addEventListener("pointerleave", () => bringOut());
  }
  place.hidden = !groups.some((group) => group.values.length);
  show();
})();

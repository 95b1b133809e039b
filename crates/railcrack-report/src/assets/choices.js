// Switches for the curves of all charts and the rows of tables.
"use strict";

(() => {
  const { bringOut, charts, every, inParts, isChosen, legend, plain } = railcrack;
  const place = railcrack.element("choices");
  /** @type {ChoiceGroup[]} */
  const groups = railcrack.pageData("choices-data");
  /** Places of the values that are on, by group; a group without values is always shown. */
  const on = groups.map(({ values }) =>
    values.length ? new Set(values.flatMap((value, i) => (value.shown ? [i] : []))) : null,
  );

  function show() {
    for (const chart of charts.values()) chart.choose(on);
    for (const row of every("tr[data-choices]")) row.hidden = !isChosen(row.dataset.choices, on);
  }

  for (const [g, group] of groups.entries()) {
    if (!group.values.length) continue;
    const set = document.createElement("fieldset");
    set.append(inParts(document.createElement("legend"), plain(group.name)));
    const boxes = group.values.map(({ name, shown, colour, dashes }) => {
      const label = document.createElement("label");
      const box = Object.assign(document.createElement("input"), { type: "checkbox", checked: shown });
      box.addEventListener("change", turnOn);
      const entry = { name: "", colour: `var(--${colour ?? "quiet"})`, dashes: dashes ?? "" };
      const hasMark = colour !== null || dashes !== null;
      label.append(box, (hasMark && legend([entry]).querySelector("svg")) || "", plain(name));
      set.append(label);
      return box;
    });
    function turnOn() {
      on[g] = new Set(boxes.flatMap((box, i) => (box.checked ? [i] : [])));
      show();
    }
    place.append(set);
  }

  for (const row of every("tr[data-name]")) {
    row.addEventListener("pointerenter", () => bringOut(row.dataset.name));
    row.addEventListener("pointerleave", () => bringOut());
  }
  place.hidden = !groups.some((group) => group.values.length);
  show();
})();

// Switches for the curves of all charts and the rows of tables.
"use strict";

(() => {
  const { charts, legend, plain, inParts, bringOut, DASHES } = railcrack;
  const place = document.getElementById("choices");
  const groups = JSON.parse(document.getElementById("choices-data").textContent);
  // A group without values is always shown.
  const on = groups.map((group) => (group.values.length ? new Set(group.values.flatMap((value, i) => (value.shown ? [i] : []))) : null));

  function show() {
    for (const chart of charts.values()) chart.choose(on);
    for (const row of document.querySelectorAll("tr[data-choices]"))
      row.hidden = row.dataset.choices !== "" && !row.dataset.choices.split(",").every((value, group) => on[group]?.has(+value) ?? true);
  }

  groups.forEach((group, place_of_group) => {
    if (!group.values.length) return;
    const set = document.createElement("fieldset");
    const name = document.createElement("legend");
    inParts(name, plain(group.name));
    set.append(name);
    const boxes = group.values.map((value, i) => {
      const label = document.createElement("label");
      const box = document.createElement("input");
      box.type = "checkbox";
      box.checked = value.shown;
      box.addEventListener("change", () => {
        if (box.checked) on[place_of_group].add(i);
        else on[place_of_group].delete(i);
        show();
      });
      const mark = value.colour || value.look
        ? legend([{ name: "", colour: value.colour ? `var(--${value.colour})` : "var(--quiet)", dashes: DASHES[value.look] }]).querySelector("svg")
        : "";
      label.append(box, mark, plain(value.name));
      set.append(label);
      return box;
    });
    if (group.values.length > 2) {
      const all = document.createElement("button");
      all.type = "button";
      all.textContent = "all";
      all.addEventListener("click", () => {
        // Once more: back to the first.
        const every = boxes.every((box) => box.checked);
        boxes.forEach((box, i) => { box.checked = !every || i === 0; });
        on[place_of_group] = new Set(boxes.flatMap((box, i) => (box.checked ? [i] : [])));
        show();
      });
      set.append(all);
    }
    place.append(set);
  });

  for (const row of document.querySelectorAll("tr[data-name]")) {
    row.addEventListener("pointerenter", () => bringOut(row.dataset.name));
    row.addEventListener("pointerleave", () => bringOut());
  }
  place.hidden = !groups.some((group) => group.values.length);
  show();
})();

// The book as a site: search, theme, contents on a phone. No network: the index is a file of the site.
"use strict";

(() => {
  const root = document.documentElement;
  /** @param {(store: Storage) => string | null | void} action */
  const memory = (action) => {
    try {
      return action(localStorage);
    } catch {
      return null;
    }
  };

  // ---- Theme ------------------------------------------------------------------------------------

  const themes = ["auto", "light", "dark"];
  const change = document.getElementById("theme");
  let theme = memory((store) => store.getItem("railcrack-theme")) ?? "auto";
  const show = () => {
    if (theme === "auto") delete root.dataset.theme;
    else root.dataset.theme = theme;
    change.textContent = `Theme: ${theme === "auto" ? "system" : theme}`;
  };
  change.addEventListener("click", () => {
    theme = themes[(themes.indexOf(theme) + 1) % themes.length];
    memory((store) => store.setItem("railcrack-theme", theme));
    show();
  });
  show();

  // The contents are open where there is a column for them.
  const contents = document.querySelector("details.contents");
  if (contents && matchMedia("(min-width: 60rem)").matches) contents.open = true;

  // ---- Search -----------------------------------------------------------------------------------

  const field = document.getElementById("search");
  const list = document.getElementById("found");
  const base = document.body.dataset.base;
  /** Sections of the book: page, anchor, heading, page title, text. */
  let index = null;

  /** The index is a script, since a page from a file may not read other files. */
  const load = () =>
    (index ??= new Promise((done, fail) => {
      const script = document.createElement("script");
      script.src = `${base}search-index.js`;
      script.onload = () =>
        done(window.railcrackIndex.map((entry) => ({ ...entry, low: `${entry.title} ${entry.heading} ${entry.text}`.toLowerCase() })));
      script.onerror = () => fail(new Error("no index"));
      document.head.append(script);
    }));

  /** How well a section answers: all words must be there; headings count most. */
  function score(entry, words) {
    const heading = `${entry.title} ${entry.heading}`.toLowerCase();
    let total = 0;
    for (const word of words) {
      const count = entry.low.split(word).length - 1;
      if (!count) return 0;
      total += Math.min(count, 6) + (heading.includes(word) ? 12 : 0);
    }
    return total / Math.log(200 + entry.text.length);
  }

  /** The surroundings of the first word found. */
  function extract({ text }, words) {
    const at = Math.max(0, Math.min(...words.map((word) => text.toLowerCase().indexOf(word)).filter((i) => i >= 0), text.length) - 60);
    return text.slice(at, at + 180);
  }

  function marked(text, words) {
    const part = document.createDocumentFragment();
    const pattern = new RegExp(`(${words.map((word) => word.replace(/[.*+?^${}()|[\]\\]/g, "\\$&")).join("|")})`, "gi");
    for (const [i, piece] of text.split(pattern).entries()) {
      if (i % 2 === 0) part.append(piece);
      else part.append(Object.assign(document.createElement("mark"), { textContent: piece }));
    }
    return part;
  }

  async function search() {
    const words = field.value.toLowerCase().split(/\s+/).filter((word) => word.length > 1);
    if (!words.length) {
      list.hidden = true;
      return;
    }
    const entries = await load();
    const best = entries
      .map((entry) => ({ entry, points: score(entry, words) }))
      .filter(({ points }) => points > 0)
      .sort((a, b) => b.points - a.points)
      .slice(0, 12);
    list.replaceChildren(
      ...best.map(({ entry }) => {
        const item = document.createElement("li");
        const link = Object.assign(document.createElement("a"), { href: `${base}${entry.page}${entry.anchor ? `#${entry.anchor}` : ""}` });
        link.append(marked(entry.heading === entry.title ? entry.title : `${entry.title}: ${entry.heading}`, words));
        const small = document.createElement("small");
        small.append(marked(extract(entry, words), words));
        item.append(link, small);
        return item;
      }),
    );
    if (!best.length) list.append(Object.assign(document.createElement("li"), { textContent: "Nothing found." }));
    list.hidden = false;
  }

  field.addEventListener("input", search);
  addEventListener("keydown", (event) => {
    if (event.key === "/" && !/^(INPUT|TEXTAREA|SELECT)$/.test(document.activeElement?.tagName ?? "")) {
      event.preventDefault();
      field.focus();
    } else if (event.key === "Escape") list.hidden = true;
  });
  document.addEventListener("click", (event) => {
    if (!event.target.closest(".top")) list.hidden = true;
  });
})();

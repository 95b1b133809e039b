// Follows the results: asks how far they are, and loads the page again when they have changed.
"use strict";

(() => {
  const stamp = document.currentScript?.dataset.stamp;
  const KEPT = `railcrack-view ${location.pathname}`;

  /** Sliders, menus and the filter: they stay as the reader has set them. */
  const settings = () => {
    const all = document.querySelectorAll("input[type=range], select, #study-filter");
    return /** @type {(HTMLInputElement | HTMLSelectElement)[]} */ ([...all]).filter((input) => input.id);
  };
  /** Parts that fold: they stay open or closed. */
  const folding = () => [...document.querySelectorAll("details")];

  const bar = document.createElement("p");
  bar.id = "live";
  bar.className = "screen";
  bar.setAttribute("role", "status");
  const words = document.createElement("span");
  const pause = Object.assign(document.createElement("button"), { type: "button", textContent: "Pause" });
  let paused = false;
  pause.addEventListener("click", () => {
    paused = !paused;
    pause.textContent = paused ? "Follow" : "Pause";
  });
  bar.append(words, " ", pause);
  document.querySelector("h1")?.after(bar);

  /** What the reader has set: a slider at its end stays at the end, wherever that is by then. */
  function keep() {
    const values = settings().map((input) => {
      const isAtEnd = input instanceof HTMLInputElement && input.max !== "0" && input.value === input.max;
      return { id: input.id, value: input.value, isAtEnd };
    });
    const open = folding().map((part) => part.open);
    sessionStorage.setItem(KEPT, JSON.stringify({ scroll: scrollY, values, open }));
  }

  async function restore() {
    const text = sessionStorage.getItem(KEPT);
    if (!text) return;
    sessionStorage.removeItem(KEPT);
    const { scroll, values, open } = JSON.parse(text);
    for (const [i, part] of folding().entries()) part.open = open[i] ?? false;
    // The sliders have their ends when the explorer is there.
    /** @param {string} id */
    const isReady = (id) => {
      const part = document.getElementById(id);
      return !part || part.dataset.ready === "true";
    };
    for (let i = 0; i < 100 && !["explorer", "study-table"].every(isReady); i++)
      await new Promise((done) => setTimeout(done, 50));
    const now = new Map(settings().map((input) => [input.id, input]));
    for (const { id, value, isAtEnd } of values) {
      const input = now.get(id);
      const wanted = isAtEnd && input instanceof HTMLInputElement ? input.max : value;
      if (!input || input.value === wanted) continue;
      input.value = wanted;
      input.dispatchEvent(new Event("input", { bubbles: true }));
      input.dispatchEvent(new Event("change", { bubbles: true }));
    }
    scrollTo(0, scroll);
  }

  /** Whether the reader is at something that a new page would take away. */
  const isBusy = () =>
    paused ||
    document.querySelector(":active") ||
    getSelection()?.toString() ||
    document.getElementById("play")?.textContent === "Stop" ||
    document.activeElement?.matches("input[type=search]");

  async function look() {
    let next = 1000;
    try {
      const state = await (await fetch("state", { cache: "no-store" })).json();
      words.textContent = `Live: ${state.progress}.`;
      bar.dataset.over = state.over;
      if (state.stamp !== stamp && !isBusy()) {
        keep();
        location.reload();
        return;
      }
      if (state.over && state.stamp === stamp) {
        pause.hidden = true;
        next = 5000;
      }
    } catch {
      words.textContent = "railcrack view has ended; this page is no longer updated.";
      pause.hidden = true;
      next = 5000;
    }
    setTimeout(look, next);
  }

  restore().finally(look);
})();

// Follows the results: asks how far they are, and loads the page again when they have changed.
"use strict";

(() => {
  const stamp = document.currentScript.dataset.stamp;
  const KEPT = `railcrack-view ${location.pathname}`;
  // Sliders, menus and folded parts stay as the reader has set them.
  const settings = () => [...document.querySelectorAll("input[type=range], select, #study-filter")].filter((input) => input.id);
  const folded = () => [...document.querySelectorAll("details")];

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
  document.querySelector("h1").after(bar);

  function keep() {
    sessionStorage.setItem(KEPT, JSON.stringify({
      scroll: scrollY,
      // A slider at its end stays at the end, wherever that is by then.
      values: settings().map((input) => [input.id, input.value, input.type === "range" && input.value === input.max && input.max !== "0"]),
      open: folded().map((part) => part.open),
    }));
  }

  async function restore() {
    const text = sessionStorage.getItem(KEPT);
    if (!text) return;
    sessionStorage.removeItem(KEPT);
    const { scroll, values, open } = JSON.parse(text);
    folded().forEach((part, i) => { part.open = open[i] ?? false; });
    // The sliders have their ends when the explorer is there.
    const isReady = (id) => !document.getElementById(id) || document.getElementById(id).dataset.ready === "true";
    for (let i = 0; i < 100 && !(isReady("explorer") && isReady("study-table")); i++) await new Promise((done) => setTimeout(done, 50));
    for (const [id, value, atEnd] of values) {
      const input = document.getElementById(id);
      const wanted = atEnd ? input?.max : value;
      if (!input || input.value === wanted) continue;
      input.value = wanted;
      input.dispatchEvent(new Event("input", { bubbles: true }));
      input.dispatchEvent(new Event("change", { bubbles: true }));
    }
    scrollTo(0, scroll);
  }

  /** Whether the reader is at something that a new page would take away. */
  const isBusy = () => paused || document.querySelector(":active") || getSelection().toString()
    || document.getElementById("play")?.textContent === "Stop" || document.activeElement?.matches("input[type=search]");

  async function look() {
    let next = 1000;
    try {
      const state = await (await fetch("state", { cache: "no-store" })).json();
      words.textContent = `Live: ${state.progress}.`;
      bar.dataset.over = state.over;
      if (state.stamp !== stamp && !isBusy()) {
        keep();
        return location.reload();
      }
      if (state.over && state.stamp === stamp) {
        pause.hidden = true;
        next = 5000;
      }
    } catch {
      words.textContent = "railcrack view has ended; the page stays as it is.";
      pause.hidden = true;
      next = 5000;
    }
    setTimeout(look, next);
  }

  restore().finally(look);
})();

"""Reports in a real browser.

    report_browser_test.py BROWSER PICTURES FOLDER...

Opens `report.html` of each folder in the headless Chromium BROWSER, checks it against the tables in the folder, and leaves
pictures of every section (light, dark, printed) in PICTURES. Ends with 1 where a check fails.
"""

import base64
import csv
import json
import math
import re
import struct
import sys
import time
from pathlib import Path

from browser import Browser

# Text over text: within the drawing of a figure, and of a drawing over the words beside it.
OVERLAPS = """
(() => {
  const bad = [];
  const meet = (a, b) => Math.min(a.right, b.right) - Math.max(a.left, b.left) > 1 && Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top) > 3;
  for (const figure of document.querySelectorAll('figure')) {
    const seen = (e) => e.textContent.trim() && e.getBoundingClientRect().width > 0;
    const drawn = [...figure.querySelectorAll('svg text')].filter((t) => seen(t) && !t.closest('[aria-label="tip"]'));
    const written = [...figure.querySelectorAll('h3, figcaption, .legend li, .tools button')].filter(seen);
    const all = [...drawn, ...written].map((e) => {
      if (!e.matches('h3, figcaption')) return [e, e.getBoundingClientRect()];
      // As wide as its words, not as its place.
      const range = document.createRange();
      range.selectNodeContents(e);
      return [e, range.getBoundingClientRect()];
    });
    for (let i = 0; i < all.length; i++)
      for (let j = 0; j < i; j++)
        if (meet(all[i][1], all[j][1])) bad.push(`${figure.id}: "${all[i][0].textContent.slice(0, 30)}" and "${all[j][0].textContent.slice(0, 30)}"`);
  }
  return bad;
})()
"""
# Elements that end beyond the page, those apart that scroll within it.
BEYOND = """
[...document.body.querySelectorAll('*')].filter((e) => {
  const box = e.getBoundingClientRect();
  const scrolled = e.parentElement?.closest('.wide, .long .drawing, pre, select');
  return box.width > 0 && !scrolled && (box.right > innerWidth + 1 || box.left < -1) && !e.closest('[aria-label="tip"], [clip-path]');
}).map((e) => `${e.tagName} ${e.id || e.className.baseVal || e.className || ''} "${e.textContent.trim().slice(0, 30)}"`)
"""
# Tables and pictures that must be scrolled sideways.
SCROLLED = "[...document.querySelectorAll('.wide')].filter((e) => e.clientWidth > 0 && !e.closest('details:not([open])') && e.scrollWidth > e.clientWidth + 1).map((e) => e.textContent.trim().slice(0, 40))"
# Words that are broken into two lines between their letters: words end at spaces, hyphens and where the page allows a break.
BROKEN = """
(() => {
  const bad = [];
  for (const cell of document.querySelectorAll('th, td, .facts dt, .facts dd, .legend li, h2, h3, figcaption')) {
    if (!cell.getBoundingClientRect().width) continue;
    const walker = document.createTreeWalker(cell, NodeFilter.SHOW_TEXT);
    while (walker.nextNode()) {
      const text = walker.currentNode;
      for (const word of text.textContent.matchAll(/[^\\s\u2013/-]+/g)) {
        const range = document.createRange();
        range.setStart(text, word.index);
        range.setEnd(text, word.index + word[0].length);
        const lines = new Set([...range.getClientRects()].map((box) => Math.round(box.top / 4)));
        if (lines.size > 1) bad.push(word[0]);
      }
    }
  }
  return bad;
})()
"""
# The smallest distance (Oklab, Ottosson 2020) between two of the nine colours of things without order, and which two.
NEAREST_COLOURS = """
(() => {
  const linear = (c) => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4);
  const lab = (colour) => {
    const [R, G, B] = [1, 3, 5].map((at) => linear(parseInt(colour.slice(at, at + 2), 16) / 255));
    const l = Math.cbrt(0.4122214708 * R + 0.5363325363 * G + 0.0514459929 * B);
    const m = Math.cbrt(0.2119034982 * R + 0.6806995451 * G + 0.1073969566 * B);
    const s = Math.cbrt(0.0883024619 * R + 0.2817188376 * G + 0.6299787005 * B);
    return [0.2104542553 * l + 0.793617785 * m - 0.0040720468 * s, 1.9779984951 * l - 2.428592205 * m + 0.4505937099 * s,
      0.0259040371 * l + 0.7827717662 * m - 0.808675766 * s];
  };
  const style = getComputedStyle(document.documentElement);
  const names = [0, 1, 2, 3, 4, 5, 6, 7, 8].map((i) => style.getPropertyValue(`--c${i}`).trim());
  const pairs = names.flatMap((_, i) => names.slice(0, i).map((_, j) => [i, j]));
  const apart = ([i, j]) => Math.hypot(...lab(names[i]).map((c, k) => c - lab(names[j])[k]));
  const nearest = pairs.sort((one, other) => apart(one) - apart(other))[0];
  return [apart(nearest), names[nearest[0]], names[nearest[1]]];
})()
"""
# Curves of one chart that look alike: of the same colour, dashes and width under different names; quantiles have an order.
ALIKE = """
[...railcrack.charts].flatMap(([id, chart]) => {
  const looks = new Map();
  for (const { name, note, look } of chart.curves().filter((curve) => curve.name && !/( %( of the runs)?|of the samples are (less deep|deeper))$/.test(curve.name))) {
    if (!looks.has(look)) looks.set(look, new Set());
    looks.get(look).add(`${name} ${note}`);
  }
  const names = new Set(chart.curves().map((curve) => `${curve.name} ${curve.note}`));
  return names.size > 9 ? [] : [...looks.values()].filter((names) => names.size > 1).map((names) => `${id}: ${[...names].join(' and ')}`);
})
"""
OUTSIDE = """
[...document.querySelectorAll('figure .drawing svg')].filter((svg) => {
  const inside = svg.closest('figure').getBoundingClientRect(), box = svg.getBoundingClientRect();
  return box.width > 0 && (box.right > inside.right + 2 || box.left < inside.left - 2);
}).map((svg) => svg.closest('figure').id)
"""


# A phone, a tablet, a desk; and A4 within its margins.
WIDTHS = [390, 800, 1400]
PAPER = 688
# Height of A4 within its margins, and by how much more paper a page may take than its contents are high: figures and tables are not torn.
PAPER_HEIGHT = 1005
EMPTY = 1.4


class Checks:
    def __init__(self):
        self.passed, self.failed = 0, 0

    def that(self, holds, what, *about):
        if holds:
            self.passed += 1
        else:
            self.failed += 1
            print("FAILED:", what, *about, flush=True)

    def near(self, value, want, what, relative=2e-5, absolute=1e-6):
        """Numbers in the page have six digits."""
        close = value is not None and abs(float(value) - want) <= relative * abs(want) + absolute
        self.that(close, what, f"is {value}, the table has {want}")


def table(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def stabilised(rows, wheel=1):
    """Rows of the last passage of each step, in a mix under one wheel."""
    rows = [row for row in rows if row.get("wheel", str(wheel)) == str(wheel)]
    last = {}
    for row in rows:
        last[row["step"]] = row["passage"]
    return [row for row in rows if row["passage"] == last[row["step"]]]


def check_page(browser, checks, name, path):
    """What every page must hold."""
    checks.that(path.stat().st_size < 5_000_000, f"{name}: at most 5 MB", path.stat().st_size)
    for theme in ["light", "dark"]:
        for width in WIDTHS:
            browser.open(path, width=width, theme=theme)
            what = f"{name}, {theme}, {width} px"
            checks.that(not browser.complaints, f"{what}: no complaints of the browser", browser.complaints)
            outside = [url for url in browser.requests if not url.startswith(("file:", "data:", "blob:"))]
            checks.that(not outside, f"{what}: no network", outside)
            overlaps = browser.run(OVERLAPS)
            checks.that(not overlaps, f"{what}: no text overlaps another", overlaps[:3])
            wide = browser.run("document.scrollingElement.scrollWidth - innerWidth")
            checks.that(wide <= 0, f"{what}: nothing sticks out sideways", wide)
            beyond = browser.run(BEYOND)
            checks.that(not beyond, f"{what}: no element is wider than the page", beyond[:5])
            if width == max(WIDTHS):
                scrolled = browser.run(SCROLLED)
                checks.that(not scrolled, f"{what}: nothing has to be scrolled sideways", scrolled)
            broken = browser.run(BROKEN)
            checks.that(not broken, f"{what}: no word is broken", broken[:8])
            undrawn = browser.run(
                "[...document.querySelectorAll('figure.chart')].filter((f) => f.offsetParent && !/^No face data/.test(f.querySelector('figcaption').textContent)"
                " && !f.querySelector('.drawing svg g.curves :is(polyline, circle, image)')).map((f) => f.id)")
            checks.that(not undrawn, f"{what}: every chart is drawn", undrawn)
            twice = browser.run(
                "[...document.querySelectorAll('figure .drawing svg')].filter((s) => ['x', 'y'].some((axis) => {"
                " const labels = [...s.querySelectorAll(`[aria-label='${axis}-axis tick label'] text`)].map((t) => t.textContent).filter(Boolean);"
                " return new Set(labels).size < labels.length; })).map((s) => s.closest('figure').id)")
            checks.that(not twice, f"{what}: no two ticks of an axis have the same label", twice)
            bare = browser.run(
                "[...document.querySelectorAll('figure .drawing svg')].filter((s) => ['x', 'y'].some((axis) => {"
                " const ticks = s.querySelectorAll(`[aria-label='${axis}-axis tick label'] text`); return ticks.length &&"
                " [...ticks].filter((t) => t.textContent).length < 2; })).map((s) => s.closest('figure').id)")
            checks.that(not bare, f"{what}: every axis has two labels", bare)
            untitled = browser.run(
                "[...document.querySelectorAll('figure .drawing svg')].filter((s) => !s.querySelector('[aria-label*=\"axis label\"]'))"
                ".map((s) => s.closest('figure').id)")
            checks.that(not untitled, f"{what}: every chart has titles at its axes", untitled)
        apart, *which = browser.run(NEAREST_COLOURS)
        checks.that(apart > 0.09, f"{name}, {theme}: nine colours are told apart", apart, which)
        alike = browser.run(ALIKE)
        checks.that(not alike, f"{name}: no two curves of up to nine look alike", alike[:3])
        ground = browser.run("getComputedStyle(document.body).backgroundColor")
        light = sum(int(part) for part in ground.strip("rgb()").split(",")[:3]) > 382
        checks.that(light == (theme == "light"), f"{name}: {theme} follows the system", ground)
    browser.open(path)
    bottom = browser.run("document.querySelector('.facts').getBoundingClientRect().bottom")
    checks.that(bottom < 700, f"{name}: verdict and facts are on the first screen", bottom)
    figures = browser.run("[...document.querySelectorAll('figure')].filter((f) => f.querySelector('.drawing svg') && f.querySelector('.tools')).map((f) => f.id)")
    for figure in figures:
        kept = browser.run(f"railcrack.file(document.getElementById({json.dumps(figure)}))")
        checks.that(kept.startswith("<svg") and "var(--" not in kept and 'width="' in kept, f"{name}: {figure} can be kept as a file", kept[:200])
    browser.media(medium="print")
    browser.settle()
    outside = browser.run(OUTSIDE)
    checks.that(not outside, f"{name}: on paper, charts stay in their columns", outside)
    # What is wider than its place could be scrolled to on a screen.
    cut = browser.run(
        "(() => { dispatchEvent(new Event('beforeprint')); const wide = [...document.querySelectorAll('.beside .wide')]"
        ".filter((e) => e.firstElementChild.getBoundingClientRect().right > e.closest('.beside').getBoundingClientRect().left"
        " + 0.5 * e.closest('.beside').clientWidth + 10).map((e) => e.textContent.slice(0, 40));"
        " dispatchEvent(new Event('afterprint')); return wide; })()")
    checks.that(not cut, f"{name}: on paper, tables end before what stands beside them", cut)
    cut = browser.run(
        "(() => { dispatchEvent(new Event('beforeprint')); const edge = document.body.getBoundingClientRect().right;"
        " const wide = [...document.querySelectorAll('section > .table table')].filter((t) => t.getBoundingClientRect().right > edge + 8)"
        ".map((t) => t.textContent.slice(0, 40)); dispatchEvent(new Event('afterprint')); return wide; })()")
    checks.that(not cut, f"{name}: on paper, tables end within the page", cut)
    browser.size(PAPER, 1000)
    browser.run("dispatchEvent(new Event('beforeprint'))")
    browser.settle()
    for what, expression in [("no word is broken", BROKEN), ("no text overlaps another", OVERLAPS), ("nothing is wider than the paper", BEYOND)]:
        found = browser.run(expression)
        checks.that(not found, f"{name}: on paper, {what}", found[:8])
    text = browser.run("document.body.innerText")
    for screen in ["Point at a map", "Keys on", "Click a heading"]:
        checks.that(screen not in text, f"{name}: on paper there is no {screen!r}")
    menus = browser.run("[...document.querySelectorAll('select')].filter((s) => getComputedStyle(s).appearance !== 'none').map((s) => s.id)")
    checks.that(not menus, f"{name}: on paper, menus are words", menus)
    foot = browser.run("[...document.querySelectorAll('style')].map((s) => s.textContent).find((text) => text.includes('@bottom-left')) ?? ''")
    checks.that("report of" in foot and "printed" in foot, f"{name}: the foot of printed pages has the dates", foot)
    height = browser.run("document.body.scrollHeight")
    browser.run("dispatchEvent(new Event('afterprint'))")
    browser.media()
    pages, most = pdf_pages(browser.pdf_bytes()), math.ceil(EMPTY * height / PAPER_HEIGHT) + 1
    checks.that(0 < pages <= most, f"{name}: printed pages are full", pages, f"of at most {most}, for {height} px")
    check_without_scripts(browser, checks, name, path)


def pdf_pages(data):
    """Number of the pages of a PDF file."""
    return len(re.findall(rb"/Type\s*/Page(?![a-zA-Z])", data))


def check_without_scripts(browser, checks, name, path):
    browser.send("Emulation.setScriptExecutionDisabled", value=True)
    browser.open_plain(path)
    document = browser.send("DOM.getDocument", depth=0)["root"]["nodeId"]
    count = lambda selector: len(browser.send("DOM.querySelectorAll", nodeId=document, selector=selector)["nodeIds"])
    checks.that(count(".verdict") == 1 and count(".facts div") > 2, f"{name}: without scripts the result is there")
    checks.that(count(".drawing g.curve polyline, .picture svg") > 0 or count("#explorer, #choices") == 0, f"{name}: without scripts there are pictures")
    browser.send("Emulation.setScriptExecutionDisabled", value=False)


def marks(browser, figure):
    return browser.run(
        f"[...document.querySelectorAll('#{figure} g.marks circle')].map((c) => [c.dataset.x, c.dataset.y])")


def check_explorer(browser, checks, name, folder):
    """The sliders move what they should, to what the tables say."""
    browser.open(folder / "report.html")
    sif = stabilised(table(folder / "sif.csv"))
    growth = table(folder / "growth.csv")
    steps = sorted({int(row["step"]) for row in growth})
    position = 1
    # Of many cracks the page has each while the wheel is near, and begins with one that has a name.
    windows, named = browser.run("(({ wheels, named }) => [wheels[0].windows, named])(JSON.parse(document.getElementById('run-data').textContent))")
    crack = named[0] if windows else 1

    def check_k(step):
        here = [row for row in sif if int(row["step"]) == step and int(row["position"]) == position]
        many = windows is not None or len(here) > 9
        here = [row for row in here if not many or row["crack"] == str(crack)]
        if windows and not windows[crack - 1][0] <= position - 1 <= windows[crack - 1][1]:
            checks.that(not marks(browser, "kii"), f"{name}: no K of crack {crack} with the wheel far away, position {position}")
            return
        for figure, column in [("ki", "ki_mpa_sqrt_m"), ("kii", "kii_mpa_sqrt_m")]:
            # Half a level between the extremes of a history, of which there are 65536.
            span = max(abs(float(row[column])) for row in sif if not windows or row["crack"] == str(crack))
            there = marks(browser, figure)
            what = f"{name}: {figure}, step {step}, position {position}"
            checks.that(len(there) == len(here), f"{what}: a mark for each tip", there)
            for (x, k), row in zip(there, here):
                checks.near(x, float(row["xc_over_a"]), f"{what}, wheel")
                checks.near(k, float(row[column]), what, absolute=max(1e-6, 2e-5 * span))
        checks.near(browser.run("document.querySelector('#scene .drawing svg').dataset.centre"), float(here[0]["xc_mm"]), f"{name}: the wheel over the cracks")
        if here[0].get("fluid_mpa") and not many:
            check_fluid(browser, checks, f"{name}: fluid, step {step}, position {position}", here)
        for figure in ["face-status", "face-pressure"] if not windows or step in (steps[0], steps[-1]) else []:
            line = browser.run(f"document.querySelector('#{figure} line.here')?.dataset.x")
            checks.near(line, float(here[0]["xc_over_a"]), f"{name}: the line on {figure}")

    positions = max(int(row["position"]) for row in sif)
    browser.run("document.getElementById('wheel').focus()")
    browser.key("Home")
    check_k(steps[0])
    before = browser.run("document.querySelector('#scene .drawing svg').innerHTML")
    browser.key("ArrowRight", 5)
    position = 6
    check_k(steps[0])
    browser.key("End")
    position = positions
    check_k(steps[0])
    for _ in range(positions // 2):
        browser.send("Input.dispatchKeyEvent", type="rawKeyDown", key="ArrowLeft", code="ArrowLeft", windowsVirtualKeyCode=37)
    browser.settle()
    position = positions - positions // 2
    check_k(steps[0])
    checks.that(browser.run("document.querySelector('#scene .drawing svg').innerHTML") != before, f"{name}: the picture of the load follows")
    if windows:
        position = 1 + sum(windows[crack - 1]) // 2
        browser.run(f"(() => {{ const e = document.getElementById('wheel'); e.value = {position - 1}; e.dispatchEvent(new Event('input')); }})()")
        browser.settle()
        check_k(steps[0])
    check_faces(browser, checks, name, folder, 0, position, crack)
    if len(steps) > 1:
        shown = browser.run("JSON.parse(document.getElementById('run-data').textContent).steps.map((s) => s.step)")
        browser.run("document.getElementById('step').focus()")
        browser.key("ArrowRight")
        browser.until(f"document.getElementById('step-value').textContent.startsWith('{shown[1]} of')")
        browser.settle()
        check_k(shown[1])
        browser.key("End")
        browser.until(f"document.getElementById('step-value').textContent.startsWith('{shown[-1]} of')")
        browser.settle()
        check_k(shown[-1])
        rows = [row for row in growth if int(row["step"]) == shown[-1] and (not windows or row["crack"] == str(crack))]
        for figure, columns in [("length-cycles", ("load_cycles", "length_mm")), ("rate-length", ("length_mm", "rate_mm_per_cycle"))]:
            rows_shown = rows if figure == "length-cycles" else [row for row in rows if float(row["rate_mm_per_cycle"]) > 0]
            there = marks(browser, figure)
            checks.that(len(there) == len(rows_shown), f"{name}: {figure} marks the step", there)
            for (x, y), row in zip(there, rows_shown):
                checks.near(x, float(row[columns[0]]), f"{name}: {figure}, {columns[0]}")
                checks.near(y, float(row[columns[1]]), f"{name}: {figure}, {columns[1]}")
        check_faces(browser, checks, name, folder, shown[-1], position, crack)
    hover(browser, checks, name)
    checks.that(not browser.complaints, f"{name}: no complaints after all this", browser.complaints)


def check_wheels(browser, checks, name, folder):
    """The menu of a mix selects the wheel whose passage is shown: K, the wheel over the cracks and the faces are those of the tables."""
    browser.open(folder / "report.html")
    count = browser.run("document.getElementById('of-mix')?.options.length ?? 1")
    checks.that(count == 1 or not browser.run("document.getElementById('which-wheel').hidden"), f"{name}: the menu of wheels is there")
    if count == 1:
        return
    sif = table(folder / "sif.csv")
    windows = browser.run("JSON.parse(document.getElementById('run-data').textContent).wheels.map((wheel) => wheel.windows)")
    crack = int(browser.run("document.getElementById('crack').value"))
    scenes = set()
    for wheel in [*range(2, count + 1), 1]:
        at = float(browser.run("document.querySelector('#scene .drawing svg').dataset.centre"))
        browser.run(f"(() => {{ const e = document.getElementById('of-mix'); e.value = {wheel - 1}; e.dispatchEvent(new Event('change')); }})()")
        browser.settle()
        rows = [row for row in stabilised(sif, wheel) if row["step"] == "0" and (not windows[0] or row["crack"] == str(crack))]
        places = sorted({(abs(float(row["xc_mm"]) - at), int(row["position"])) for row in rows})
        position = 1 + int(browser.run("document.getElementById('wheel').value"))
        nearest = [place for distance, place in places if distance < places[0][0] + 1e-3]
        checks.that(position in nearest, f"{name}: wheel {wheel} stands at its position nearest to the wheel before", position, nearest)
        here = [row for row in rows if int(row["position"]) == position]
        what = f"{name}: wheel {wheel}, position {position}"
        checks.near(browser.run("document.querySelector('#scene .drawing svg').dataset.centre"), float(here[0]["xc_mm"]), f"{what}, over the cracks")
        for figure, column in [("ki", "ki_mpa_sqrt_m"), ("kii", "kii_mpa_sqrt_m")]:
            span = max(abs(float(row[column])) for row in rows)
            there = marks(browser, figure)
            checks.that(len(there) == len(here), f"{what}: {figure} has a mark for each tip", there)
            for (x, k), row in zip(there, here):
                checks.near(x, float(row["xc_over_a"]), f"{what}: {figure}, wheel")
                checks.near(k, float(row[column]), f"{what}: {figure}", absolute=max(1e-6, 2e-5 * span))
        check_faces(browser, checks, name, folder, 0, position, crack, wheel)
        scenes.add(browser.run("document.querySelector('#scene .drawing svg').innerHTML"))
        # Between the first and the last step the other wheels have no faces, and the page says so.
        if browser.run("+document.getElementById('step').max") > 1 and not windows[0]:
            browser.run("(() => { const e = document.getElementById('step'); e.value = 1; e.dispatchEvent(new Event('input')); })()")
            browser.settle()
            text = browser.run("document.getElementById('deformed').textContent")
            checks.that(("No face data for this wheel" in text) == (wheel > 1), f"{what}: what there is of the faces", text)
            browser.run("(() => { const e = document.getElementById('step'); e.value = 0; e.dispatchEvent(new Event('input')); })()")
            browser.settle()
    checks.that(len(scenes) == count, f"{name}: every wheel is another picture", len(scenes))
    last = browser.run("document.getElementById('wheel').max")
    checks.that(int(last) + 1 == max(int(row["position"]) for row in stabilised(sif)), f"{name}: the slider has the positions of the wheel", last)
    checks.that(not browser.complaints, f"{name}: no complaints after all wheels", browser.complaints)


def check_space(browser, checks, name, folder):
    """The sliders of cracks in space move what they should, to what the tables say."""
    browser.open(folder / "report.html")
    rows = table(folder / "sif.csv")
    growth = table(folder / "growth.csv")
    data = browser.run("JSON.parse(document.getElementById('space-data').textContent)")
    wheels, steps, cracks = data["wheels"], [step["step"] for step in data["steps"]], len(data["cracks"])
    of_mix = 0
    # By wheel, those of a step, crack and tip.
    sif = [{} for _ in wheels]
    for number, under in enumerate(sif):
        for row in stabilised(rows, number + 1):
            under.setdefault((int(row["step"]), row["crack"], row["tip"]), []).append(row)
    # As the page writes them: a true minus sign, thousands apart.
    number = lambda text: float(re.match("[-+.e\\d]+", text.replace("\u2212", "-").replace("\u00a0", ""))[0].rstrip("."))
    value = lambda id: int(browser.run(f"document.getElementById('{id}').value"))
    drawing = lambda figure: browser.run(f"document.querySelector('#{figure} .drawing svg').innerHTML")

    def check_values(what):
        step, point, at = steps[value("step")], value("front"), wheels[of_mix]["xc_over_a"][value("wheel")]
        crack = str(value("crack"))
        front = [row for row in growth if int(row["step"]) == step and row["crack"] == crack]
        state = front[point]
        what = f"{name}: {what}, step {step}, crack {crack}, point {point + 1}, x_c/a = {at}"
        row = min(sif[of_mix][step, crack, state["tip"]], key=lambda row: abs(float(row["xc_over_a"]) - at))
        text = browser.run("document.getElementById('readout').textContent")
        for mode, column in [("KI", "ki_mpa_sqrt_m"), ("KII", "kii_mpa_sqrt_m"), ("KIII", "kiii_mpa_sqrt_m")]:
            checks.near(number(text.split(f"{mode} = ")[1]), float(row[column]), f"{what}, {mode}", absolute=0.0051)
        checks.near(number(text.split("\u0394Keq = ")[1]), float(state["delta_keq_mpa_sqrt_m"]), f"{what}, range", relative=1e-3)
        checks.near(number(text.split("alf axes ")[1]), float(state["length_mm"]), f"{what}, semi-axis", relative=1e-3)
        checks.near(number(text.split("At \u03c6 = ")[1]), float(state["phi_deg"]), f"{what}, angle", relative=1e-3)
        checks.near(browser.run("document.querySelector('#above .drawing svg').dataset.centre"), float(row["xc_mm"]), f"{what}, the wheel")
        wheel = browser.run("document.getElementById('wheel-value').textContent")
        checks.near(number(wheel.split("xc/a = ")[1]), float(row["xc_over_a"]), f"{what}, the wheel in words", absolute=6e-4)
        checks.that(browser.run("document.getElementById('step-value').textContent") == f"{step} of {data['last_step']}", f"{what}, the step in words")

    check_values("at first")
    before = {figure: drawing(figure) for figure in ["above", "side", "along", "history"]}
    browser.run("document.getElementById('wheel').focus()")
    browser.key("Home")
    check_values("Home")
    browser.key("ArrowRight", 3)
    checks.that(value("wheel") == 3, f"{name}: \u2192 moves the wheel", value("wheel"))
    check_values("\u2192")
    for figure, drawn in before.items():
        checks.that(drawing(figure) != drawn, f"{name}: {figure} follows the wheel")
    before = {figure: drawing(figure) for figure in ["above", "side", "plane", "along", "history"]}
    browser.run("document.getElementById('front').focus()")
    browser.key("Home")
    browser.key("ArrowRight")
    check_values("a point of the front")
    for figure, drawn in before.items():
        checks.that(drawing(figure) != drawn, f"{name}: {figure} follows the point of the front")
    if len(steps) > 1:
        before = drawing("plane")
        browser.run("document.getElementById('step').focus()")
        browser.key("End")
        check_values("the last step")
        checks.that(drawing("plane") != before, f"{name}: the fronts follow the step")
    checks.that(browser.run("document.getElementById('which').hidden") == (cracks == 1), f"{name}: of several cracks one can be chosen")
    if cracks > 1:
        browser.run("(() => { const e = document.getElementById('crack'); e.selectedIndex = e.options.length - 1; e.dispatchEvent(new Event('change')); })()")
        text = browser.run("document.getElementById('readout').textContent")
        checks.that(f"Crack {cracks}:" in text, f"{name}: the last crack is chosen", text)
        check_values("another crack")
    checks.that(browser.run("document.getElementById('which-wheel').hidden") == (len(wheels) == 1), f"{name}: of several wheels one can be chosen")
    for of_mix in range(1, len(wheels)):
        before = {figure: drawing(figure) for figure in ["above", "along", "history"]}
        browser.run(f"(() => {{ const e = document.getElementById('of-mix'); e.value = {of_mix}; e.dispatchEvent(new Event('change')); }})()")
        check_values("another wheel")
        for figure, drawn in before.items():
            checks.that(drawing(figure) != drawn, f"{name}: {figure} follows the choice of the wheel")
    checks.that(not browser.complaints, f"{name}: no complaints after all this", browser.complaints)


def check_contact(browser, checks, name, folder):
    """The pressure over the mouth follows the wheel and the step, as contact.csv and sif.csv have it; beside it that of Hertz."""
    browser.open(folder / "report.html")
    # Of a mix, under the first wheel that feels the cracks.
    data = browser.run("(({ wheels, origin, mouths, steps }) => { const number = wheels.findIndex((wheel) => wheel.is_coupled);"
                       " return { ...wheels[number], number, origin, mouths, crack: +document.getElementById('crack').value, steps: steps.map((s) => s.step) }; })(JSON.parse(document.getElementById('run-data').textContent))")
    a, p0, wheel = data["half_width"], data["peak_pressure"], data["number"] + 1
    if wheel > 1:
        checks.that(browser.run("document.getElementById('contact').hidden"), f"{name}: no contact pressure of a wheel that feels no cracks")
        browser.run(f"(() => {{ const e = document.getElementById('of-mix'); e.value = {wheel - 1}; e.dispatchEvent(new Event('change')); }})()")
        browser.settle()
    nodes = {}
    for row in stabilised(table(folder / "contact.csv"), wheel):
        nodes.setdefault((int(row["step"]), int(row["position"])), []).append((float(row["x_mm"]), float(row["p_mpa"])))
    # What is drawn, in mm and MPa; a clipped line goes on beyond the frame.
    drawn = lambda line: browser.run(
        f"(() => {{ const {{ svg, x, y }} = railcrack.chart('contact');"
        f" return svg.querySelector('polyline.{line}').getAttribute('points').split(' ').map((point) => point.split(',').map(Number))"
        ".map(([px, py]) => [x.value(px), y.value(py)]); })()")
    seen = set()
    for step in [data["steps"][0], data["steps"][-1]]:
        browser.run(f"(() => {{ const e = document.getElementById('step'); e.value = {data['steps'].index(step)}; e.dispatchEvent(new Event('input')); }})()")
        browser.until(f"document.getElementById('step-value').textContent.startsWith('{step} of')")
        browser.settle()
        felt = sorted(position for at, position in nodes if at == step)
        for position in [1, felt[0], felt[len(felt) // 3], felt[len(felt) // 2], felt[-1]]:
            browser.run(f"(() => {{ const e = document.getElementById('wheel'); e.value = {position - 1}; e.dispatchEvent(new Event('input')); }})()")
            browser.settle()
            what = f"{name}: contact pressure, step {step}, position {position}"
            line, dashed = drawn("coupled-wheel"), drawn("hertz")
            xc = data["origin"] + a * data["xc_over_a"][position - 1]
            mouth = data["mouths"][data["crack"] - 1]
            hertz = lambda x: p0 * math.sqrt(max(0.0, 1 - ((x + mouth - xc) / a) ** 2))
            checks.that(max(abs(p - hertz(x)) for x, p in dashed[3:-3]) < 2e-3 * p0, f"{what}: dashed, that of Hertz")
            seen.add(tuple(p for _, p in line))
            count = int(browser.run("document.querySelector('#contact .drawing svg').dataset.nodes"))
            rows = nodes.get((step, position))
            checks.that((rows is not None) == (count > 0), f"{what}: known where the wheel feels the cracks")
            if rows is None:
                continue
            checks.that(len(line) == len(rows), f"{what}: a point for each node", len(line), len(rows))
            apart = max(max(abs(x + mouth - x0) / a, abs(p - p0_) / p0) for (x, p), (x0, p0_) in zip(line, rows))
            # Half a level between zero and the largest pressure of the step, of which there are 65536, and half a hundredth of a pixel.
            checks.that(apart < 1e-4, f"{what}: as in contact.csv", apart)
    # Far away it is that on the uncracked rail, in every step.
    checks.that(len(seen) == 9, f"{name}: the contact pressure follows wheel and step", len(seen))


def check_fluid(browser, checks, what, here):
    """The pressure of the fluid is in the picture of the cracks, drawn and written; `here` are the rows of the tips."""
    pressures = dict((row["crack"], float(row["fluid_mpa"])) for row in here)
    there = browser.run("document.querySelector('#scene .drawing svg').dataset.fluid").split()
    checks.that(len(there) == len(pressures), f"{what}: a pressure for each crack", there)
    for got, want in zip(there, pressures.values()):
        # Half a level between the extremes of a history.
        checks.near(got, want, what, absolute=0.02)
    drawn = browser.run("document.querySelectorAll('#scene g.fluid polyline').length")
    checks.that((drawn > 0) == any(pressure > 0 for pressure in pressures.values()), f"{what}: drawn under pressure only", drawn)
    written = browser.run("document.getElementById('readout').textContent")
    checks.that("fluid p = " in written, f"{what}: the readout has it", written)


def check_fields(browser, checks, name, folder):
    """The neighbourhood: a picture for each field file of its steps, moved by the slider."""
    browser.open(folder / "report.html")
    if not browser.run("Boolean(document.getElementById('field-choice'))"):
        said = browser.run("document.querySelector('#around p')?.textContent ?? ''")
        checks.that("too many cells" in said or not (folder / "fields").exists(), f"{name}: fields are shown, or the page says why not")
        return
    picture = "document.querySelector('#field image').getAttribute('href')"
    seen = set()
    for choice in range(browser.run("document.getElementById('field-choice').options.length")):
        browser.run(f"(() => {{ const e = document.getElementById('field-choice'); e.selectedIndex = {choice}; e.dispatchEvent(new Event('change')); }})()")
        browser.settle()
        label = browser.run(f"document.getElementById('field-choice').options[{choice}].textContent").split(",")[0].replace("step ", "Step ")
        checks.that(browser.run("document.querySelector('#field figcaption').textContent").startswith(label + ","), f"{name}: field {choice} is shown", label)
        seen.add(browser.run(picture))
    checks.that(len(seen) == browser.run("document.getElementById('field-choice').options.length"), f"{name}: every field is another picture", len(seen))
    before = browser.run(picture)
    browser.run("document.getElementById('field-deformed').focus()")
    browser.key(" ")
    checks.that(browser.run(picture) != before, f"{name}: the deformation can be left out")


def hover(browser, checks, name):
    """The pointer on a curve of K_II, where the wheel is, gives its values."""
    browser.box("#kii .drawing svg")
    left, top, width, height = browser.run(
        "(() => { const b = document.querySelector('#kii g.marks circle').getBoundingClientRect(); return [b.left, b.top, b.width, b.height]; })()")
    browser.mouse(left + 0.5 * width, top + 0.5 * height)
    text = browser.run("document.querySelector('#kii [aria-label=tip]')?.textContent ?? ''")
    checks.that("KII" in text and "MPa" in text and "heel position" in text, f"{name}: hover gives values", text)


def check_faces(browser, checks, name, folder, step, position, crack, wheel=1):
    """The map under the pointer, and the deformed crack, against faces.csv."""
    last = {}
    steepest = widest = 0.0
    with open(folder / "faces.csv", newline="") as file:
        for row in csv.DictReader(line for line in file if line.startswith((f"{step},", "step,"))):
            if row["crack"] == str(crack) and int(row["position"]) == position and row.get("wheel", "1") == str(wheel):
                last.setdefault(row["passage"], []).append(row)
            if row["crack"] == str(crack):
                steepest, widest = max(steepest, abs(float(row["s22_mpa"]))), max(widest, abs(float(row["opening_mm"])))
    rows = list(last.values())[-1]
    slack = max(1.0, steepest / 400)
    shown = browser.run(f"(({{ wheels }}) => wheels[{wheel - 1}])(JSON.parse(document.getElementById('run-data').textContent))")
    stride = shown["face_stride"]
    if (position - 1) % stride:
        return
    browser.box("#face-status .drawing svg")
    for row in rows[:: max(1, len(rows) // 4)]:
        at = browser.run(
            "(() => { const { svg, y } = railcrack.chart('face-status'); const box = svg.getBoundingClientRect();"
            " const part = box.width / svg.viewBox.baseVal.width; return [box.left + part * svg.querySelector('line.here').getAttribute('x1'),"
            f" box.top + part * y.at({row['s_mm']})]; }})()")
        browser.mouse(*at)
        text = browser.run("document.getElementById('face-value').textContent").replace("\u2212", "-")
        what = f"{name}: face map, step {step}, position {position}, s = {row['s_mm']}"
        neighbours = [other for other in rows if abs(float(other["s_mm"]) - float(row["s_mm"])) < 0.02 * float(rows[-1]["s_mm"])]
        pressures = [-float(other["s22_mpa"]) for other in neighbours]
        found = float(text.split("pressure ")[1].split(" MPa")[0].replace("\u00a0", ""))
        # A pixel holds one of the points near it; the page has 256 levels of pressure.
        checks.that(any(other["status"] in text for other in neighbours), f"{what}: status", text)
        checks.that(min(pressures) - slack <= found <= max(pressures) + slack, f"{what}: pressure", text, pressures)
    largest = 1e3 * max(float(row["opening_mm"]) for row in rows)
    caption = browser.run("document.querySelector('#deformed figcaption').textContent")
    opening = float(caption.split("largest opening is ")[1].split(" ")[0].replace("\u2212", "-").replace("\u00a0", ""))
    checks.that(abs(opening - largest) <= 1e3 * widest / 400 + 1e-2, f"{name}: opening of the deformed crack", caption, largest)


def check_row(browser, checks, name, folder):
    """The map of many cracks: by keyboard and pointer, at every width, on paper; what it says is in growth.csv."""
    browser.open(folder / "report.html")
    if not browser.run("Boolean(document.getElementById('row-map'))"):
        return
    growth = table(folder / "growth.csv")
    mouths = browser.run("JSON.parse(document.getElementById('row-data').textContent).mouth")
    count, last = len(mouths), max(int(row["step"]) for row in growth)
    along = sorted(range(1, count + 1), key=lambda crack: mouths[crack - 1])
    number = lambda text: float(text.replace("\u2212", "-").replace("\u00a0", ""))
    value = lambda id: browser.run(f"document.getElementById('{id}').value")
    readout = lambda: browser.run("document.getElementById('row-readout').textContent")

    def check_chosen(crack, step, what):
        browser.settle()
        text = readout()
        checks.that(text.startswith(f"Crack {crack} "), f"{name}: {what} chooses crack {crack}", text)
        checks.that(value("row-crack") == str(crack) and value("crack") == str(crack), f"{name}: {what}, the whole page follows", value("row-crack"), value("crack"))
        lengths = [float(row["length_mm"]) for row in growth if row["crack"] == str(crack) and int(row["step"]) <= step]
        checks.near(number(text.split(" mm: ")[1].split(" mm long")[0]), lengths[-1], f"{name}: {what}, the length of crack {crack} in step {step}", relative=1e-3)
        for chart in ["length-cycles", "rate-length"]:
            widest = browser.run(f"Math.max(...[...document.querySelectorAll('#{chart} .drawing svg g.curve polyline')].map((line) => parseFloat(getComputedStyle(line).strokeWidth)))")
            checks.that(last == 0 or widest > 3, f"{name}: {what}, crack {crack} is brought out on {chart}", widest)

    map_of = lambda up: f"#row-{up}"
    drawing = "document.querySelector('#row-map figure:not([hidden]) .drawing')"
    for width in WIDTHS:
        browser.open(folder / "report.html", width=width)
        browser.run(f"{drawing}.focus()")
        browser.key("Home")
        check_chosen(along[0], last, f"Home at {width} px")
        browser.key("ArrowRight", 2)
        check_chosen(along[2], last, f"→ at {width} px")
        browser.key("End")
        check_chosen(along[-1], last, f"End at {width} px")
        if last:
            browser.key("ArrowDown")
            step = browser.run(f"+{drawing}.querySelector('svg').dataset.step")
            checks.that(step < last, f"{name}: ↓ goes a step back at {width} px", step)
            check_chosen(along[-1], step, f"step {step} at {width} px")
            browser.key("ArrowUp")
        for up in browser.run("[...document.getElementById('row-up').options].map((o) => o.value)"):
            browser.run(f"(() => {{ const e = document.getElementById('row-up'); e.value = '{up}'; e.dispatchEvent(new Event('change')); }})()")
            drawn = browser.run(f"new Set([...document.querySelectorAll('{map_of(up)} .crack')].map((mark) => mark.parentNode.dataset.crack)).size")
            # A rate of nothing has no place on a logarithmic axis, an angle none at a point.
            checks.that(drawn == count or (up == "rate" and drawn > 0), f"{name}: every crack is on the map by {up} at {width} px", drawn, count)
            overlaps = browser.run(OVERLAPS)
            checks.that(not overlaps, f"{name}: by {up} at {width} px no text overlaps another", overlaps[:3])
        browser.run("(() => { const e = document.getElementById('row-up'); e.value = 'depth'; e.dispatchEvent(new Event('change')); })()")
        coloured = set()
        for colour in browser.run("[...document.getElementById('row-colour').options].map((o) => o.value)"):
            browser.run(f"(() => {{ const e = document.getElementById('row-colour'); e.value = '{colour}'; e.dispatchEvent(new Event('change')); }})()")
            coloured.add(browser.run("[...document.querySelectorAll('#row-depth .crack')].map((mark) => mark.getAttribute('stroke')).join()"))
            checks.that(browser.run("document.querySelectorAll('#row-depth .legend li').length") > 0, f"{name}: {colour} is explained")
        checks.that(len(coloured) > 2, f"{name}: the colours follow the choice", len(coloured))
        wide = browser.run("document.scrollingElement.scrollWidth - innerWidth")
        checks.that(wide <= 0, f"{name}: nothing sticks out of the map at {width} px", wide)
    # By pointer, at the middle of a crack that is not chosen.
    browser.box("#row-depth .drawing svg")
    crack, left, top = browser.run(
        "(() => { const mark = [...document.querySelectorAll('#row-depth g[data-crack]')][4].querySelector('.crack'); const at = mark.getPointAtLength(0.5 * mark.getTotalLength());"
        " const point = new DOMPoint(at.x, at.y).matrixTransform(mark.getScreenCTM()); return [+mark.parentNode.dataset.crack, point.x, point.y]; })()")
    browser.mouse(left, top)
    told = browser.run("document.getElementById('row-value').textContent")
    checks.that(told.startswith(f"Crack {crack} "), f"{name}: the pointer tells of crack {crack}", told)
    browser.mouse(left, top, click=True)
    check_chosen(crack, last, "a click")
    # The list, by keyboard.
    browser.run("document.getElementById('row-crack').focus()")
    browser.key("Home")
    first = browser.run("document.getElementById('row-crack').options[0].value")
    check_chosen(int(first), last, "Home on the list")
    # The table is folded, and sorts.
    rows = "[...document.querySelectorAll('#row table.sorts tbody tr')].map((row) => row.cells[1].textContent)"
    checks.that(browser.run("!document.querySelector('#row details').open"), f"{name}: the table is folded")
    browser.run("document.querySelector('#row details summary').click()")
    for _ in range(2):
        browser.run("document.querySelectorAll('#row table.sorts thead button')[1].click()")
    lengths = [number(text) for text in browser.run(rows)]
    checks.that(lengths == sorted(lengths, reverse=True) and len(lengths) > 9, f"{name}: the table sorts by length, down", lengths[:4])
    # On paper: the map as it stands, without controls.
    browser.media(medium="print")
    browser.size(PAPER, 1000)
    browser.run("dispatchEvent(new Event('beforeprint'))")
    browser.settle()
    seen = browser.run("[document.querySelector('#row-depth .drawing svg').getBoundingClientRect().width, document.getElementById('row-crack').getBoundingClientRect().width, document.querySelector('#row-depth figcaption').textContent]")
    checks.that(300 < seen[0] <= PAPER and seen[1] == 0 and f"crack {first} is highlighted" in seen[2], f"{name}: the map on paper", seen)
    browser.run("dispatchEvent(new Event('afterprint'))")
    browser.media()
    checks.that(not browser.complaints, f"{name}: no complaints after all this", browser.complaints)


def visible_paths(browser, figure):
    """Number of lines that a chart shows."""
    return browser.run(f"document.querySelectorAll('#{figure} g.curve:not(.off) polyline').length")


def tick(browser, group, value):
    """Clicks the switch of a value."""
    browser.run(f"document.querySelectorAll('#choices fieldset')[{group}].querySelectorAll('input')[{value}].click()")
    browser.settle()


def check_switched(browser, checks, name, study):
    """The switches of a study, by pointer and keyboard."""
    data, switched, runs, drawn, rows = study
    axis, group = switched[-1], len(switched) - 1
    tick(browser, group, 0)
    left = [run for run in data["runs"] if run["choice"][axis] != 0]
    checks.that(browser.run(rows) == len(left), f"{name}: a value that is off hides its rows", browser.run(rows))
    numbers = {str(run["number"]) for run in left}
    expected = sum(1 for row in drawn if row["run"] in numbers)
    checks.that(visible_paths(browser, "kii") == expected, f"{name}: and its curves", visible_paths(browser, "kii"), expected)
    tick(browser, group, 0)
    checks.that(browser.run(rows) == len(runs), f"{name}: on again, they are back")
    # By keyboard.
    browser.run("document.querySelector('#choices input').focus()")
    browser.key(" ")
    checks.that(browser.run(rows) < len(runs), f"{name}: the space key works a switch")
    browser.key(" ")


def check_switches(browser, checks, name, folder):
    """Switches hide and show curves and rows; the pointer brings a run out; curves and rows are those of the tables."""
    browser.open(folder / "report.html")
    runs = table(folder / "summary.csv")
    data = json.loads((folder / "study.json").read_text())
    drawn = [row for row in runs if row["state"] in ("done", "unfinished") or row["length_mm"]]
    rows = "[...document.querySelectorAll('tr[data-choices]')].filter((r) => !r.hidden).length"
    checks.that(browser.run(rows) == len(runs), f"{name}: a row for each run")
    checks.that(visible_paths(browser, "kii") == len(drawn), f"{name}: a curve of K_II for each run with a step", visible_paths(browser, "kii"))
    for row in runs:
        link = f"runs/{row['folder']}/report.html"
        there = browser.run(f"Boolean(document.querySelector('a[href=\"{link}\"]'))")
        checks.that(there == (folder / link).exists(), f"{name}: a run with a report leads to it", link)
    # Growth and K of every run, as the chart has them.
    figure, column = "length-cycles", "length_mm"
    if browser.run(f"railcrack.charts.has('{figure}')"):
        curves = browser.run(f"railcrack.chart('{figure}').curves().map((c) => [c.name, c.points.at(-1).x, c.points.at(-1).y])")
        for curve, row in zip(curves, drawn):
            checks.that(curve[0].startswith(f"run {row['run']}: "), f"{name}: {figure} has run {row['run']}", curve)
            # Half a hundredth of a pixel, on a logarithmic axis a share.
            checks.near(curve[1], float(row["load_cycles"]), f"{name}: {figure}, cycles of run {row['run']}", relative=5e-4)
            checks.near(curve[2], float(row[column]), f"{name}: {figure}, {column} of run {row['run']}", relative=5e-4)
    # Samples have no switches; of the last other axis, switching its first value off leaves the others.
    switched = [i for i, axis in enumerate(data["axes"]) if not any("distribution" in key for key in axis["keys"])]
    fieldsets = browser.run("document.querySelectorAll('#choices fieldset').length")
    checks.that(fieldsets == len(switched), f"{name}: switches for lists, none for samples", fieldsets, len(switched))
    if switched:
        check_switched(browser, checks, name, (data, switched, runs, drawn, rows))
    browser.box("#kii .drawing svg")
    left, top = browser.run(
        "(() => { const { svg, x, y, curves } = railcrack.chart('kii'); const box = svg.getBoundingClientRect(); const part = box.width / svg.viewBox.baseVal.width;"
        " const p = curves()[0].points.reduce((a, b) => (Math.abs(b.y) > Math.abs(a.y) ? b : a)); return [box.left + part * x.at(p.x), box.top + part * y.at(p.y)]; })()")
    browser.mouse(left, top)
    text = browser.run("document.querySelector('#kii [aria-label=tip]')?.textContent ?? ''")
    checks.that("run " in text and "KII" in text, f"{name}: hover names the run and its value", text)
    out = browser.run("[...document.querySelectorAll('tr.out')].map((r) => r.dataset.name)")
    checks.that(len(out) == 1 and out[0].split(":")[0] in text, f"{name}: hover brings out the row of the run", out, text)
    quiet = browser.run("document.querySelectorAll('#length-cycles g.curve.back, #paths g.curve.back').length")
    checks.that(len(drawn) < 2 or quiet > 0, f"{name}: the others step back on the other charts", quiet)
    # What is said to be to scale is.
    scales = browser.run("(() => { const { x, y } = railcrack.chart('paths'); return [x, y].map((axis) => Math.abs(axis.at(1) - axis.at(0))); })()")
    checks.near(scales[0], scales[1], f"{name}: paths are to scale", relative=0.02)
    checks.that(not browser.complaints, f"{name}: no complaints after all this", browser.complaints)


# Runs above which a page has bands and a table that sorts.
MANY = 50


def check_many(browser, checks, name, folder):
    """Bands, two keys against each other, bars, a table that sorts and filters, one run on demand."""
    # The best of some tries: others may use the machine.
    took = []
    while len(took) < 5 and min(took, default=2) >= 2:
        begun = time.monotonic()
        browser.open(folder / "report.html")
        took.append(time.monotonic() - begun)
    checks.that(min(took) < 2, f"{name}: the page opens in two seconds", took)
    runs = table(folder / "summary.csv")
    done = [row for row in runs if row["length_mm"]]
    text = lambda id: browser.run(f"document.getElementById('study-{id}').textContent")
    checks.that(text("count") == f"{len(runs)} of {len(runs)} runs", f"{name}: all runs are in the table", text("count"))
    drawn = browser.run("document.querySelectorAll('#study-scatter .drawing svg circle').length")
    checks.that(drawn > 1, f"{name}: the runs are drawn", drawn)
    # A colour that stands for a number has a scale with both its ends.
    colours, says = browser.run("(() => { const legend = document.querySelector('#study-scatter .legend'); return [legend.querySelectorAll('rect').length, legend.textContent]; })()")
    checks.that(colours > 8 and len(re.findall(r"\d", says)) > 1, f"{name}: the colours have a scale", colours, says)
    # What results depend on: numbers with their intervals.
    estimates = browser.run("[...document.querySelectorAll('#runs table.sorts tbody tr')].map((r) => [...r.cells].slice(2).map((c) => c.textContent))")
    checks.that(len(estimates) > 3, f"{name}: a row for each result and key", len(estimates))
    value = lambda text: float(text.replace("\u2212", "-"))
    for rank, rank_span, index, index_span in estimates:
        for shown, span, low in [(rank, rank_span, -1), (index, index_span, 0)]:
            ends = [value(end) for end in span.split(" to ")] if span else None
            checks.that(ends is None or (low <= value(shown) <= 1 and ends[0] - 0.01 <= value(shown) <= ends[1] + 0.01), f"{name}: an estimate lies in its interval", shown, span)
    # Quantiles of the results are those of the table.
    lengths = sorted(float(row["length_mm"]) for row in done)
    medians = browser.run("Object.fromEntries([...document.querySelectorAll('#study-quantiles tbody tr')].map((r) => [r.cells[0].textContent, r.cells[4].textContent]))")
    middle = 0.5 * (lengths[(len(lengths) - 1) // 2] + lengths[len(lengths) // 2])
    checks.near(medians.get("Length (mm)"), middle, f"{name}: the median length", relative=1e-3)
    # Of many runs the dots are some that leave out no part of a key; the tails of a distribution have few.
    spans = browser.run(
        "(() => { const dots = [...document.querySelectorAll('#study-scatter .drawing svg circle')];"
        " return [['x', 378], ['y', 242]].map(([axis, inside]) => { const [low, high] = railcrack.ends(dots.map((dot) => +dot.getAttribute(`c${axis}`)));"
        " return (high - low) / inside; }); })()")
    checks.that(min(spans) > 0.65, f"{name}: the dots span both axes", spans)
    # The median band of growth lies between the first and the last run.
    points = browser.run("railcrack.charts.get('length-cycles')?.curves().find((c) => c.name === 'median')?.points.map((p) => p.x) ?? []")
    cycles = sorted(float(row["load_cycles"]) for row in done)
    checks.that(points and points[0] > 0 and points[-1] <= 1.001 * cycles[-1], f"{name}: the median life is among the lives", points[-1:], cycles[-1:])
    # Sorting by load cycles, down, puts the longest first.
    heads = browser.run("[...document.querySelectorAll('#study-table th')].map((h) => h.textContent)")
    place = heads.index("Load cycles")
    first = f"+document.querySelector('#study-table tbody tr').dataset.run"
    for _ in range(2):
        browser.run(f"document.querySelectorAll('#study-table th button')[{place}].click()")
    longest = max(done, key=lambda row: float(row["load_cycles"]))
    top = next(row for row in runs if row["run"] == str(browser.run(first)))
    checks.near(float(top["load_cycles"]), float(longest["load_cycles"]), f"{name}: sorted by load cycles", relative=1e-6)
    # A condition leaves out the other runs.
    browser.run("(() => { const box = document.getElementById('study-filter'); box.value = 'run <= 10'; box.dispatchEvent(new Event('input')); })()")
    checks.that(text("count") == f"10 of {len(runs)} runs", f"{name}: a condition holds for some", text("count"))
    browser.run("(() => { const box = document.getElementById('study-filter'); box.value = ''; box.dispatchEvent(new Event('input')); })()")
    check_conditions(browser, checks, name, len(runs))
    # One run on demand, with its own growth.
    browser.run("document.querySelector('#study-table tbody tr').click()")
    browser.settle()
    rows = browser.run("document.querySelectorAll('#study-one tbody tr').length")
    checks.that(rows == int(top["steps"]) + 1, f"{name}: the growth of a run has its steps", rows, top["steps"])
    checks.that(browser.run("document.querySelector('#study-one h3').textContent") == f"Run {top['run']}", f"{name}: the run is named")
    for select in ["x", "y", "z"]:
        browser.run(f"(() => {{ const s = document.getElementById('study-{select}'); s.selectedIndex = s.options.length - 1; s.dispatchEvent(new Event('change')); }})()")
    browser.settle()
    checks.that(not browser.complaints, f"{name}: no complaints after all this", browser.complaints)


def check_conditions(browser, checks, name, count):
    """Conditions act on table, charts and bars; the page says what of them it does not understand."""
    said = "[document.getElementById('study-unknown').hidden, document.getElementById('study-unknown').textContent, document.getElementById('study-count').textContent]"

    def ask(text):
        browser.run(f"(() => {{ const box = document.getElementById('study-filter'); box.value = {json.dumps(text)}; box.dispatchEvent(new Event('input')); }})()")
        browser.settle()
        return browser.run(said)

    for text, reason in [("nonsense > 3", "no column is called"), ("run > many", "not a number"), ("stop = neither", "no value of stop"), ("run", "no condition")]:
        hidden, words, counted = ask(text)
        checks.that(not hidden and reason in words, f"{name}: {text!r} is not understood, and the page says so", words)
        checks.that(counted == f"{count} of {count} runs", f"{name}: and it leaves out no run", counted)
    hidden, words, counted = ask("run > 5 and run <= 10; nonsense = 1")
    checks.that(not hidden and counted == f"5 of {count} runs", f"{name}: what is understood holds", words, counted)
    counts = browser.run("[...document.querySelectorAll('#study-quantiles tbody tr')].map((r) => +r.cells[1].textContent)")
    checks.that(counts and max(counts) <= 5, f"{name}: the quantiles are those of the selected runs", counts)
    dots = browser.run("document.querySelectorAll('#study-scatter .drawing svg circle').length")
    checks.that(dots <= 5, f"{name}: the dots are the selected runs", dots)
    hidden, words, counted = ask("")
    checks.that(hidden and counted == f"{count} of {count} runs", f"{name}: without conditions all runs are there", words, counted)


def check_pieces(browser, checks, name, folder):
    """Spalls and junctions are in the first lines and in the picture of the last step."""
    summary = json.loads((folder / "summary.json").read_text())
    if not summary.get("pieces") and not summary.get("junctions"):
        return
    browser.open(folder / "report.html")
    verdict = browser.run("document.querySelector('.verdict').textContent")
    shown = browser.run("JSON.parse(document.getElementById('run-data').textContent)")
    for piece in summary["pieces"][:3]:
        checks.that(f"{piece['area_mm2']:.3f}"[:4] in verdict and f"crack {piece['crack']}" in verdict, f"{name}: the piece is in the first lines", verdict)
        area = 0.0
        corners = next(p for p in shown["pieces"] if p["crack"] == piece["crack"])["outline"]
        for (x, y), (u, v) in zip(corners, corners[1:] + corners[:1]):
            area += 0.5 * (x * v - u * y)
        checks.near(abs(area), piece["area_mm2"], f"{name}: the outline has the area", relative=1e-4)
    for junction in summary["junctions"][:3]:
        checks.that(f"Crack {junction['crack']} joins crack {junction['onto']}" in verdict, f"{name}: the junction is in the first lines", verdict)
    checks.that(browser.run("document.querySelector('#scene .drawing svg').dataset.pieces") == "0", f"{name}: no piece at the beginning")
    browser.run("document.getElementById('step').focus()")
    browser.key("End")
    browser.settle()
    checks.that(browser.run("document.querySelector('#scene .drawing svg').dataset.pieces") == str(len(summary["pieces"])), f"{name}: the pieces are drawn at the end")


def pictures(browser, name, folder, out):
    for theme in ["light", "dark"]:
        browser.open(folder / "report.html", theme=theme)
        browser.picture(out / f"{name}-{theme}-first-screen.png")
        for section in browser.run("[...document.querySelectorAll('main > section')].map((s) => s.id)"):
            browser.picture(out / f"{name}-{theme}-{section}.png", f"#{section}")
    browser.open(folder / "report.html")
    browser.pdf(out / f"{name}.pdf")


def main():
    program, out, folders = sys.argv[1], Path(sys.argv[2]), [Path(folder) for folder in sys.argv[3:]]
    out.mkdir(parents=True, exist_ok=True)
    names = [folder.name for folder in folders]
    checks = Checks()
    browser = Browser(program)
    try:
        for folder in folders:
            before = checks.failed
            # The folder of a run and that of its first stage have the same last name elsewhere.
            name = folder.name if names.count(folder.name) == 1 else f"{folder.parent.name}-{folder.name}"
            check_page(browser, checks, name, folder / "report.html")
            if browser.run("Boolean(document.getElementById('space-data'))"):
                check_space(browser, checks, name, folder)
            elif (folder / "sif.csv").exists():
                check_explorer(browser, checks, name, folder)
                check_wheels(browser, checks, name, folder)
                check_row(browser, checks, name, folder)
                check_fields(browser, checks, name, folder)
                check_pieces(browser, checks, name, folder)
                if (folder / "contact.csv").exists():
                    check_contact(browser, checks, name, folder)
            elif (folder / "study.json").exists():
                many = len(json.loads((folder / "study.json").read_text())["runs"]) > MANY
                (check_many if many else check_switches)(browser, checks, name, folder)
            pictures(browser, name, folder, out)
            print(f"{name}: {'ok' if checks.failed == before else 'FAILED'}", flush=True)
    finally:
        browser.close()
    print(f"{checks.passed} passed, {checks.failed} failed")
    return 1 if checks.failed or not checks.passed else 0


if __name__ == "__main__":
    sys.exit(main())

"""Reports in a real browser.

    report_browser_test.py BROWSER PICTURES FOLDER...

Opens `report.html` of each folder in the headless Chromium BROWSER, checks it against the tables in the folder, and leaves
pictures of every section (light, dark, printed) in PICTURES. Ends with 1 where a check fails.
"""

import base64
import csv
import json
import struct
import sys
from pathlib import Path

from browser import Browser

OVERLAPS = """
(() => {
  const bad = [];
  for (const svg of document.querySelectorAll('figure .drawing svg')) {
    const texts = [...svg.querySelectorAll('text')].filter((t) => t.textContent.trim() && !t.closest('[aria-label="tip"]'));
    const boxes = texts.map((t) => t.getBoundingClientRect());
    for (let i = 0; i < texts.length; i++)
      for (let j = 0; j < i; j++) {
        const across = Math.min(boxes[i].right, boxes[j].right) - Math.max(boxes[i].left, boxes[j].left);
        const down = Math.min(boxes[i].bottom, boxes[j].bottom) - Math.max(boxes[i].top, boxes[j].top);
        if (across > 1 && down > 3) bad.push(`${svg.closest('figure').id}: "${texts[i].textContent}" and "${texts[j].textContent}"`);
      }
  }
  return bad;
})()
"""
OUTSIDE = """
[...document.querySelectorAll('figure .drawing svg')].filter((svg) => {
  const inside = svg.closest('figure').getBoundingClientRect(), box = svg.getBoundingClientRect();
  return box.width > 0 && (box.right > inside.right + 2 || box.left < inside.left - 2);
}).map((svg) => svg.closest('figure').id)
"""


class Checks:
    def __init__(self):
        self.passed, self.failed = 0, 0

    def that(self, holds, what, *about):
        if holds:
            self.passed += 1
        else:
            self.failed += 1
            print("FAILED:", what, *about, flush=True)

    def near(self, value, want, what, relative=2e-5):
        """Numbers in the page have six digits."""
        close = value is not None and abs(float(value) - want) <= relative * abs(want) + 1e-6
        self.that(close, what, f"is {value}, the table has {want}")


def table(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def stabilised(rows):
    """Rows of the last passage of each step."""
    last = {}
    for row in rows:
        last[row["step"]] = row["passage"]
    return [row for row in rows if row["passage"] == last[row["step"]]]


def check_page(browser, checks, name, path):
    """What every page must hold."""
    checks.that(path.stat().st_size < 5_000_000, f"{name}: at most 5 MB", path.stat().st_size)
    for theme in ["light", "dark"]:
        for width in [1280, 420]:
            browser.open(path, width=width, theme=theme)
            what = f"{name}, {theme}, {width} px"
            checks.that(not browser.complaints, f"{what}: no complaints of the browser", browser.complaints)
            outside = [url for url in browser.requests if not url.startswith(("file:", "data:", "blob:"))]
            checks.that(not outside, f"{what}: no network", outside)
            overlaps = browser.run(OVERLAPS)
            checks.that(not overlaps, f"{what}: no text overlaps another", overlaps[:3])
            wide = browser.run("document.scrollingElement.scrollWidth - innerWidth")
            checks.that(wide <= 0, f"{what}: nothing sticks out sideways", wide)
            undrawn = browser.run(
                "[...document.querySelectorAll('figure.chart')].filter((f) => !f.querySelector('.drawing svg [aria-label=line] path,"
                " .drawing svg [aria-label=dot] circle')).map((f) => f.id)")
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
        ground = browser.run("getComputedStyle(document.body).backgroundColor")
        light = sum(int(part) for part in ground.strip("rgb()").split(",")[:3]) > 382
        checks.that(light == (theme == "light"), f"{name}: {theme} follows the system", ground)
    browser.open(path)
    for _ in range(2):
        browser.run("document.getElementById('theme').click()")
    checks.that(browser.run("document.documentElement.dataset.theme") == "dark", f"{name}: the button changes the theme")
    browser.run("document.getElementById('theme').click()")
    bottom = browser.run("document.querySelector('.facts').getBoundingClientRect().bottom")
    checks.that(bottom < 900, f"{name}: verdict and facts are on the first screen", bottom)
    figures = browser.run("[...document.querySelectorAll('figure')].filter((f) => f.querySelector('.drawing svg') && f.querySelector('.tools')).map((f) => f.id)")
    for figure in figures:
        data = browser.run(f"railcrack.png(document.getElementById({json.dumps(figure)}))")
        content = base64.b64decode(data.split(",")[1])
        width, height = struct.unpack(">II", content[16:24])
        checks.that(width > 300 and height > 200, f"{name}: {figure} can be kept as PNG", width, height)
    browser.media(medium="print")
    browser.settle()
    outside = browser.run(OUTSIDE)
    checks.that(not outside, f"{name}: on paper, charts stay in their columns", outside)
    # What is wider than its place could be scrolled to on a screen.
    cut = browser.run(
        "(() => { dispatchEvent(new Event('beforeprint')); const wide = [...document.querySelectorAll('.beside .wide')]"
        ".filter((e) => e.firstElementChild.getBoundingClientRect().right > e.parentElement.getBoundingClientRect().left"
        " + 0.5 * e.parentElement.clientWidth + 10).map((e) => e.textContent.slice(0, 40));"
        " dispatchEvent(new Event('afterprint')); return wide; })()")
    checks.that(not cut, f"{name}: on paper, tables end before what stands beside them", cut)
    browser.media()
    check_without_scripts(browser, checks, name, path)


def check_without_scripts(browser, checks, name, path):
    browser.send("Emulation.setScriptExecutionDisabled", value=True)
    browser.open_plain(path)
    document = browser.send("DOM.getDocument", depth=0)["root"]["nodeId"]
    count = lambda selector: len(browser.send("DOM.querySelectorAll", nodeId=document, selector=selector)["nodeIds"])
    checks.that(count(".verdict") == 1 and count(".facts div") > 2, f"{name}: without scripts the result is there")
    checks.that(count("noscript img, .picture img") > 0 or count("#explorer") == 0, f"{name}: without scripts there are pictures")
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

    def check_k(step):
        here = [row for row in sif if int(row["step"]) == step and int(row["position"]) == position]
        many = len(here) > 7
        here = [row for row in here if not many or row["crack"] == "1"]
        for figure, column in [("ki", "ki_mpa_sqrt_m"), ("kii", "kii_mpa_sqrt_m")]:
            there = marks(browser, figure)
            what = f"{name}: {figure}, step {step}, position {position}"
            checks.that(len(there) == len(here), f"{what}: a mark for each tip", there)
            for (x, k), row in zip(there, here):
                checks.near(x, float(row["xc_over_a"]), f"{what}, wheel")
                checks.near(k, float(row[column]), what)
        checks.near(browser.run("document.querySelector('#scene svg').dataset.centre"), float(here[0]["xc_mm"]), f"{name}: the wheel over the cracks")
        for figure in ["face-status", "face-pressure"]:
            line = browser.run(f"document.querySelector('#{figure} line.here')?.dataset.x")
            checks.near(line, float(here[0]["xc_over_a"]), f"{name}: the line on {figure}")

    positions = max(int(row["position"]) for row in sif)
    browser.run("document.getElementById('wheel').focus()")
    browser.key("Home")
    check_k(steps[0])
    before = browser.run("document.querySelector('#scene svg').innerHTML")
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
    checks.that(browser.run("document.querySelector('#scene svg').innerHTML") != before, f"{name}: the picture of the load follows")
    check_faces(browser, checks, name, folder, 0, position)
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
        rows = [row for row in growth if int(row["step"]) == shown[-1]]
        for figure, columns in [("length-cycles", ("load_cycles", "length_mm")), ("rate-length", ("length_mm", "rate_mm_per_cycle")),
                                ("rate-delta-k", ("delta_keq_mpa_sqrt_m", "rate_mm_per_cycle"))]:
            rows_shown = rows if figure == "length-cycles" else [row for row in rows if float(row["rate_mm_per_cycle"]) > 0]
            there = marks(browser, figure)
            checks.that(len(there) == len(rows_shown), f"{name}: {figure} marks the step", there)
            for (x, y), row in zip(there, rows_shown):
                checks.near(x, float(row[columns[0]]), f"{name}: {figure}, {columns[0]}")
                checks.near(y, float(row[columns[1]]), f"{name}: {figure}, {columns[1]}")
        check_faces(browser, checks, name, folder, shown[-1], position)
        # The page's own keys.
        browser.run("document.activeElement.blur(); document.getElementById('ki').scrollIntoView({block: 'center'})")
        browser.key("ArrowDown")
        browser.until(f"document.getElementById('step-value').textContent.startsWith('{shown[-2]} of')")
        browser.key("ArrowRight")
        position += 1
        check_k(shown[-2])
    hover(browser, checks, name)
    pressed = browser.run("document.getElementById('play').click(); document.getElementById('wheel').value")
    browser.until(f"document.getElementById('wheel').value !== '{pressed}'")
    browser.run("document.getElementById('play').click()")
    checks.that(not browser.complaints, f"{name}: no complaints after all this", browser.complaints)


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
        checks.that(browser.run("document.getElementById('field-caption').textContent").startswith(label + ","), f"{name}: field {choice} is shown", label)
        seen.add(browser.run(picture))
    checks.that(len(seen) == browser.run("document.getElementById('field-choice').options.length"), f"{name}: every field is another picture", len(seen))
    before = browser.run(picture)
    browser.run("document.getElementById('field-scale').focus()")
    browser.key("Home")
    checks.that(browser.run("document.getElementById('field-scale-value').textContent") == "none", f"{name}: the deformation can be left out")
    checks.that(browser.run(picture) != before, f"{name}: the slider deforms the picture")


def hover(browser, checks, name):
    """The pointer on a curve of K_II, where the wheel is, gives its values."""
    browser.box("#kii .drawing svg")
    left, top, width, height = browser.run(
        "(() => { const b = document.querySelector('#kii g.marks circle').getBoundingClientRect(); return [b.left, b.top, b.width, b.height]; })()")
    browser.mouse(left + 0.5 * width, top + 0.5 * height)
    text = browser.run("document.querySelector('#kii [aria-label=tip]')?.textContent ?? ''")
    checks.that("K_II" in text and "MPa" in text and "x_c/a" in text, f"{name}: hover gives values", text)


def check_faces(browser, checks, name, folder, step, position):
    """The map under the pointer, and the deformed crack, against faces.csv."""
    last = {}
    rows = []
    with open(folder / "faces.csv", newline="") as file:
        for row in csv.DictReader(line for line in file if line.startswith((f"{step},", "step,"))):
            if row["crack"] == "1" and int(row["position"]) == position:
                last.setdefault(row["passage"], []).append(row)
    rows = list(last.values())[-1]
    stride = browser.run("JSON.parse(document.getElementById('run-data').textContent).face_stride")
    if (position - 1) % stride:
        return
    browser.box("#face-status .drawing svg")
    for row in rows[:: max(1, len(rows) // 4)]:
        at = browser.run(
            "(() => { const svg = document.querySelector('#face-status .drawing svg'); const box = svg.getBoundingClientRect();"
            f" const part = box.width / svg.viewBox.baseVal.width; return [box.left + part * svg.scale('x').apply({browser.run('JSON.parse(document.getElementById(`run-data`).textContent).xc_over_a')[position - 1]}),"
            f" box.top + part * svg.scale('y').apply({row['s_mm']})]; }})()")
        browser.mouse(*at)
        text = browser.run("document.getElementById('face-value').textContent").replace("\u2212", "-")
        what = f"{name}: face map, step {step}, position {position}, s = {row['s_mm']}"
        neighbours = [other for other in rows if abs(float(other["s_mm"]) - float(row["s_mm"])) < 0.02 * float(rows[-1]["s_mm"])]
        pressures = [-float(other["s22_mpa"]) for other in neighbours]
        found = float(text.split("pressure ")[1].split(" MPa")[0].replace("\u00a0", ""))
        # A pixel holds one of the points near it.
        checks.that(any(other["status"] in text for other in neighbours), f"{what}: status", text)
        checks.that(min(pressures) - 0.5 <= found <= max(pressures) + 0.5, f"{what}: pressure", text, pressures)
    largest = 1e3 * max(float(row["opening_mm"]) for row in rows)
    caption = browser.run("document.getElementById('deformed-caption').textContent")
    opening = float(caption.split("largest opening is ")[1].split(" ")[0].replace("\u2212", "-").replace("\u00a0", ""))
    checks.that(abs(opening - largest) <= 2e-3 * largest + 2e-2, f"{name}: opening of the deformed crack", caption, largest)


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
            if (folder / "sif.csv").exists():
                check_explorer(browser, checks, name, folder)
                check_fields(browser, checks, name, folder)
            pictures(browser, name, folder, out)
            print(f"{name}: {'ok' if checks.failed == before else 'FAILED'}", flush=True)
    finally:
        browser.close()
    print(f"{checks.passed} passed, {checks.failed} failed")
    return 1 if checks.failed or not checks.passed else 0


if __name__ == "__main__":
    sys.exit(main())

"""The explorer in a real browser.

    explorer_browser_test.py BROWSER PICTURES PAGE PROGRAM RUN

Opens the explorer PAGE in the headless Chromium BROWSER from a file, drags its sliders, types into its case, stops it, narrows it to
a phone, and compares a life with that of the railcrack PROGRAM. The report of the folder RUN, which computes too, must have the life
of the run. Pictures of every width, dark and printed, are left in PICTURES.
Ends with 1 where a check fails, the page asks for anything from anywhere, or a growth step takes more than 150 ms.
"""

import csv
import json
import subprocess
import sys
import tempfile
from pathlib import Path

from browser import Browser
from report_browser_test import BEYOND, OVERLAPS, Checks

STATE = "document.getElementById('what-if-engine').dataset.state"
WIDTHS = [390, 800, 1400]


class Explorer:
    """The page and what its engine says of itself."""

    def __init__(self, browser, page):
        self.browser, self.page = browser, page

    def open(self, width=1400, theme="light", fragment=""):
        self.browser.open(self.page, width=width, theme=theme)
        self.until("done")
        if fragment:
            self.browser.run(f"location.hash = {fragment!r}")
            self.decided()
        self.browser.settle()

    def decided(self):
        """Waits for the first whole decision, which comes when the case is at rest."""
        self.browser.until("document.getElementById('what-if-engine').dataset.decided === 'true'")
        self.until("done")

    def data(self, name):
        return self.browser.run(f"document.getElementById('what-if-engine').dataset.{name}")

    def until(self, state):
        self.browser.until(f"document.getElementById('what-if-engine').dataset.state === '{state}'")

    def text(self, selector):
        return self.browser.run(f"document.querySelector({selector!r}).textContent")

    def case(self):
        return self.browser.run("document.getElementById('what-if-case').value")

    def curve(self, name):
        """The drawn curves of a chart."""
        return self.browser.run(f"[...document.querySelectorAll('#what-if-{name} svg g.curve polyline')].map((p) => p.getAttribute('points')).join()")


def check_drag(explorer, checks):
    browser = explorer.browser
    explorer.open()
    before = {name: explorer.curve(name) for name in ["ki", "kii", "depth", "path"]}
    words = explorer.text("#what-if-readout")
    checks.that("Computed here and now" in words, "the page says where its numbers come from", words)
    lives = int(explorer.data("lives"))
    left, top, width, height = browser.box("#what-if-contact-friction")
    browser.send("Input.dispatchMouseEvent", type="mousePressed", x=left + 0.3 * width, y=top + height / 2, button="left", clickCount=1)
    # To and fro, at least once: on a busy machine until a life is through.
    for i in range(300):
        x = left + (0.3 + 0.02 * abs((i + 25) % 50 - 25)) * width
        browser.send("Input.dispatchMouseEvent", type="mouseMoved", x=x, y=top + height / 2, button="left", buttons=1)
        browser.run("new Promise((done) => setTimeout(done, 60))")
        if i > 30 and int(explorer.data("lives")) > lives:
            break
    during = int(explorer.data("lives"))
    browser.send("Input.dispatchMouseEvent", type="mouseReleased", x=x, y=top + height / 2, button="left", clickCount=1)
    explorer.until("done")
    checks.that(during > lives, "the life moves while one drags", f"{during - lives} lives")
    browser.settle()
    for name, drawn in before.items():
        checks.that(explorer.curve(name) != drawn, f"dragging changes the chart {name}")
    checks.that("friction = -0.2\n" not in explorer.case(), "the slider writes into the case")
    print(f"dragging: {during - lives} lives in {i + 1} moves", flush=True)
    # What rests goes into the address, and comes back from it.
    browser.until("location.hash.startsWith('#what-if&contact.friction=')")
    kept, address = explorer.case(), browser.run("location.hash")
    explorer.open(fragment=address)
    browser.until("document.getElementById('what-if-case').value.includes('friction')")
    checks.that(explorer.case() == kept, "the address keeps the state", address)


def print_speed(explorer, _checks):
    """Prints the times of the best of several lives: they are those of this machine."""
    explorer.open()
    times = []
    for _ in range(6):
        explorer.browser.run("document.getElementById('what-if-reset').click()")
        explorer.until("done")
        times.append((float(explorer.data("slowest")), float(explorer.data("life"))))
    slowest, life = (min(column) for column in zip(*times))
    print(f"speed: slowest step of a life {slowest:.0f} ms, life of 12 steps {life:.0f} ms", flush=True)


def check_deciding(explorer, checks):
    """The rest of a decision takes longer than a life, and does not make the next one wait."""
    browser = explorer.browser
    explorer.open()
    explorer.decided()
    rest = float(explorer.data("deciding"))
    # On a busy machine both take longer.
    limit = rest / 4
    times = []
    for _ in range(3):
        browser.open(explorer.page)
        browser.until(f"{STATE} === 'deciding'")
        words = explorer.text("#what-if-readout")
        checks.that("the rest of the decision" in words.lower(), "the page says what it still computes", words)
        checks.that(browser.run("document.getElementById('what-if-growth').disabled"), "no table is offered meanwhile")
        times.append(browser.run(
            "new Promise((done) => {"
            "  const place = document.getElementById('what-if-engine'), input = document.getElementById('what-if-crack-length_mm');"
            "  const before = place.dataset.lives, from = performance.now();"
            "  new MutationObserver(() => { if (place.dataset.lives !== before) done(performance.now() - from); })"
            "    .observe(place, { attributes: true });"
            "  input.value = 3.5; input.dispatchEvent(new Event('input'));"
            "})"))
    checks.that(min(times) <= limit, f"a change during a decision has its life within {limit:.0f} ms", f"{min(times):.0f} ms")
    print(f"a decision takes {rest:.0f} ms; a change meanwhile has its life after {min(times):.0f} ms", flush=True)
    browser.until(f"{STATE} === 'deciding'")
    browser.run("document.getElementById('what-if-stop').click()")
    said = explorer.text("#what-if-readout")
    checks.that(explorer.data("state") == "stopped" and "of this life alone" in said, "the button stops a decision", said)


def check_keys(explorer, checks):
    browser = explorer.browser
    explorer.open()
    browser.run("document.getElementById('what-if-crack-length_mm').focus()")
    before = explorer.case()
    browser.key("ArrowRight", times=3)
    explorer.until("done")
    checks.that(explorer.case() != before, "an arrow key moves a slider")
    browser.key("Tab")
    checks.that(browser.run("document.activeElement.id.startsWith('what-if-') && document.activeElement.matches(':focus-visible')"),
                "Tab leads to the next value, which is marked", browser.run("document.activeElement.id"))
    browser.run("document.getElementById('what-if-reset').click()")
    explorer.until("done")
    checks.that(explorer.case() == before, "the case comes back")


def check_typing(explorer, checks):
    browser = explorer.browser
    explorer.open()
    # A key that does not exist, on a line of its own.
    browser.run("document.getElementById('what-if-case').focus(); document.getElementById('what-if-case').setSelectionRange(0, 0)")
    browser.send("Input.insertText", text="frictoin = 1\n")
    explorer.until("refused")
    said = explorer.text("#what-if-errors")
    checks.that("line 1" in said and "frictoin" in said, "an error has its line and key", said)
    browser.run("document.getElementById('what-if-reset').click()")
    explorer.until("done")
    checks.that(browser.run("document.getElementById('what-if-errors').hidden"), "a right case clears the errors")
    edited = explorer.case().replace('engine = "dislocation"', 'engine = "xfem"')
    browser.run(f"(() => {{ const e = document.getElementById('what-if-case'); e.value = {edited!r}; e.dispatchEvent(new Event('input')); }})()")
    explorer.until("refused")
    said = explorer.text("#what-if-errors")
    checks.that("a page computes with" in said, "another engine is refused with a sentence", said)


def check_stop(explorer, checks):
    browser = explorer.browser
    explorer.open()
    # A long life: many cracks, many steps.
    long = explorer.case().replace("friction = 0.5", "friction = 0.5\ncount = 6\nspacing_mm = 4.0").replace("steps = 12", "steps = 400")
    browser.run(f"(() => {{ const e = document.getElementById('what-if-case'); e.value = {long!r}; e.dispatchEvent(new Event('input')); }})()")
    explorer.until("computing")
    browser.run("new Promise((done) => setTimeout(done, 700))")
    checks.that(explorer.data("state") == "computing", "the long life is computed", explorer.data("state"))
    browser.run("document.getElementById('what-if-stop').click()")
    checks.that(explorer.data("state") == "stopped", "the button stops at once")
    browser.run(f"(() => {{ const e = document.getElementById('what-if-case'); e.value = {long!r}; e.dispatchEvent(new Event('input')); }})()")
    explorer.until("computing")
    browser.key("Escape")
    checks.that(explorer.data("state") == "stopped", "Escape stops, too", explorer.data("state"))
    browser.run("document.getElementById('what-if-reset').click()")
    explorer.until("done")
    checks.that(True, "and the engine computes again")


def check_life(explorer, checks, program):
    """The life of the page against that of the program."""
    browser = explorer.browser
    explorer.open()
    with tempfile.TemporaryDirectory() as scratch:
        case = Path(scratch, "case.toml")
        case.write_text(explorer.case())
        subprocess.run([program, "run", str(case), "--out", f"{scratch}/run", "--quiet"], check=True, stdout=subprocess.DEVNULL)
        lines = [line for line in Path(scratch, "run", "growth.csv").read_text().splitlines() if not line.startswith("#")]
        rows = list(csv.DictReader(lines))
    shown = explorer.text("#what-if-readout")
    checks.that(f"{len(rows)} steps" in shown, "as many steps as the program", shown)
    delta = float(rows[0]["delta_kii_mpa_sqrt_m"])
    checks.that(f"{delta:.4g}" in shown, "the range of K_II is that of the program", f"{delta:.4g}: {shown}")
    depth = browser.run("document.querySelectorAll('#what-if-depth .drawing g.curve circle').length")
    checks.that(depth == len(rows), "a dot for each step", f"{depth} for {len(rows)}")


def check_report(browser, checks, folder):
    """The part of a report that computes: the life of its run, and another one."""
    summary = json.loads((folder / "summary.json").read_text())
    # A run that is not followed to a failure ends with its traffic.
    end = summary["decision"]["failure"]["mgt"] or summary["million_gross_tonnes"]
    explorer = Explorer(browser, folder / "report.html")
    browser.open(explorer.page)
    checks.that(explorer.data("state") is None, "the engine of a report waits until it is seen")
    browser.run("document.getElementById('what-if').scrollIntoView()")
    explorer.until("done")
    words = explorer.text("#what-if-readout")
    checks.that(f"{end:.4g} MGT" in words, "a report has the life of its run", words)
    checks.that("Recomputed here and now" in explorer.text("#what-if"), "and is marked as recomputed")
    browser.run("document.getElementById('what-if-contact-friction').focus()")
    browser.key("PageDown")
    explorer.until("done")
    checks.that("As at first" in explorer.text("#what-if-readout"), "another value has another life")
    checks.that(not browser.complaints, "report: the browser has nothing to complain about", str(browser.complaints)[:300])


def check_layout(explorer, checks, out):
    browser = explorer.browser
    for width in WIDTHS:
        for theme in ["light", "dark"]:
            explorer.open(width=width, theme=theme)
            if theme == "light":
                explorer.decided()
            beyond = browser.run(BEYOND)
            checks.that(not beyond, f"{width} px: nothing ends beyond the page", str(beyond)[:300])
            overlaps = browser.run(OVERLAPS)
            checks.that(not overlaps, f"{width} px: no text on text", str(overlaps)[:300])
            browser.picture(out / f"explorer-{width}-{theme}-screen.png")
            browser.picture(out / f"explorer-{width}-{theme}.png", "body")
    # On paper the page is light, and has the whole case file.
    explorer.open(theme="dark")
    browser.pdf(out / "explorer.pdf")
    browser.media(theme="dark", medium="print")
    ground = browser.run("getComputedStyle(document.body).backgroundColor")
    checks.that(ground == "rgb(255, 255, 255)", "the printed page is white", ground)
    checks.that(browser.run("document.getElementById('what-if-printed').innerText") == explorer.case(), "the whole case file is printed")
    checks.that(browser.run("document.getElementById('what-if-case').getClientRects().length === 0"), "and not the part in sight")
    browser.media()


def main():
    program, out, page, railcrack, run = sys.argv[1], Path(sys.argv[2]), sys.argv[3], sys.argv[4], Path(sys.argv[5])
    out.mkdir(parents=True, exist_ok=True)
    checks = Checks()
    browser = Browser(program)
    explorer = Explorer(browser, page)
    try:
        for check in [check_drag, print_speed, check_deciding, check_keys, check_typing, check_stop]:
            check(explorer, checks)
            checks.that(not browser.complaints, f"{check.__name__}: the browser has nothing to complain about", str(browser.complaints)[:300])
            foreign = [url for url in browser.requests if not url.startswith(("file:", "blob:", "data:"))]
            checks.that(not foreign, f"{check.__name__}: no request to anywhere", str(foreign))
        check_life(explorer, checks, railcrack)
        check_report(browser, checks, run)
        check_layout(explorer, checks, out)
    finally:
        browser.close()
    print(f"{checks.passed} passed, {checks.failed} failed")
    return 1 if checks.failed or not checks.passed else 0


if __name__ == "__main__":
    sys.exit(main())

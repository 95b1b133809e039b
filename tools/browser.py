"""A headless Chromium, driven through its DevTools protocol."""

import base64
import json
import os
import subprocess
import tempfile
import time
import urllib.request
from pathlib import Path

from websockets.sync.client import connect

KEYS = {"ArrowLeft": 37, "ArrowUp": 38, "ArrowRight": 39, "ArrowDown": 40, "Home": 36, "End": 35, "Tab": 9, " ": 32, "PageUp": 33, "PageDown": 34, "Escape": 27}


class Browser:
    """A browser with one page. What the page logs, throws and asks the network for is kept."""

    def __init__(self, program):
        self.profile = tempfile.TemporaryDirectory(prefix="railcrack-browser-", ignore_cleanup_errors=True)
        command = [program, "--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--hide-scrollbars",
                   "--remote-debugging-port=0", "--remote-allow-origins=*", f"--user-data-dir={self.profile.name}", "about:blank"]
        self.process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        port = self._port()
        with urllib.request.urlopen(f"http://127.0.0.1:{port}/json/list", timeout=30) as answer:
            pages = [target for target in json.load(answer) if target["type"] == "page"]
        self.socket = connect(pages[0]["webSocketDebuggerUrl"], max_size=None, compression=None)
        self.number = 0
        self.complaints = []
        self.loads = 0
        self.requests = []
        for domain in ["Runtime", "Log", "Page", "Network"]:
            self.send(f"{domain}.enable")

    def _port(self):
        path = Path(self.profile.name, "DevToolsActivePort")
        for _ in range(300):
            if self.process.poll() is not None:
                raise RuntimeError(f"the browser ended with {self.process.returncode}")
            if path.exists() and path.read_text().strip():
                return int(path.read_text().split()[0])
            time.sleep(0.1)
        raise RuntimeError("the browser did not open its port within 30 s")

    def close(self):
        self.socket.close()
        self.process.terminate()
        self.process.wait(timeout=30)
        self.profile.cleanup()

    def send(self, method, **parameters):
        """The result of a command; events that come before it are taken note of."""
        self.number += 1
        self.socket.send(json.dumps({"id": self.number, "method": method, "params": parameters}))
        while True:
            message = json.loads(self.socket.recv(timeout=120))
            if message.get("id") == self.number:
                if "error" in message:
                    raise RuntimeError(f"{method}: {message['error']}")
                return message["result"]
            self._event(message)

    def _event(self, message):
        method, about = message.get("method"), message.get("params", {})
        if method == "Runtime.exceptionThrown":
            details = about["exceptionDetails"]
            self.complaints.append(details.get("exception", {}).get("description", details["text"]))
        elif method == "Runtime.consoleAPICalled" and about["type"] in ("error", "warning", "assert"):
            self.complaints.append(" ".join(str(argument.get("value", argument.get("description"))) for argument in about["args"]))
        elif method == "Log.entryAdded" and about["entry"]["level"] in ("error", "warning"):
            self.complaints.append(about["entry"]["text"])
        elif method == "Page.loadEventFired":
            self.loads += 1
        elif method == "Network.requestWillBeSent":
            self.requests.append(about["request"]["url"][:200])

    def open(self, path, width=1280, height=900, theme="light"):
        """Loads the file at `path` in a window of this size; waits until its scripts have drawn."""
        self.complaints.clear()
        self.requests.clear()
        self.size(width, height)
        self.media(theme=theme)
        self.send("Page.navigate", url=Path(path).resolve().as_uri())
        self.until("document.readyState === 'complete'")
        self.until("!document.getElementById('explorer') || document.getElementById('explorer').dataset.ready === 'true' || document.querySelector('.failure')")
        self.until("!document.getElementById('row-map') || document.getElementById('row-map').dataset.ready === 'true' || document.querySelector('.failure')")
        self.until("!document.getElementById('study-table') || document.getElementById('study-table').dataset.ready === 'true' || document.querySelector('.failure')")
        self.until("!document.getElementById('neighbourhood') || document.getElementById('neighbourhood').dataset.ready === 'true' || document.querySelector('.failure')")
        self.settle()

    def open_plain(self, path):
        """Loads a page whose scripts do not run."""
        self.send("DOM.enable")
        before = self.loads
        self.send("Page.navigate", url=Path(path).resolve().as_uri())
        for _ in range(100):
            time.sleep(0.1)
            try:
                # The load event comes with the answer to a command.
                self.send("Page.getNavigationHistory")
            except RuntimeError:
                # Between two documents there is no page.
                continue
            if self.loads > before:
                return
        raise RuntimeError(f"{path} was not read within 10 s")

    def size(self, width, height):
        self.send("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)

    def media(self, theme="light", medium=""):
        self.send("Emulation.setEmulatedMedia", media=medium, features=[{"name": "prefers-color-scheme", "value": theme}])

    def run(self, expression):
        """The value of a JavaScript expression, promises waited for."""
        result = self.send("Runtime.evaluate", expression=expression, awaitPromise=True, returnByValue=True)
        if "exceptionDetails" in result:
            raise RuntimeError(f"{expression}: {result['exceptionDetails'].get('exception', {}).get('description')}")
        return result["result"].get("value")

    def until(self, condition, seconds=60):
        deadline = time.monotonic() + seconds
        while time.monotonic() < deadline:
            if self.run(f"Boolean({condition})"):
                return
            time.sleep(0.05)
        raise RuntimeError(f"not within {seconds} s: {condition}")

    def settle(self):
        """Two frames later everything that was asked for is drawn."""
        self.run("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(done, 30))))")

    def key(self, name, times=1):
        code = KEYS[name]
        for _ in range(times):
            about = {"key": name, "code": "Space" if name == " " else name, "windowsVirtualKeyCode": code}
            extra = {"text": " "} if name == " " else {}
            self.send("Input.dispatchKeyEvent", type="keyDown" if extra else "rawKeyDown", **about, **extra)
            self.send("Input.dispatchKeyEvent", type="keyUp", **about)
        self.settle()

    def mouse(self, x, y, click=False):
        self.send("Input.dispatchMouseEvent", type="mouseMoved", x=x, y=y)
        if click:
            for kind in ["mousePressed", "mouseReleased"]:
                self.send("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", clickCount=1)
        self.settle()

    def box(self, selector):
        """Left, top, width, height of an element in the window, scrolled into it."""
        return self.run(
            f"(() => {{ const e = document.querySelector({json.dumps(selector)}); e.scrollIntoView({{block: 'center'}});"
            " const b = e.getBoundingClientRect(); return [b.left, b.top, b.width, b.height]; })()")

    def picture(self, path, selector=None):
        """A screenshot of the window, or of the whole of an element."""
        options = {}
        if selector:
            left, top, width, height = self.run(
                f"(() => {{ const b = document.querySelector({json.dumps(selector)}).getBoundingClientRect();"
                " return [b.left + scrollX, b.top + scrollY, b.width, b.height]; })()")
            options = {"captureBeyondViewport": True, "clip": {"x": left, "y": top, "width": width, "height": height, "scale": 1}}
        data = self.send("Page.captureScreenshot", format="png", **options)["data"]
        Path(path).write_bytes(base64.b64decode(data))

    def pdf(self, path):
        Path(path).write_bytes(self.pdf_bytes())

    def pdf_bytes(self):
        """The page as a PDF file."""
        data = self.send("Page.printToPDF", printBackground=True, preferCSSPageSize=True, paperWidth=8.27, paperHeight=11.69)["data"]
        return base64.b64decode(data)

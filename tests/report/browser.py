"""A browser for tests: headless Chromium, driven by plain WebDriver over chromedriver on the loopback."""

import base64
import contextlib
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import urllib.error
import urllib.request

SKIPPED = 77
ELEMENT = "element-6066-11e4-a52e-4f735466cecf"
FLAGS = ["--headless=new", "--no-sandbox", "--disable-gpu", "--no-first-run", "--disable-background-networking",
         "--disable-component-update", "--disable-sync", "--hide-scrollbars", "--window-size=1280,900"]


class Browser:
    """One WebDriver session."""

    def __init__(self, port, chromium, profile):
        self.base = f"http://127.0.0.1:{port}"
        options = {"binary": chromium, "args": [*FLAGS, f"--user-data-dir={profile}"]}
        wanted = {"browserName": "chrome", "goog:chromeOptions": options, "goog:loggingPrefs": {"browser": "ALL"}}
        reply = self.send("POST", "/session", {"capabilities": {"alwaysMatch": wanted}})
        self.base += f"/session/{reply['sessionId']}"

    def send(self, method, path, body=None):
        content = None if body is None else json.dumps(body).encode()
        headers = {"Content-Type": "application/json"}
        request = urllib.request.Request(self.base + path, content, headers, method=method)
        opener = urllib.request.build_opener(urllib.request.ProxyHandler({}))
        try:
            with opener.open(request, timeout=60) as reply:
                return json.load(reply)["value"]
        except urllib.error.HTTPError as fault:
            raise RuntimeError(f"{method} {path}: {fault.read().decode()}") from fault

    def open(self, page):
        self.send("POST", "/url", {"url": page.as_uri()})

    def run(self, script, *arguments):
        return self.send("POST", "/execute/sync", {"script": script, "args": list(arguments)})

    def wait_for(self, script):
        """Waits until the script's promise is there, and gives its value."""
        body = {"script": f"const done = arguments[arguments.length - 1]; ({script}).then(done)", "args": []}
        return self.send("POST", "/execute/async", body)

    def find(self, selector):
        return self.send("POST", "/element", {"using": "css selector", "value": selector})[ELEMENT]

    def show(self, selector):
        """Scrolls the element out from under the bar that stays at the top."""
        self.run("document.querySelector(arguments[0]).scrollIntoView({block: 'center'})", selector)

    def click(self, selector):
        self.show(selector)
        self.send("POST", f"/element/{self.find(selector)}/click", {})

    def keys(self, selector, text):
        self.send("POST", f"/element/{self.find(selector)}/value", {"text": text})

    def drag(self, selector, offsets):
        """Presses at the first horizontal offset from the element's centre, moves over the others, lets go."""
        self.show(selector)
        origin = {ELEMENT: self.find(selector)}
        move = [{"type": "pointerMove", "duration": 50, "origin": origin, "x": x, "y": 0} for x in offsets]
        actions = [move[0], {"type": "pointerDown", "button": 0}, *move[1:], {"type": "pointerUp", "button": 0}]
        self.send("POST", "/actions", {"actions": [{"type": "pointer", "id": "mouse", "actions": actions}]})

    def act(self, *pointers):
        """Moves pointers together: each a kind, and steps of (x, y) from the stage's centre, or "down" and "up"."""
        origin = {ELEMENT: self.find("#stage")}
        sources = []
        for i, (kind, steps) in enumerate(pointers):
            actions = [{"type": {"down": "pointerDown", "up": "pointerUp"}[step], "button": 0} if isinstance(step, str)
                       else {"type": "pointerMove", "duration": 30, "origin": origin, "x": step[0], "y": step[1]}
                       for step in steps]
            sources.append({"type": "pointer", "id": f"{kind}{i}", "parameters": {"pointerType": kind}, "actions": actions})
        self.send("POST", "/actions", {"actions": sources})
        self.settle()

    def wheel(self, x, y, amount):
        wheel = {"type": "scroll", "x": x, "y": y, "deltaX": 0, "deltaY": amount, "origin": {ELEMENT: self.find("#stage")}}
        self.send("POST", "/actions", {"actions": [{"type": "wheel", "id": "wheel", "actions": [wheel]}]})
        self.settle()

    def press(self, keys):
        """Types keys at the images."""
        self.run("document.getElementById('stage').focus({preventScroll: true})")
        self.keys("#stage", keys)
        self.settle()

    def settle(self):
        """Until everything that was asked for is drawn, and the address is written."""
        self.wait_for("""new Promise((done) => setTimeout(() => requestAnimationFrame(() => requestAnimationFrame(done)), 250))""")

    def drawing(self, selector="#panes canvas"):
        """The PNG of an element as it is on the screen, without the cursor of a resting pointer."""
        self.show(selector)
        self.settle()
        self.run("closest.cursor = null; draw()")
        self.wait_for("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")
        return self.send("GET", f"/element/{self.find(selector)}/screenshot")

    def emulate(self, scheme):
        media = {"media": "", "features": [{"name": "prefers-color-scheme", "value": scheme}]}
        self.send("POST", "/goog/cdp/execute", {"cmd": "Emulation.setEmulatedMedia", "params": media})

    def resize(self, width, height):
        metrics = {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": False}
        self.send("POST", "/goog/cdp/execute", {"cmd": "Emulation.setDeviceMetricsOverride", "params": metrics})
        self.wait_for("new Promise((done) => setTimeout(() => requestAnimationFrame(done), 100))")

    def complaints(self):
        return [entry["message"] for entry in self.send("POST", "/se/log", {"type": "browser"})
                if entry["level"] in ("SEVERE", "WARNING")]

    def screenshot(self, file=None):
        """The window's PNG; the colours of a coarse grid over it, as the browser itself decodes them."""
        png = self.send("GET", "/screenshot")
        if file:
            file.write_bytes(base64.b64decode(png))
        return self.wait_for("""new Promise((done, failed) => {
          const image = new Image();
          image.onerror = () => failed(new Error('the screenshot is not an image'));
          image.onload = () => {
            const canvas = Object.assign(document.createElement('canvas'), {width: 160, height: 112});
            const context = canvas.getContext('2d');
            context.drawImage(image, 0, 0, 160, 112);
            const bytes = context.getImageData(0, 0, 160, 112).data;
            const colors = new Set();
            for (let i = 0; i < bytes.length; i += 4) colors.add(bytes.slice(i, i + 3).join());
            done([...colors]);
          };
          image.src = 'data:image/png;base64,%s';
        })""" % png)


@contextlib.contextmanager
def started_browser():
    chromium, driver = shutil.which("chromium"), shutil.which("chromedriver")
    if not chromium or not driver:
        print("skipped: the packages chromium and chromium-driver are not installed")
        sys.exit(SKIPPED)
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as home:
        environment = {**os.environ, "HOME": home, "XDG_CONFIG_HOME": home, "XDG_CACHE_HOME": home}
        process = subprocess.Popen([driver, "--port=0"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
                                   env=environment)
        browser = None
        try:
            greetings = (re.search(r"successfully on port (\d+)", line) for line in process.stdout)
            port = next(found[1] for found in greetings if found)
            browser = Browser(port, chromium, pathlib.Path(home) / "profile")
            yield browser
        finally:
            if browser:
                browser.send("DELETE", "")
            process.terminate()
            process.wait(timeout=20)

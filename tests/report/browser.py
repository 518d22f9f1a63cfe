"""A headless Chromium, driven through chromedriver's protocol (W3C WebDriver) with nothing but Python's own library."""
import json
import os
import re
import subprocess
import tempfile
import urllib.request

ELEMENT = "element-6066-11e4-a52e-4f735466cecf"  # the key of an element's identity, fixed by the standard
ARGUMENTS = ["--headless=new", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-sync",
             "--disable-background-networking", "--disable-component-update", "--disable-dev-shm-usage",
             "--window-size=1100,900"]


class Browser:
    """One session. Use as a context manager."""

    def __enter__(self):
        self._profile = tempfile.TemporaryDirectory()
        environment = {**os.environ, "HOME": self._profile.name}
        self._driver = subprocess.Popen(["chromedriver", "--port=0"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                                        text=True,
                                        env=environment)
        try:
            self._root = f"http://127.0.0.1:{self._port()}/session"
            options = {"args": [*ARGUMENTS, f"--user-data-dir={self._profile.name}/profile"]}
            wanted = {"browserName": "chrome", "goog:chromeOptions": options,
                      "goog:loggingPrefs": {"browser": "ALL", "performance": "ALL"}}
            session = self._request("POST", "", {"capabilities": {"alwaysMatch": wanted}})
        except BaseException:
            self._driver.kill()
            raise
        self._root += "/" + session["sessionId"]
        self.devtools("Browser.setDownloadBehavior", behavior="deny")
        return self

    def __exit__(self, *_):
        try:
            self._request("DELETE", "")
        finally:
            self._driver.terminate()
            self._driver.wait()
            self._driver.stdout.close()
            self._profile.cleanup()

    def _port(self):
        for line in self._driver.stdout:
            if found := re.search(r"started successfully on port (\d+)", line):
                return found[1]
        raise RuntimeError("chromedriver does not start")

    def _request(self, method, path, body=None):
        data = None if method != "POST" else json.dumps(body or {}).encode()
        request = urllib.request.Request(self._root + path, data=data, method=method,
                                         headers={"Content-Type": "application/json"})
        try:
            with urllib.request.urlopen(request, timeout=120) as answer:
                return json.load(answer)["value"]
        except urllib.error.HTTPError as error:
            raise RuntimeError(json.load(error)["value"]["message"]) from None

    def open(self, path):
        """The file, after its scripts have set themselves up; what was logged before is forgotten."""
        self.visit(path.resolve().as_uri())

    def visit(self, address):
        self.log("browser"), self.log("performance")
        self._request("POST", "/url", {"url": address})

    def run(self, script, *arguments):
        """What the body of a function returns; promises are waited for."""
        return self._request("POST", "/execute/sync", {"script": script, "args": arguments})

    def find(self, selector):
        return self._request("POST", "/element", {"using": "css selector", "value": selector})[ELEMENT]

    def click(self, selector):
        self._request("POST", f"/element/{self.find(selector)}/click")

    def type(self, selector, text):
        self._request("POST", f"/element/{self.find(selector)}/value", {"text": text})

    def drag(self, selector, places):
        """The pointer pressed at the first place, moved through the others and lifted; in pixels from the element's
        middle."""
        first, *others = self._moves(selector, places)
        self._point([first, {"type": "pointerDown", "button": 0}, *others, {"type": "pointerUp", "button": 0}])

    def move(self, selector, places):
        """The same without a button."""
        self._point(self._moves(selector, places))

    def _moves(self, selector, places):
        origin = {ELEMENT: self.find(selector)}
        return [{"type": "pointerMove", "duration": 1, "origin": origin, "x": x, "y": y} for x, y in places]

    def _point(self, steps):
        self._request("POST", "/actions",
                      {"actions": [{"type": "pointer", "id": "mouse", "parameters": {"pointerType": "mouse"},
                                    "actions": steps}]})

    def log(self, kind):
        return self._request("POST", "/se/log", {"type": kind})

    def devtools(self, command, **parameters):
        return self._request("POST", "/goog/cdp/execute", {"cmd": command, "params": parameters})

    def requested(self):
        """Addresses asked for since the page was opened, the page's own and data: left out."""
        messages = [json.loads(entry["message"])["message"] for entry in self.log("performance")]
        asked = [m["params"]["request"]["url"] for m in messages if m["method"] == "Network.requestWillBeSent"]
        own = self.run("return location.href")
        return [url for url in asked if url != own and not url.startswith(("data:", "blob:"))]

"""Pages as browsers show them, offline: in a process one browser of a kind, and one tab for each kind of window."""

import chromium

QUIET = [
    "--no-sandbox", "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update",
    "--disable-sync",
]  # fmt: skip
#: A page of text is painted without graphics; WebGL without a graphics card takes three times as long for one.
PLAIN = [*QUIET, "--disable-gpu", "--disable-3d-apis"]
WEBGL = [
    *QUIET, "--disable-accelerated-2d-canvas", "--disable-gpu-rasterization",
    "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
]  # fmt: skip
DESK, PHONE = {"width": 1280, "height": 900}, {"width": 390, "height": 844}
SIZES = {"desk": DESK, "phone": PHONE}


class Shown:
    """A tab with everything that its console and the network said, and the pages it was sent to."""

    def __init__(self, browser, **options):
        self.tab = browser.new_context(**{"offline": True, **options}).new_page()
        self.tab.set_default_timeout(chromium.PATIENCE)
        self.said, self.paths = [], []
        self.tab.on("console", lambda message: self.said.append(message.text))
        self.tab.on("pageerror", lambda error: self.said.append(str(error)))
        self.tab.on("request", lambda request: self.said.append(request.url))

    def load(self, path):
        """Loads a page afresh: nothing is left of what was done to it before."""
        self.paths.append(path.as_uri())
        self.tab.goto("about:blank")
        self.tab.goto(path.as_uri())
        self.drawn()

    def leave(self):
        """What was said or asked for other than the pages and the data: URLs in them; nothing moves any more."""
        self.tab.goto("about:blank")
        found = [text for text in self.said if text not in self.paths and not text.startswith("data:")]
        self.said, self.paths = [], []
        return found

    def drawn(self, frame=None):
        """Waits for two frames of the browser, of a part of the page that draws by itself."""
        (frame or self.tab).evaluate("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")

    def ask(self, text, *given):
        """What an expression of the page is."""
        return self.tab.evaluate(text, *given)

"""The picture of the page on which the bowling ball rolls: `make pictures` runs this; it needs Chromium."""

import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from playwright.sync_api import sync_playwright

DOCS = Path(__file__).parents[1]
#: The window in pixels, and the time that it shows, of the whole.
SIZE, SHOWN = {"width": 1000, "height": 560}, 0.3

with tempfile.TemporaryDirectory() as folder, sync_playwright() as driver:
    scene = DOCS / "scenes" / "bowling.toml"
    subprocess.run([sys.executable, "-m", "chapsym", "show", scene, "-o", folder], check=True)
    flags = ["--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
    page = driver.chromium.launch(executable_path=shutil.which("chromium"), args=flags).new_page(viewport=SIZE)
    page.emulate_media(reduced_motion="reduce")
    page.goto(Path(folder, "page.html").as_uri())
    page.evaluate(f"{{ const {{ motion, seek }} = window.chapsym; seek(motion.frameAt({SHOWN} * motion.end)); }}")
    page.get_by_role("button", name="Follow").click()
    page.wait_for_timeout(500)
    page.screenshot(path=DOCS / "pictures" / "bowling" / "page.png")

"""Pages of scantet in headless Chromium. It draws WebGL in software here, so this needs neither display nor graphics card."""
import argparse
import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from selenium import webdriver
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.by import By

SOFTWARE_WEBGL = ("--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist")
HOSTILE_NAME = "<img src=x onerror=hacked()><script>hacked()<b>.vtu"
WAIT_S = 20

# How many pixels of the canvas differ from the empty corner, how many colours it has, and a checksum of all of it.
# Reads the drawing buffer, which the page keeps.
PICTURE = """
  const canvas = document.getElementById("view");
  const flat = document.createElement("canvas");
  flat.width = canvas.width;
  flat.height = canvas.height;
  const context = flat.getContext("2d");
  context.drawImage(canvas, 0, 0);
  const pixels = new Uint32Array(context.getImageData(0, 0, flat.width, flat.height).data.buffer);
  const colors = new Set(pixels);
  let drawn = 0, sum = 0;
  for (const pixel of pixels) {
    if (pixel !== pixels[0]) ++drawn;
    sum = (Math.imul(sum, 31) + pixel) | 0;
  }
  return {share: drawn / pixels.length, colors: colors.size, sum};
"""


def start_browser(tools, *flags):
    options = Options()
    options.binary_location = tools.chromium
    for flag in ("--headless=new", "--disable-dev-shm-usage", "--window-size=1000,700", *flags):
        options.add_argument(flag)
    if os.geteuid() == 0:
        options.add_argument("--no-sandbox")  # Chromium refuses to run as root otherwise
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    return webdriver.Chrome(service=Service(tools.driver), options=options)


class BrowserTest(unittest.TestCase):
    """Has meshes and their pages in a folder, and a browser."""

    tools = None  # argparse.Namespace: the programs

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="scantet_browser_")
        sphere = str(Path(cls.tools.samples) / "sphere.nrrd")
        cls.run_scantet("mesh", sphere, "--level", "127.5", "--size", "2.5", "-o", "fine.vtu", "--report", "run.html")
        cls.run_scantet("mesh", sphere, "--level", "127.5", "--size", "4", "-o", HOSTILE_NAME)
        cls.run_scantet("report", "fine.vtu", HOSTILE_NAME, "--report", "two.html")
        cls.browser = start_browser(cls.tools, *SOFTWARE_WEBGL)

    @classmethod
    def tearDownClass(cls):
        cls.browser.quit()
        cls.folder.cleanup()

    @classmethod
    def run_scantet(cls, *arguments, check=True):
        subprocess.run([cls.tools.scantet, *arguments], cwd=cls.folder.name, check=check, stdout=subprocess.DEVNULL,
                       stderr=subprocess.DEVNULL)

    def open(self, name, browser=None):
        browser = browser or self.browser
        browser.get_log("performance")  # what other pages did
        browser.get_log("browser")
        browser.get((Path(self.folder.name) / name).as_uri())
        if browser is self.browser:
            self.settle()

    def tearDown(self):
        self.assertEqual(self.browser.get_log("browser"), [], "the console stays silent")

    def script(self, text):
        return self.browser.execute_script(text)

    def camera(self):
        return self.script("return page.view.camera.position.toArray()")

    def settle(self):
        """Waits until the camera stands still and the picture of it is drawn."""
        self.browser.set_script_timeout(WAIT_S)
        self.browser.execute_async_script("""
          const done = arguments[0];
          let last = null;
          const look = () => {
            const now = page.view.camera.position.toArray().join() + page.view.waiting;
            if (now === last && !page.view.waiting) return done();
            last = now;
            setTimeout(look, 60);
          };
          look();
        """)

    def element(self, selector):
        return self.browser.find_element(By.CSS_SELECTOR, selector)

    def looked_at_mm(self):
        return self.script("""
          const {center_mm, scale_mm} = page.geometry;
          return page.view.orbit.target.toArray().map((x, axis) => center_mm[axis] + scale_mm * x);
        """)

    def cut_and_open_edges(self, axis, at, side, shown=None):
        """Cuts the mesh, of which the regions marked in `shown` are shown. Tets that the cut meets, and edges where what
        encloses the tets that are left (faces of the cut, boundary beside it) is open: in which an odd number of faces lie."""
        return self.script(f"""
          const g = page.view.geometry;
          if ({json.dumps(shown)} !== null) g.shown.set({json.dumps(shown)});
          const seen = cut_faces(g, {axis}, {at}, {side});
          const edges = new Map();
          const add = (a, b, c) => {{
            for (const [p, q] of [[a, b], [b, c], [c, a]]) {{
              const key = Math.min(p, q) * g.vertices + Math.max(p, q);
              edges.set(key, (edges.get(key) || 0) + 1);
            }}
          }};
          for (let i = 0; i < seen.faces.length; i += 3) add(...seen.faces.slice(i, i + 3));
          for (let f = 0; f < g.facets.length / 3; ++f) {{
            const face = g.facets.subarray(3 * f, 3 * f + 3);
            if (open_side(g, f) >= 0 && face.every((v) => g.kept[v])) add(...face);
          }}
          return [seen.tets.length, [...edges.values()].filter((n) => n % 2 === 1).length];
        """)

    def shown_area(self):
        """Of the surface drawn, whether or not the plane takes some of it away, in mm²."""
        return self.script("""
          const p = page.view.surface.geometry.attributes.position.array;
          let area = 0;
          for (let i = 0; i < p.length; i += 9) {
            const [a, b, c] = [0, 3, 6].map((k) => new THREE.Vector3(p[i + k], p[i + k + 1], p[i + k + 2]));
            area += b.sub(a).cross(c.sub(a)).length() / 2;
          }
          return area * page.geometry.scale_mm ** 2;
        """)


def run_tests(tests, about):
    """Runs the tests of one class with the programs that the command line names. about: the first line says what they are."""
    parser = argparse.ArgumentParser(description=about.splitlines()[0])
    for tool in ("scantet", "samples", "chromium", "driver"):
        parser.add_argument(f"--{tool}", required=True)
    tests.tools, rest = parser.parse_known_args()
    unittest.main(argv=sys.argv[:1] + rest)

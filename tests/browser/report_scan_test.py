"""What the page of a report shows of the scan under the mesh, and of regions, in a real browser.

    report_scan_test.py --scantet PROGRAM --samples FOLDER --chromium PROGRAM --driver PROGRAM [unittest option...]
"""
from pathlib import Path

from selenium.webdriver.common.by import By

from browser_test import BrowserTest, PICTURE, run_tests


class ReportScan(BrowserTest):
    def test_shows_the_mesh_over_the_scan(self):
        sheared = str(Path(self.tools.samples) / "ellipsoid_sheared.nrrd")
        self.run_scantet("mesh", sheared, "--level", "0.5", "--size", "2", "-o", "sheared.vtu", "--certify", "--report", "sheared.html")
        self.open("sheared.html")
        self.assertEqual(self.element("#certificate-grade").text, "certified")
        self.assertIn("facets have a collar", self.element("#certificate-text").text)
        self.assertEqual(len(self.browser.find_elements(By.CSS_SELECTOR, "#slices canvas")), 3)
        self.assertIn("distance from the level set", self.element("#coloring").text)
        drawn = """
          const {canvas} = page.slices.parts[arguments[0]];
          const context = Object.assign(document.createElement("canvas"), {width: canvas.width, height: canvas.height}).getContext("2d");
          context.drawImage(canvas, 0, 0);
          const {data, width, height} = context.getImageData(0, 0, context.canvas.width, context.canvas.height);
          let blue = 0, orange = 0, far = 0;
          const at = [];
          for (let i = 0; i < data.length; i += 4) {
            if (data[i] < 80 && data[i + 2] > 200) { ++blue; at.push([i / 4 % width, Math.floor(i / 4 / width)]); }
            if (data[i] > 200 && data[i + 1] > 120 && data[i + 2] < 60) {
              ++orange;
              const x = i / 4 % width, y = Math.floor(i / 4 / width);
              if (arguments[1] && !arguments[1].some(([u, v]) => Math.hypot(u - x, v - y) < 9)) ++far;
            }
          }
          return {blue, orange, far, at};
        """
        wait = """
          const done = arguments[0];
          const look = () => page.slices.waiting ? setTimeout(look, 30) : done();
          look();
        """
        self.browser.execute_async_script(wait)
        for part in range(3):
            mesh = self.browser.execute_script(drawn, part)
            self.assertGreater(mesh["blue"], 100, f"the mesh is on slice {part}")
            self.script('document.getElementById("slices-mesh").click()')
            self.browser.execute_async_script(wait)
            level = self.browser.execute_script(drawn, part, mesh["at"])
            self.assertGreater(level["orange"], 100, f"the level set is on slice {part}")
            self.assertLess(level["blue"], 0.1 * mesh["blue"])
            self.assertLess(level["far"], 0.01 * level["orange"], "both are at the same place")
            self.script('document.getElementById("slices-mesh").click()')
            self.browser.execute_async_script(wait)
        there_and_back = self.script("const s = page.slices.scan; return s.to_world(s.to_index([3, -5, 7]))")
        for x, expected in zip(there_and_back, (3, -5, 7)):
            self.assertAlmostEqual(x, expected, 9)
        before = self.script("return page.slices.at")
        self.script('document.querySelector("#certificate-places button").click()')
        after = self.script("return page.slices.at")
        self.assertNotEqual(before, after, "a click on a place goes there")
        place = self.script("return page.mesh.report.certificate.mesh_to_level.lower_place")
        for x, expected in zip(self.script("return page.slices.scan.to_world(page.slices.at)"), place):
            self.assertAlmostEqual(x, expected, 6)
        self.script("page.slices.parts[0].canvas.dispatchEvent(new WheelEvent('wheel', {deltaY: 1}))")
        self.assertEqual(self.script("return page.slices.at[2]"), round(after[2]) + 1)

    def test_shows_certificates_without_collars(self):
        samples = Path(self.tools.samples)
        self.run_scantet("mesh", str(samples / "labels_octants.nrrd"), "--labels", "all", "--size", "3", "-o", "labels.vtu",
                         "--certify", "bounded", "--report", "labels.html")
        self.open("labels.html")
        self.assertEqual(self.element("#certificate-grade").text, "bounded")
        self.assertIn("mesh to field at most", self.element("#certificate-text").text)
        self.assertIn("field's outline, voxels' fronts", self.element("#slices-form").text)
        # Where the field's outline is on a slice, the mesh's boundary is: between the voxels, not on their sides.
        lengths, apart, off = self.script("""
          const {scan, geometry, index, parts} = page.slices;
          const part = parts[0], layer = Math.floor(scan.size[2] / 3);
          const mesh = [];
          for (let f = 0; f < geometry.facets.length; f += 3) {
            for (let i = 0; i < 3; ++i) {
              const [a, b] = [geometry.facets[f + i], geometry.facets[f + (i + 1) % 3]];
              const [za, zb] = [index[3 * a + 2] - layer, index[3 * b + 2] - layer];
              if (za < 0 === zb < 0) continue;
              mesh.push([0, 1].map((k) => index[3 * a + k] + za / (za - zb) * (index[3 * b + k] - index[3 * a + k])));
            }
          }
          let count = 0, apart = 0, off = 0;
          const voxel = (u, v) => part.index_of(u, v, layer);
          for (let v = 0; v + 1 < scan.size[1]; ++v) {
            for (let u = 0; u + 1 < scan.size[0]; ++u) {
              for (const line of scan.outline_in([voxel(u, v), voxel(u + 1, v), voxel(u, v + 1), voxel(u + 1, v + 1)])) {
                const p = [u + (line[0][0] + line[1][0]) / 2, v + (line[0][1] + line[1][1]) / 2];
                ++count;
                if (Math.min(...p.map((x) => Math.abs(x - Math.floor(x) - 0.5))) > 0.02) ++off;
                if (count % 9 === 0 && !mesh.some((q) => Math.hypot(p[0] - q[0], p[1] - q[1]) < 2.5)) ++apart;
              }
            }
          }
          return [count, apart, off];
        """)
        self.assertGreater(lengths, 200)
        self.assertEqual(apart, 0, "the outline is where the mesh's boundary is")
        self.assertGreater(off, 20, "it is not that of the voxels")
        self.assertNotIn("grey", self.element("#slices-form").text)
        self.assertEqual(self.script("return page.slices.scan.regions"), list(range(9)))
        dimmed = self.browser.execute_async_script("""
          const done = arguments[0];
          for (const id of ["mesh", "level"]) document.getElementById(`slices-${id}`).click();
          page.slices.scroll(2, Math.floor(page.slices.scan.size[2] / 3));
          const look = () => {
            if (page.slices.waiting) return setTimeout(look, 30);
            const {canvas} = page.slices.parts[0];
            const {data} = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
            const wanted = page.slices.voxel_colors.map((color) => [...new Uint8ClampedArray(color)].join());
            const seen = new Set();
            for (let i = 0; i < data.length; i += 4) seen.add([data[i], data[i + 1], data[i + 2]].join());
            done(wanted.filter((color) => seen.has(color)).length);
          };
          look();
        """)
        self.assertEqual(dimmed, 5, "four octants and the background are on a slice")
        self.run_scantet("mesh", str(samples / "sphere.nrrd"), "--level", "127.5", "-o", "ball.stl")
        self.run_scantet("mesh", "ball.stl", "--size", "3", "-o", "ball.vtu", "--certify", "bounded", "--report", "ball.html")
        self.open("ball.html")
        self.assertEqual(self.element("#certificate-grade").text, "bounded")
        self.assertIn("surface to mesh at most", self.element("#certificate-text").text)
        self.assertIn("distance from the surface", self.element("#coloring").text)
        self.assertGreater(len(self.browser.find_elements(By.CSS_SELECTOR, "#certificate-places button")), 1)

    def test_regions_are_hidden_and_looked_at_alone(self):
        self.run_scantet("mesh", str(Path(self.tools.samples) / "labels_octants.nrrd"), "--labels", "1-4", "--size", "3",
                         "--optimize", "none", "--report", "regions.html", check=False)
        self.open("regions.html")
        boxes = self.browser.find_elements(By.CSS_SELECTOR, "#regions input")
        self.assertEqual(len(boxes), 4)
        self.assertIn("mm³, voxels 512", self.element("#regions").text)
        self.assertEqual(self.element("#coloring").get_attribute("value"), "region")
        self.assertFalse(self.element("#scale").is_displayed(), "regions have no scale")
        pictures = [self.script(PICTURE)["sum"]]
        shown = [self.shown_area()]
        boxes[0].click()
        self.settle()
        pictures.append(self.script(PICTURE)["sum"])
        shown.append(self.shown_area())
        self.assertEqual(self.script("return Array.from(page.geometry.shown)"), [0, 1, 1, 1])
        alone = self.browser.find_elements(By.CSS_SELECTOR, "#regions li button")[1]
        alone.click()
        self.settle()
        pictures.append(self.script(PICTURE)["sum"])
        self.assertEqual(self.script("return Array.from(page.geometry.shown)"), [0, 1, 0, 0])
        self.assertEqual(alone.get_attribute("aria-pressed"), "true")
        area = self.script("return page.mesh.report.regions.find((r) => r.region === 2).area_mm2")
        self.assertAlmostEqual(self.shown_area() / area, 1, 3, "its whole boundary is seen")
        self.element("#coloring option[value='min_dihedral_deg']").click()
        self.settle()
        pictures.append(self.script(PICTURE)["sum"])
        self.assertTrue(self.element("#scale").is_displayed())
        alone.click()
        self.settle()
        pictures.append(self.script(PICTURE)["sum"])
        self.assertEqual(self.script("return Array.from(page.geometry.shown)"), [1, 1, 1, 1])
        self.browser.find_elements(By.CSS_SELECTOR, "#regions > button")[1].click()
        self.settle()
        self.assertEqual(self.shown_area(), 0)
        self.assertEqual(len(set(pictures)), 5, "each change is seen")

    def test_cut_of_some_regions_is_closed(self):
        """What is shown of a mesh with hidden regions is closed, too."""
        self.run_scantet("mesh", str(Path(self.tools.samples) / "labels_octants.nrrd"), "--labels", "1-4", "--size", "3",
                         "--optimize", "none", "--report", "some.html", check=False)
        self.open("some.html")
        tets, open_edges = self.cut_and_open_edges(0, -0.2, 1, shown=[1, 0, 1, 0])
        self.assertGreater(tets, 20)
        self.assertEqual(open_edges, 0)


if __name__ == "__main__":
    run_tests(ReportScan, __doc__)

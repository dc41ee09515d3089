"""The page that `scantet ... --report FILE.html` writes, used in a real browser, offline.

    report_page_test.py --scantet PROGRAM --samples FOLDER --chromium PROGRAM --driver PROGRAM [unittest option...]
"""
import argparse
import json
import sys
import unittest
from pathlib import Path

from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

from browser_test import BrowserTest, HOSTILE_NAME, PICTURE, start_browser


class ReportPage(BrowserTest):
    def test_tells_what_was_dropped(self):
        self.run_scantet("mesh", str(Path(self.tools.samples) / "islands.nii.gz"), "--level", "60", "--size", "1",
                         "--components", "2", "--report", "dropped.html")
        self.open("dropped.html")
        self.assertIn("198 of 200 components, the largest of them 3 mm³", self.element("#summary").text)
        self.assertIn("Largest components dropped", self.element("#details").get_attribute("textContent"))

    def test_shows_the_mesh(self):
        self.open("run.html")
        picture = self.script(PICTURE)
        self.assertGreater(picture["share"], 0.1, "the picture is not blank")
        self.assertGreater(picture["colors"], 50)
        self.assertIn("audit passed", self.element("#verdict").text)
        summary = self.element("#summary").text
        for label in ("tetrahedra", "volume", "level", "127.5", "size asked for", "2.5 mm", "shortest edge", "least height",
                      "1,500 m/s", "dihedral angles", "topology", "no handles", "circumradius / size", "rules", "time"):
            self.assertIn(label, summary)
        self.assertEqual(len(self.browser.find_elements(By.CSS_SELECTOR, "#charts figure")), 12)
        self.assertTrue(self.element("#view-notice").get_attribute("hidden"))

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

    def test_asks_nothing_of_the_network(self):
        self.open("run.html")
        asked = []
        for entry in self.browser.get_log("performance"):
            message = json.loads(entry["message"])["message"]
            if message["method"] == "Network.requestWillBeSent":
                asked.append(message["params"]["request"]["url"])
        self.assertEqual(asked, [(Path(self.folder.name) / "run.html").as_uri()])
        self.assertEqual(self.script("return performance.getEntriesByType('resource').length"), 0)

    def test_plane_moves(self):
        self.open("run.html")
        pictures = {self.script(PICTURE)["sum"]}
        self.element("#position").send_keys(Keys.PAGE_UP)
        self.settle()
        pictures.add(self.script(PICTURE)["sum"])
        for selector in ("#axis input[value='1']", "#flip", "#axis input[value='2']", "#edges"):
            self.element(selector).click()
            self.settle()
            pictures.add(self.script(PICTURE)["sum"])
        self.assertEqual(len(pictures), 6, "each change is seen")

    def test_cut_is_closed(self):
        """Boundary left of the plane and coloured faces enclose the tets that are shown: every edge lies in two faces."""
        self.open("run.html")
        odd = self.script("""
          const g = page.view.geometry;
          const odd = [];
          for (const [axis, at, side] of [[0, 0.1, 1], [0, 0.1, -1], [1, -0.2, 1], [2, 0.05, -1], [2, 0.3, 1]]) {
            const seen = cut_faces(g, axis, at, side);
            const edges = new Map();
            const add = (a, b, c) => {
              for (const [p, q] of [[a, b], [b, c], [c, a]]) {
                const key = Math.min(p, q) * g.vertices + Math.max(p, q);
                edges.set(key, (edges.get(key) || 0) + 1);
              }
            };
            for (let i = 0; i < seen.faces.length; i += 3) add(...seen.faces.slice(i, i + 3));
            for (let i = 0; i < g.facets.length; i += 3) {
              const face = g.facets.subarray(i, i + 3);
              if (face.every((v) => g.kept[v])) add(...face);
            }
            odd.push([seen.tets.length, [...edges.values()].filter((n) => n % 2 === 1).length]);
          }
          return odd;
        """)
        for faces, open_edges in odd:
            self.assertGreater(faces, 20)
            self.assertEqual(open_edges, 0)

    def test_worst_tet_is_one_click_away(self):
        self.open("run.html")
        before, picture = self.camera(), self.script(PICTURE)
        self.element("#worst button").click()
        self.settle()
        self.assertNotEqual(self.camera(), before)
        self.assertNotEqual(self.script(PICTURE)["sum"], picture["sum"])
        place = self.script("return page.mesh.report.quality.worst.min_dihedral_deg[0].place_mm")
        looked_at = self.looked_at_mm()
        cut_at = self.script("return page.geometry.center_mm[0] + page.geometry.scale_mm * page.view.cut_at.position")
        for wanted, found in zip(place, looked_at):
            self.assertAlmostEqual(wanted, found, 4)
        self.assertAlmostEqual(place[0], cut_at, 4, "the plane goes through it")
        self.assertIn("smallest dihedral angle", self.element("#picked").text)
        self.element("#reset").click()
        self.settle()
        for wanted, found in zip(before, self.camera()):
            self.assertAlmostEqual(wanted, found, 4)

    def test_every_worst_list_tells_its_tets_apart(self):
        self.open("run.html")
        worst = self.script("return page.mesh.report.quality.worst")
        keys = [option.get_attribute("value") for option in self.browser.find_elements(By.CSS_SELECTOR, "#worst-by option")]
        self.assertEqual(sorted(keys), sorted(worst))
        for key in keys:
            self.element(f"#worst-by option[value='{key}']").click()
            buttons = self.browser.find_elements(By.CSS_SELECTOR, "#worst button")
            shown = [button.find_element(By.CSS_SELECTOR, "span").text for button in buttons]
            values = [f"{tet['value']:.8g}" for tet in worst[key]]
            self.assertEqual(len(set(shown)), len(set(values)), f"{key}: {shown}")
            for button, tet in zip(buttons, worst[key]):
                self.assertIn(f"tet {tet['tet']}", button.text)
            buttons[-1].click()
            self.settle()
            for wanted, found in zip(worst[key][-1]["place_mm"], self.looked_at_mm()):
                self.assertAlmostEqual(wanted, found, 4, key)
        self.assertEqual(len(self.browser.find_elements(By.CSS_SELECTOR, "#worst button[aria-pressed=true]")), 1)

    def test_digits_tell_close_values_apart(self):
        self.open("run.html")
        texts = self.script("return told_apart([10.00001, 10.00002, 10.5, 12345.678])")
        self.assertEqual(texts, ["10.00001", "10.00002", "10.50000", "12345.68"])
        self.assertEqual(self.script("return told_apart([2, 2, 3])"), ["2", "2", "3"], "equal ones cannot be told apart")
        self.assertEqual(self.script("return told_apart([1/3, 1/3 + 1e-14])"), ["0.33333333"] * 2, "nor what is rounding")

    def test_components_and_cavities_are_one_click_away(self):
        self.run_scantet("mesh", str(Path(self.tools.samples) / "shell.mha"), "--level", "1000.5", "--inside", "below", "--size", "2",
                         "--report", "shell.html")
        self.open("shell.html")
        buttons = self.browser.find_elements(By.CSS_SELECTOR, "#parts button")
        self.assertEqual([button.find_element(By.CSS_SELECTOR, "span").text for button in buttons], ["component", "cavity"])
        self.assertIn("surfaces of genus 0, 0: no handles", buttons[0].text)
        self.assertIn("genus 0: no handles", buttons[1].text)
        picture = self.script(PICTURE)["sum"]
        buttons[1].click()
        self.settle()
        box = self.script("return page.mesh.report.topology.cavity_list[0].box_mm")
        for low, high, found in zip(box["min"], box["max"], self.looked_at_mm()):
            self.assertAlmostEqual((low + high) / 2, found, 4)
        self.assertNotEqual(self.script(PICTURE)["sum"], picture)
        self.assertIn("cavity, 11,", self.element("#picked").text)

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
        odd = self.script("""
          const g = page.view.geometry;
          g.shown.set([1, 0, 1, 0]);
          const seen = cut_faces(g, 0, -0.2, 1);
          const edges = new Map();
          const add = (a, b, c) => {
            for (const [p, q] of [[a, b], [b, c], [c, a]]) {
              const key = Math.min(p, q) * g.vertices + Math.max(p, q);
              edges.set(key, (edges.get(key) || 0) + 1);
            }
          };
          for (let i = 0; i < seen.faces.length; i += 3) add(...seen.faces.slice(i, i + 3));
          for (let f = 0; f < g.facets.length / 3; ++f) {
            const face = g.facets.subarray(3 * f, 3 * f + 3);
            if (open_side(g, f) >= 0 && face.every((v) => g.kept[v])) add(...face);
          }
          return [seen.tets.length, [...edges.values()].filter((n) => n % 2 === 1).length];
        """)
        self.assertGreater(odd[0], 20)
        self.assertEqual(odd[1], 0)

    def test_handles_are_told_in_words(self):
        self.run_scantet("mesh", str(Path(self.tools.samples) / "torus.nrrd"), "--level", "300.5", "--size", "4",
                         "--report", "torus.html")
        self.open("torus.html")
        self.assertIn("Euler number 0 (one handle in 1 surface)", self.element("#summary").text)
        self.assertIn("genus 1: one handle", self.element("#parts").text)

    def test_marks_say_where_the_axes_point(self):
        self.open("run.html")
        ends = """
          const ends = {};
          for (const text of document.querySelectorAll("#marks text")) {
            ends[text.textContent] = [Number(text.getAttribute("x")), Number(text.getAttribute("y"))];
          }
          return ends;
        """
        marks = self.script(ends)
        self.assertEqual(sorted(marks), ["A", "I", "L", "P", "R", "S"])
        # What the camera sees of a step along each axis, from the middle of the picture; y of the picture runs down.
        for axis, (back, ahead) in enumerate(("RL", "AP", "IS")):
            seen = self.script(f"""
              const step = page.view.orbit.target.clone();
              step.setComponent({axis}, step.getComponent({axis}) + 0.1);
              return step.project(page.view.camera).toArray();
            """)
            self.assertGreater(seen[0] * marks[ahead][0] - seen[1] * marks[ahead][1], 0, ahead)
            self.assertAlmostEqual(marks[back][0], -marks[ahead][0], 9)
            self.assertAlmostEqual(marks[back][1], -marks[ahead][1], 9)
        self.element("#view").send_keys(Keys.ARROW_LEFT)
        self.settle()
        self.assertNotEqual(self.script(ends), marks, "they turn with the mesh")

    def test_keys_and_colours(self):
        self.open("run.html")
        before, picture = self.camera(), self.script(PICTURE)
        self.element("#view").send_keys(Keys.ARROW_LEFT, Keys.ARROW_UP, "+")
        self.settle()
        self.assertNotEqual(self.camera(), before)
        turned = self.script(PICTURE)["sum"]
        self.assertNotEqual(turned, picture["sum"])
        self.element("#coloring option[value='radius_edge']").click()
        self.settle()
        self.assertNotEqual(self.script(PICTURE)["sum"], turned)
        self.assertEqual(self.element("#scale-high").text, "2")
        pictures = {turned, self.script(PICTURE)["sum"]}
        for key in ("min_edge_length_mm", "min_height_mm", "scaled_jacobian", "largest_dihedral_deg"):
            self.element(f"#coloring option[value='{key}']").click()
            self.settle()
            pictures.add(self.script(PICTURE)["sum"])
        self.assertEqual(len(pictures), 6, "each measure is seen")

    def test_several_meshes_and_hostile_names(self):
        self.open("two.html")
        options = [option.text for option in self.browser.find_elements(By.CSS_SELECTOR, "#mesh-select option")]
        self.assertEqual(options, ["fine.vtu", HOSTILE_NAME], "a name is text, and no script (the console would tell)")
        self.assertEqual(len(self.browser.find_elements(By.CSS_SELECTOR, "img, b:not(footer b)")), 0)
        self.assertEqual(len(self.browser.find_elements(By.CSS_SELECTOR, "#charts figure:first-child path.curve")), 2)
        first = self.script("return page.geometry.tets")
        picture = self.script(PICTURE)["sum"]
        self.element("#mesh-select option[value='1']").click()
        self.settle()
        self.assertLess(self.script("return page.geometry.tets"), first)
        self.assertNotEqual(self.script(PICTURE)["sum"], picture)

    def test_difference_of_two_meshes(self):
        self.run_scantet("diff", "fine.vtu", HOSTILE_NAME, "--report", "diff.html", check=False)
        self.open("diff.html")
        self.assertIn("different: ", self.element("#difference-verdict").text)
        table = self.element("#difference").text
        for label in ("vertices", "volume, mm^3", "farthest from the other's boundary", "smallest dihedral angle", "made by"):
            self.assertIn(label, table)
        self.assertEqual(self.script("return page.view.coloring.key"), "distance_mm")
        self.assertGreater(self.script("return Math.max(...page.view.coloring.values)"), 200)
        by_distance = self.script(PICTURE)
        self.script("""const select = document.getElementById("coloring");
                       select.value = "min_dihedral_deg"; select.dispatchEvent(new Event("change"));""")
        self.settle()
        self.assertNotEqual(self.script(PICTURE)["sum"], by_distance["sum"])
        self.script("""const select = document.getElementById("mesh-select");
                       select.value = 1; select.dispatchEvent(new Event("change"));""")
        self.settle()
        self.assertEqual(self.script("return page.view.coloring.values.length"),
                         self.script("return page.geometry.facets.length / 3"))
        self.assertGreater(self.script(PICTURE)["share"], 0.1)

    def test_mesh_too_large_shows_its_boundary(self):
        self.open("run.html")
        # As the writer leaves a mesh of more than four million tets: some of the tets, with their numbers.
        self.script("""
          const about = page.data.meshes[0].geometry;
          about.numbers = Array.from({length: about.tets}, (_, i) => i);
          page.choose(0);
        """)
        self.settle()
        self.assertIn("too many", self.element("#view-notice").text)
        self.assertGreater(self.script(PICTURE)["share"], 0.1)
        before = self.script(PICTURE)["sum"]
        self.element("#worst button").click()
        self.settle()
        self.assertNotEqual(self.script(PICTURE)["sum"], before)

    def test_without_webgl_the_rest_is_there(self):
        browser = start_browser(self.tools, "--disable-3d-apis")
        try:
            self.open("run.html", browser)
            notice = browser.find_element(By.CSS_SELECTOR, "#view-notice")
            self.assertIn("WebGL", notice.text)
            self.assertIn("tetrahedra", browser.find_element(By.CSS_SELECTOR, "#summary").text)
            self.assertEqual(len(browser.find_elements(By.CSS_SELECTOR, "#charts figure")), 12)
            self.assertIn("sha256", browser.find_element(By.CSS_SELECTOR, "#details").text)
        finally:
            browser.quit()


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    for tool in ("scantet", "samples", "chromium", "driver"):
        parser.add_argument(f"--{tool}", required=True)
    ReportPage.tools, rest = parser.parse_known_args()
    unittest.main(argv=sys.argv[:1] + rest)


if __name__ == "__main__":
    main()

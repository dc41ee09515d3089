"""The page that `scantet ... --report FILE.html` writes, used in a real browser, offline.

    report_page_test.py --scantet PROGRAM --samples FOLDER --chromium PROGRAM --driver PROGRAM [unittest option...]
"""
import json
from pathlib import Path

from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

from browser_test import BrowserTest, HOSTILE_NAME, PICTURE, run_tests, start_browser


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
        for cut in ((0, 0.1, 1), (0, 0.1, -1), (1, -0.2, 1), (2, 0.05, -1), (2, 0.3, 1)):
            tets, open_edges = self.cut_and_open_edges(*cut)
            self.assertGreater(tets, 20)
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


if __name__ == "__main__":
    run_tests(ReportPage, __doc__)

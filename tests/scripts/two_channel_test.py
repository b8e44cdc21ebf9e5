"""scripts/two_channel_maps: the methods that it names are those of the program, and the page has a row for each."""
import json
import os
import pathlib
import subprocess
import tempfile
import unittest

from scripts_test import command_module

PROGRAM = os.environ["FOOTPRINT_PROGRAM"]


class TwoChannelMaps(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.script = command_module("two_channel_maps")

    def test_every_method_of_the_program_is_named(self):
        listed = json.loads(subprocess.run([PROGRAM, "list", "methods", "--json"], check=True, capture_output=True).stdout)
        self.assertEqual(self.script.METHODS, [method["name"] for method in listed["methods"]])

    def test_the_page_has_a_row_for_each(self):
        parts = self.script.parts(self.script.PAGE.read_text(encoding="utf-8"))
        rows = {name: set(self.script.figures(text)) - {"noise"} for name, text in parts.items()}
        self.assertEqual(rows["maps"], set(self.script.METHODS) - {self.script.BOUND})
        self.assertEqual(rows["chains"], set(self.script.METHODS) - set(self.script.NOT_IN_CHAINS))

    def test_another_figure_or_method_is_found(self):
        table = self.script.maps_text({"direct": [0.14, 0.15, 0.15], "lean": [0.05, 0.06, 0.06]}, [0.001] * 3)
        self.assertEqual(self.script.disagreements(table, table), [])
        self.assertLess(table.index("`lean`"), table.index("`direct`"))
        other = self.script.maps_text({"direct": [0.14, 0.15, 0.15], "lean": [0.05, 0.06, 0.07]}, [0.001] * 3)
        self.assertEqual(self.script.disagreements(table, other), ["lean"])
        fewer = self.script.maps_text({"direct": [0.14, 0.15, 0.15]}, [0.001] * 3)
        self.assertEqual(self.script.disagreements(table, fewer), ["lean"])

    def test_parts_of_a_page_are_replaced_and_nothing_else(self):
        page = "a\n<!-- begin maps: scripts/two_channel_maps -->\nold\n<!-- end -->\nb\n"
        self.assertEqual(self.script.replaced(page, {"maps": "new\nrow\n"}), page.replace("old\n", "new\nrow\n"))

    def test_a_small_run_gives_a_figure_for_each_map(self):
        with tempfile.TemporaryDirectory() as folder:
            errors, noise = self.script.maps_measured(pathlib.Path(folder), ["direct", "toksvig"], 32, "16x16", 16)
        self.assertEqual(list(errors), ["direct", "toksvig"])
        self.assertTrue(all(len(row) == 3 for row in errors.values()) and len(noise) == 3)
        self.assertNotEqual(errors["direct"][0], errors["direct"][1])


if __name__ == "__main__":
    unittest.main()

"""scripts/site: every document, a gallery with a report, the headers' reference, nothing from another host; faults are named."""
import json
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

from scripts_test import command_module

SOURCE = pathlib.Path(os.environ["FOOTPRINT_SOURCE_DIR"])


class Site(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def build(self, *words):
        return subprocess.run([SOURCE / "scripts/site", self.folder / "site", *words], capture_output=True, text=True, check=False)

    def test_it_has_documents_gallery_search_and_headers(self):
        maps = self.folder / "maps"
        shutil.copytree(SOURCE / "scenes/ribbed_plane", maps / "lines_02")
        entry = {"part": "development", "class": "lines", "file": "a_Normal.png", "package": "some-data", "scenes": {"main": ["lines_02"]}}
        (maps / "maps.json").write_text(json.dumps({"maps": [entry, {**entry, "scenes": {}}, {**entry, "part": "held_out", "class": "flat"}]}))
        built = self.build("--scenes", "^ribbed_plane$", "--maps", maps)
        self.assertEqual(built.returncode, 0, built.stderr)
        site = self.folder / "site"
        for name in ("index.html", "docs/explanation/specular-aliasing.html", "methods/toksvig/index.html", "api/structfootprint_1_1Method.html"):
            self.assertTrue((site / name).is_file(), name)
        gallery = (site / "gallery.html").read_text(encoding="utf-8")
        strip, report = re.search(r'src="(reports/ribbed_plane/images/[^"]+_all.png)"', gallery)[1], "reports/ribbed_plane/index.html"
        self.assertTrue((site / strip).is_file())
        self.assertIn(f'href="{report}"', gallery)
        self.assertEqual(re.findall(r'<h2 id="(\w+)">', gallery), ["ribbed_plane", "map_lines"])
        self.assertTrue((site / report).is_file())
        record = json.loads((site / "reports/ribbed_plane/results.json").read_text(encoding="utf-8"))["records"][0]
        self.assertIn(f"<code>{record['method']}</code> {record['error']['shading']:.3g}", gallery)
        found = json.loads((site / "search/search_index.json").read_text(encoding="utf-8"))["docs"]
        self.assertTrue(any("Toksvig" in entry["text"] for entry in found))
        (self.folder / "site/gallery.html").unlink()
        refused = self.build("--scenes", "^ribbed_plane$")
        self.assertEqual((refused.returncode, "not empty and not a site" in refused.stderr), (1, True))

    def test_no_scene_is_an_error(self):
        none = self.build("--scenes", "^no_such_scene$")
        self.assertEqual((none.returncode, none.stderr),
                         (1, "site: no scene matches `^no_such_scene$`; `footprint list scenes` names them\n"))
        self.assertFalse((self.folder / "site").exists())

    def test_faults_of_pages_are_named(self):
        site = command_module("site")
        (self.folder / "a.html").write_text('<h2 id="here">x</h2><a href="b.html#here">b</a>', encoding="utf-8")
        (self.folder / "b.html").write_text('<h2 id="here">x</h2><a href="a.html#here">a</a>', encoding="utf-8")
        self.assertEqual(site.check_links(self.folder), 2)
        (self.folder / "b.html").write_text('<a href="c.html"></a><a href="#gone"></a><script src="https://host/x.js"></script>',
                                            encoding="utf-8")
        with self.assertRaises(site.Missing) as raised:
            site.check_links(self.folder)
        self.assertEqual(str(raised.exception).splitlines(), [
            "a.html: b.html#here has no such heading", "b.html loads https://host/x.js", "b.html: #gone has no such heading",
            "b.html: c.html leads nowhere"])


if __name__ == "__main__":
    unittest.main()

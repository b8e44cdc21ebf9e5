"""scripts/check_documents: the project's own documents pass, and each kind of fault is reported with its place."""
import os
import pathlib
import subprocess
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ["FOOTPRINT_SOURCE_DIR"])

WHOLE = {
    "CMakeLists.txt": "cmake_minimum_required(VERSION 3.25)\nproject(Footprint VERSION 1.2.3)\n",
    "CITATION.cff": "cff-version: 1.2.0\nversion: 1.2.3\n",
    "CHANGELOG.md": "# Changes\n\n## 1.2.3\n",
    "README.md": "See [the map](docs/README.md), [a page](docs/page.md#the-second-part-of-it), [elsewhere](https://a.b/c).\n",
    "docs/README.md": "[page.md](page.md)\n\n```\n[in code](nothing.md)\n```\n",
    "docs/page.md": "# Page\n\n## The second `part`, of [it](page.md)\n\n[up](#page)\n",
}


def check(folder):
    return subprocess.run([SOURCE / "scripts/check_documents", folder], capture_output=True, text=True, check=False)


class Documents(unittest.TestCase):
    def lines_of(self, **changed):
        """The lines printed of the whole documents with some of them changed."""
        with tempfile.TemporaryDirectory() as name:
            for path, text in {**WHOLE, **changed}.items():
                file = pathlib.Path(name) / path
                file.parent.mkdir(parents=True, exist_ok=True)
                file.write_text(text, encoding="utf-8")
            done = check(name)
        self.assertEqual(done.stderr, "")
        return done.returncode, done.stdout.splitlines()

    def test_the_projects_own_pass(self):
        done = check(SOURCE)
        self.assertEqual(done.returncode, 0, done.stdout)

    def test_whole_documents_pass(self):
        self.assertEqual(self.lines_of(), (0, ["4 documents agree"]))

    def test_a_method_that_shared_code_names_is_reported(self):
        for name, text, mention in (
                ("renderer/shaders/a.glsl", "// as in `lean`\n", "`lean`"), ("renderer/a.cpp", '"wide_lobe_share"', "wide_lobe_share"),
                ("renderer/b/a.hpp", "// of wide_lobe\n", "wide_lobe"), ("renderer/a.cpp.in", "see methods/lean", "methods/lean")):
            with self.subTest(name):
                lines = self.lines_of(**{"methods/lean/a.cpp": "", "methods/wide_lobe/a.cpp": "", name: text})
                self.assertEqual(lines, (1, [f"{name}:1: shared code names the method {mention}"]))
        self.assertEqual(self.lines_of(**{"methods/lean/a.cpp": "", "methods/wide_lobe/a.cpp": "",
                                          "renderer/a_test.cpp": "wide_lobe", "renderer/a.hpp": "/// as `lean`, which sides lean"})[0], 0)

    def test_a_link_to_nothing_is_reported(self):
        lines = self.lines_of(**{"README.md": "\n[gone](docs/gone.md)\n"})
        self.assertEqual(lines, (1, ["README.md:2: docs/gone.md leads nowhere"]))

    def test_a_missing_heading_is_reported(self):
        lines = self.lines_of(**{"README.md": "[a page](docs/page.md#the-third-part)\n"})
        self.assertEqual(lines, (1, ["README.md:1: docs/page.md has no heading #the-third-part"]))

    def test_a_page_that_the_map_lacks_is_reported(self):
        lines = self.lines_of(**{"docs/new.md": "# New\n"})
        self.assertEqual(lines, (1, ["docs/README.md:1: new.md is not in the map"]))

    def test_a_picture_without_a_command_is_reported(self):
        files = {"docs/images/README.md": "| picture | part |\n|---|---|\n| `a.png` | some |\n| `gone/*.png` | other |\n",
                 "scripts/doc_pictures": "| part | makes |\n| some | a.png |\n", "docs/images/a.png": "", "docs/images/b.png": ""}
        self.assertEqual(self.lines_of(**files), (1, [f"docs/images/README.md:1: {fault}" for fault in (
            "no command makes b.png", "there is no gone/*.png", "scripts/doc_pictures has no part other")]))

    def test_pictures_that_are_too_large_or_name_folders_are_reported(self):
        files = {"docs/images/README.md": "| `a.txt` | some |\n", "scripts/doc_pictures": "| some |\n", "docs/images/a.txt": 6_000_001 * "x"}
        self.assertEqual(self.lines_of(**files)[1][:1], ["docs/images: 6000001 bytes: 6000000 are allowed"])
        files["docs/images/a.txt"] = "Exif\noiiotool /home/name/a.png -o a.txt"
        self.assertEqual(self.lines_of(**files)[1][:1], ["docs/images/a.txt: has a command line; add --nosoftwareattrib"])

    def test_versions_that_differ_are_reported(self):
        code, lines = self.lines_of(**{"CITATION.cff": "version: 1.2.2\n", "CHANGELOG.md": "# Changes\n"})
        self.assertEqual(code, 1)
        self.assertEqual(lines, ["CITATION.cff:1: version 1.2.2, where CMakeLists.txt has 1.2.3",
                                 "CHANGELOG.md:1: version none, where CMakeLists.txt has 1.2.3"])

    def test_a_word_that_has_a_plainer_one_is_reported_with_it(self):
        code, lines = self.lines_of(**{"README.md": "A test\nholds 64 Samples a pixel.\n", "docs/page.md": "Likewise, lobes a\npixel.\n"})
        self.assertEqual(code, 1)
        self.assertEqual(lines, ["README.md:2: `holds`: better check, compare, contain, store, pass or fit",
                                 "README.md:2: `Samples a pixel`: better per", "docs/page.md:1: `Likewise`: better also",
                                 "docs/page.md:1: `lobes a pixel`: better per"])

    def test_long_sentences_and_pages_are_reported(self):
        fits, word = f"{24 * 'word '}`two words`", "word "
        text = f"# {30 * word}\n\n{fits}. {fits}:\n- {fits}\n- {fits}\n\n| {30 * word}|\n\n```\n{30 * word}\n```\n\n"
        self.assertEqual(self.lines_of(**{"README.md": text})[0], 0)
        self.assertEqual(self.lines_of(**{"README.md": f"{text}One. Two\nand {fits} more."}),
                         (1, ["README.md:13: a sentence of 28 words: 25 are allowed"]))
        self.assertEqual(self.lines_of(**{"README.md": 2201 * "word. "}), (1, ["README.md:1: 2201 words: 2200 are allowed"]))

    def test_words_of_strings_count_and_those_of_code_do_not(self):
        code, lines = self.lines_of(**{"app/a.cpp": '// held\n#include "told.hpp"\nconst char* held = "bakes \\"anew\\"";\n',
                                   "results/report/b.js": "// held\nlet told = 'mend'\n",
                                   "results/report/c.html": "<p class='held'>dear</p>\n"})
        self.assertEqual(code, 1)
        self.assertEqual(lines, ["app/a.cpp:3: `anew`: better again", "results/report/b.js:2: `mend`: better fix",
                                 "results/report/c.html:1: `dear`: better expensive"])

    def test_words_of_code_links_and_generated_pages_pass(self):
        text = "`held` [it](docs/held.md)\n\n```\nheld\n```\n"
        files = {"README.md": text, "docs/README.md": "[a](page.md) [b](held.md) [c](results/reproduction.md)\n",
                 "docs/held.md": "# Page\n", "docs/results/reproduction.md": "held\n"}
        self.assertEqual(self.lines_of(**files), (0, ["6 documents agree"]))


if __name__ == "__main__":
    unittest.main()

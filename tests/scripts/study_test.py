"""The machinery of scripts/accuracy_vs_time on real, small parts: the page is made, and nothing is run a second time."""
import os
import pathlib
import subprocess
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ["FOOTPRINT_SOURCE_DIR"])
PROGRAM = os.environ["FOOTPRINT_PROGRAM"]


class QuickStudy(unittest.TestCase):
    def test_parts_are_run_once_and_make_a_page(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            command = [SOURCE / "scripts/accuracy_vs_time", folder, "--quick", "--run", "--footprint", PROGRAM]
            first = subprocess.run(command, capture_output=True, text=True, check=False)
            self.assertEqual(first.returncode, 0, first.stderr)
            parts = sorted(folder.glob("*/*/results.json"))
            self.assertEqual([p.parent.parent.name for p in parts], ["shaded-2", "trilinear"])
            self.assertEqual(len(list(folder.glob("*/*/kept"))), 2, "an interrupted part would go on from there")
            for said in ("## Fronts over all scenes", "## Price list", "Not run: nothing.", "`cells` | `trilinear`"):
                self.assertIn(said, first.stdout)
            parts[0].unlink()
            again = subprocess.run(command[:-1] + ["false"], capture_output=True, text=True, check=False)
            self.assertEqual(again.returncode, 1, "the part that was lost cannot be run by `false`")
            self.assertIn("accuracy_vs_time_quick under shaded:2 could not be run", again.stderr)
            page = subprocess.run(command[:3], capture_output=True, text=True, check=False)
            self.assertIn("Not run: `quick` under `shaded:2`.", page.stdout, "the rest is a page all the same")
            self.assertNotIn("under trilinear", again.stderr, "what is there is not run again")


if __name__ == "__main__":
    unittest.main()

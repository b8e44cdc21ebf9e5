"""`footprint_ndf_rank`: distributions whose rank is known, and a method without an error of its own."""

import os
import pathlib
import re
import subprocess
import tempfile
import unittest


def errors(surface, *arguments):
    """The root mean squares of a table's last row."""
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "map.png"
        subprocess.run([os.environ["FOOTPRINT_PROGRAM"], "surface", surface, "--resolution", "64", "-o", file], check=True,
                       capture_output=True)
        command = [os.environ["FOOTPRINT_NDF_RANK"], file, "--lobes", "ggx:0.2", "--levels", "2", "--methods", "exact,direct"]
        done = subprocess.run([*command, *arguments], capture_output=True, text=True, check=True)
    return [float(cell.split(";")[0]) for cell in re.split(r" ?\| ?", done.stdout.splitlines()[-1])[3:-1]]


class NdfRankTest(unittest.TestCase):
    def test_two_normals_need_two_functions(self):
        one, one_of_them, two, two_of_them, exact, direct = errors("v_grooves", "--terms", "1,2")
        self.assertGreater(min(one, one_of_them, direct), 0.1)
        self.assertLess(max(two, two_of_them, exact), 1e-5)

    def test_as_many_functions_as_texels_leave_nothing(self):
        few, _, all_of_them, *_ = errors("bumps", "--terms", "2,256")
        self.assertGreater(few, 0.1)
        self.assertLess(all_of_them, 1e-6)

    def test_a_level_that_is_not_there_is_an_error(self):
        with self.assertRaises(subprocess.CalledProcessError) as failure:
            errors("bumps", "--levels", "9")
        self.assertIn("it has no level 9", failure.exception.stderr)


if __name__ == "__main__":
    unittest.main()

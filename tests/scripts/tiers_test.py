"""Every ctest entry has one tier, and the fast tier has at least 30 entries, one of them a frame of every method."""
import json
import subprocess
import sys
import unittest

CTEST, BUILD = sys.argv[1:3]
TIERS = {"fast", "full", "nightly"}


def tiers(listing):
    """The tiers of each test of a `ctest --show-only=json-v1`."""
    labels = {test["name"]: [label for entry in test["properties"] if entry["name"] == "LABELS" for label in entry["value"]]
              for test in listing["tests"]}
    return {name: TIERS.intersection(words) for name, words in labels.items()}


def without_one_tier(listing):
    return sorted(name for name, found in tiers(listing).items() if len(found) != 1)


class Tiers(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        listed = subprocess.run([CTEST, "--test-dir", BUILD, "-C", "nightly", "--show-only=json-v1"],
                                capture_output=True, text=True, check=True)
        cls.listing = json.loads(listed.stdout)

    def names(self, tier):
        return [name for name, found in tiers(self.listing).items() if tier in found]

    def test_every_entry_has_one(self):
        self.assertEqual(without_one_tier(self.listing), [])

    def test_an_entry_without_one_is_found(self):
        stray = {"name": "stray_test", "properties": [{"name": "LABELS", "value": ["quick"]}]}
        self.assertEqual(without_one_tier({"tests": [stray, *self.listing["tests"]]}), ["stray_test"])

    def test_the_fast_tier_has_what_an_edit_can_break(self):
        self.assertGreaterEqual(len(self.names("fast")), 30)
        self.assertIn("footprint_small_frames_test", self.names("fast"))

    def test_the_slow_forms_run_only_at_night(self):
        by_day = subprocess.run([CTEST, "--test-dir", BUILD, "--show-only=json-v1"], capture_output=True, text=True, check=True)
        self.assertTrue(self.names("nightly"))
        self.assertFalse(set(self.names("nightly")).intersection(test["name"] for test in json.loads(by_day.stdout)["tests"]))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])

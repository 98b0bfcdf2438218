"""scripts/checks/fuzz_campaign.py: the results of several runs add up."""
import contextlib
import io
import json
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts" / "checks"))
from fuzz_campaign import added, read_record  # noqa: E402

ROW = {"name": "obj", "what": "any bytes", "seconds": 30.5, "executions": 1000, "lines_reached": 80, "lines": 90, "inputs": 7,
       "crashes": ["b"]}


class FuzzRecordTest(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.path = Path(temporary.name) / "fuzz.json"

    def assert_refused(self, text, said):
        self.path.write_text(text)
        errors = io.StringIO()
        with self.assertRaises(SystemExit) as stopped, contextlib.redirect_stderr(errors):
            read_record(self.path, "abc")
        self.assertEqual(stopped.exception.code, 2)
        self.assertIn(said, errors.getvalue())
        self.assertEqual(self.path.read_text(), text)

    def test_a_run_adds_to_the_record_of_the_same_commit(self):
        self.path.write_text(json.dumps({"commit": "abc", "targets": [{**ROW, "lines_reached": 60, "crashes": ["a"]}]}))
        before = read_record(self.path, "abc")
        self.assertEqual(added(ROW, before["obj"]), {**ROW, "seconds": 61.0, "executions": 2000, "crashes": ["a", "b"]})

    def test_a_missing_record_begins(self):
        self.assertEqual(read_record(self.path, "abc"), {})
        self.assertEqual(read_record(None, "abc"), {})
        self.assertEqual(added(ROW, {}), ROW)

    def test_changed_sources_are_refused(self):
        for now in ("abc-dirty", "unknown"):
            with self.assertRaises(SystemExit), contextlib.redirect_stderr(io.StringIO()):
                read_record(self.path, now)

    def test_other_records_are_refused(self):
        self.assert_refused(json.dumps({"commit": "old", "targets": [ROW]}), "is of commit old, and this is abc")
        for text in ("no JSON", "[]", json.dumps({"commit": "abc"}), json.dumps({"commit": "abc", "targets": [{"name": "obj"}]})):
            self.assert_refused(text, "is not a record of fuzzing")


if __name__ == "__main__":
    unittest.main()

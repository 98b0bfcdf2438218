"""scripts/publish: what it copies to results/, and what results/ of this repository holds."""
import json
import random
import shutil
import unittest

from support import RESULTS, ROOT, SCRIPTS, FolderTest, copied_results, google_benchmark, read, run
from bench_rows import order, read_bench

README = """<!-- results: results/mine -->
![](results/facts/pictures/torus-knot.png)
"""
FAR_README = """[A chart](../../results/mine/charts/area.svg), <img src="../../results/facts/errors/crack.png" width="400">,
and one of another folder: ![](../charts/threads.svg)
"""


class PublishTest(FolderTest):
    def setUp(self):
        super().setUp()
        shutil.copytree(SCRIPTS, self.folder / "scripts", ignore=shutil.ignore_patterns("README.md"))
        self.mine, self.results = copied_results(self.folder / "build/results").rename(self.folder / "build/results/mine"), self.folder / "results"
        for name in ("facts/pictures/torus-knot.png", "facts/pictures/cube.png", "mine/charts/area.svg", "mine/charts/threads.svg",
                     "facts/errors/crack.png"):
            self.file(self.mine.parent / name, f"new {name}")
        self.written = {f"{path.parent.name}/{path.name}" for path in self.mine.parent.glob("*/*.json")}
        self.file("README.md", README)
        self.file("src/lab/README.md", FAR_README)
        self.git("init", "--quiet")
        self.git("add", "README.md", "src")

    def git(self, *words):
        self.assertEqual(run("git", "-C", self.folder, *words).returncode, 0)

    def publish(self, *arguments):
        return run(self.folder / "scripts/publish", *arguments)

    def files(self):
        return {str(path.relative_to(self.results)) for path in self.results.rglob("*") if path.is_file()}

    def test_readmes_decide_which_pictures_are_copied(self):
        for name in ("random.json", "python.json"):
            (self.mine / name).unlink(missing_ok=True)
        written = self.written - {"mine/random.json", "mine/python.json"}
        for name, text in (("random.json", "{}"), ("python.json", "{}"), ("charts/threads.svg", "old"), ("charts/area.svg", "old")):
            self.file(self.results / "mine" / name, text)
        for name in ("page/page.html", "platforms/platforms.json"):
            self.file(self.folder / "build" / name, f"new {name}")
        result = self.publish(self.mine)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(self.files(), written | {"mine/random.json"} |
                         {"facts/pictures/torus-knot.png", "mine/charts/area.svg", "facts/errors/crack.png", "page.html", "platforms.json"})
        self.assertEqual((self.results / "mine/charts/area.svg").read_text(), "new mine/charts/area.svg")
        self.assertIn(f"results/mine/ and results/facts/: {len(written)} JSON files, and 3 charts and pictures", result.stdout)

    def test_what_reports_use_is_kept_in_fewer_bytes(self):
        bench, generator = google_benchmark(read(self.mine / "bench.json")), random.Random(1)
        for i, row in enumerate(bench["benchmarks"]):
            row.update(real_time=row["real_time"] * (1 + generator.uniform(-4e-6, 4e-6)), iterations=12000, p99_ms=1.23456789012345, repetition_index=i)
        bench["benchmarks"] += [{"name": "naive/mesh/threads:1", "error_occurred": True, "error_message": "other pixels"},
                                {**bench["benchmarks"][0], "run_type": "aggregate", "name": "frontend/cube/threads:1_median"}]
        self.file(self.mine / "bench.json", json.dumps(bench))
        for name, unread in (("accuracy", {"slits": 1}), ("needs", {"edges": [{"witness": 9}]})):
            data = read(self.mine.parent / f"facts/{name}.json")
            for entry in data["scenes"] if name == "accuracy" else data:
                entry |= unread
            self.file(self.mine.parent / f"facts/{name}.json", json.dumps(data, indent=1))
        self.assertEqual(self.publish(self.mine).returncode, 0)
        for path in (RESULTS.parent / "facts").glob("*.json"):
            self.assertTrue((self.results / "facts" / path.name).read_bytes() == path.read_bytes(), f"{path} is not what publish writes")
        self.assertLess(2 * (self.results / "mine/bench.json").stat().st_size, (self.mine / "bench.json").stat().st_size)
        (before, rows), (after, published) = ((bench.context, bench.rows) for bench in map(read_bench, (self.mine, self.results / "mine")))
        self.assertEqual((after, list(published)), (before, list(rows)))
        for name, row in rows.items():
            self.assertEqual((published[name].counters, published[name].error, published[name].rounds), (row.counters, row.error, row.rounds))
            for ms, kept in zip(row.times_ms, published[name].times_ms, strict=True):
                self.assertLess(abs(kept / ms - 1), 1e-4)
        for _ in range(200):
            one, other = generator.sample([name for name in rows if name.startswith("cell/cube")], 2)
            self.assertEqual(order(published[one], published[other]), order(rows[one], rows[other]))

    def test_results_of_a_part_of_the_suite_are_refused(self):
        bench = self.mine / "bench.json"
        bench.write_text(bench.read_text().replace('"suite":"full"', '"suite":"quick"'))
        result = self.publish(self.mine)
        self.assertEqual((result.returncode, self.results.exists()), (2, False))
        self.assertIn("`scripts/run --full` makes", result.stderr)

    def test_records_without_a_benchmark_are_added(self):
        self.assertEqual(self.publish(self.mine).returncode, 0)
        for file in self.mine.glob("*.json"):
            file.unlink()
        self.file(self.mine / "prove.json", "[]")
        self.assertEqual(self.publish(self.mine).returncode, 0)
        self.assertLessEqual({"mine/prove.json", "mine/bench.json"}, self.files())

    def test_a_picture_that_was_not_drawn_removes_nothing(self):
        self.file(self.results / "mine/charts/area.svg", "old")
        (self.mine.parent / "facts/errors/crack.png").unlink()
        result = self.publish(self.mine)
        self.assertEqual((result.returncode, result.stderr),
                         (2, "publish: results/facts/errors/crack.png: a README shows it, but the run did not draw it\n"))
        self.assertEqual((self.results / "mine/charts/area.svg").read_text(), "old")

    def test_a_folder_that_is_no_run_is_refused(self):
        self.assertEqual(self.publish(self.mine).returncode, 0)
        before = self.files()
        for folder in (self.folder / "nowhere", self.results / "mine", self.mine.parent / "facts"):
            result = self.publish(folder)
            self.assertEqual((result.returncode, len(result.stderr.splitlines())), (2, 1), result.stderr)
        self.assertEqual(self.files(), before)

    def test_check_lists_what_is_superfluous_and_what_is_missing(self):
        self.assertEqual(self.publish(self.mine).returncode, 0)
        self.git("add", "results")
        result = self.publish("--check")
        self.assertEqual((result.returncode, result.stdout), (0, ""), result.stderr)
        self.file(self.results / "mine/page.html", "")
        self.git("add", "results")
        self.git("rm", "--quiet", "--cached", "results/facts/errors/crack.png")
        result = self.publish("--check")
        self.assertEqual((result.returncode, result.stdout.splitlines()),
                         (1, ["results/mine/page.html: no README shows it",
                              "results/facts/errors/crack.png: a README shows it, but it is not committed"]))


class CommittedResults(unittest.TestCase):
    def test_only_what_readmes_show_is_committed_and_little_of_it(self):
        top = run("git", "-C", ROOT, "rev-parse", "--show-toplevel")
        if top.stdout.strip() != str(ROOT):
            self.skipTest("not a git checkout")
        result = run(SCRIPTS / "publish", "--check")
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        files = run("git", "-C", ROOT, "ls-files", "results").stdout.splitlines()
        self.assertIn("results/README.md", files)
        for folder in {file.split("/")[1] for file in files if file.count("/") > 1}:
            size = sum((ROOT / file).stat().st_size for file in files if file.startswith(f"results/{folder}/"))
            self.assertLess(size, 1e6 if folder == "facts" else 2e6, folder)


if __name__ == "__main__":
    unittest.main()

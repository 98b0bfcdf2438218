"""scripts/publish: what it copies to results/, and what results/ of this repository holds."""
import json
import random
import unittest

from support import RESULTS, ROOT, SCRIPTS, CopyTest, copied_results, google_benchmark, read, run
from bench_rows import read_bench

README = """<!-- results: results/mine -->
![](results/facts/pictures/torus-knot.png)
"""
FAR_README = """[A chart](../../results/mine/charts/area.svg), <img src="../../results/facts/errors/crack.png" width="400">,
and one of another folder: ![](../charts/threads.svg)
"""
SHOWN = {"facts/pictures/torus-knot.png", "mine/charts/area.svg", "facts/errors/crack.png"}


class PublishTest(CopyTest):
    def setUp(self):
        super().setUp()
        self.built, self.results = self.folder / "build/results", self.folder / "results"
        self.mine = copied_results(self.built).rename(self.built / "mine")
        for name in (*SHOWN, "facts/pictures/cube.png", "mine/charts/threads.svg"):
            self.file(self.built / name, f"new {name}")
        self.file("README.md", README)
        self.file("src/lab/README.md", FAR_README)
        self.git("init", "--quiet")
        self.git("add", "README.md", "src")

    def files(self):
        return {str(path.relative_to(self.results)): path.read_bytes() for path in self.results.rglob("*") if path.is_file()}

    def published(self):
        """The files that are then in results/."""
        result = self.script("publish", self.mine)
        self.assertEqual(result.returncode, 0, result.stderr)
        return self.files()

    def test_readmes_decide_which_pictures_are_copied(self):
        (self.mine / "python.json").unlink(missing_ok=True)
        written = {f"{path.parent.name}/{path.name}" for path in self.built.glob("*/*.json")}
        for name in ("mine/older.json", "mine/python.json", "mine/charts/threads.svg", "mine/charts/area.svg"):
            self.file(self.results / name, "{}")
        for name in ("page/page.html", "platforms/platforms.tsv"):
            self.file(self.folder / "build" / name, f"new {name}")
        found = self.published()
        self.assertEqual(set(found), {*written, *SHOWN, "mine/older.json", "page.html", "platforms.tsv"})
        self.assertEqual(found["mine/charts/area.svg"], b"new mine/charts/area.svg")

    def test_what_reports_use_is_kept_in_fewer_bytes(self):
        bench, generator = google_benchmark(read(self.mine / "bench.json")), random.Random(1)
        for i, row in enumerate(bench["benchmarks"]):
            row |= {"iterations": 12000, "p99_ms": 1.23456789012345, "repetition_index": i}
            row["real_time"] *= 1 + generator.uniform(-4e-6, 4e-6)
        bench["benchmarks"] += [{"name": "naive/mesh/threads:1", "error_occurred": True, "error_message": "other pixels"},
                                {**bench["benchmarks"][0], "run_type": "aggregate", "name": "frontend/cube/threads:1_median"}]
        self.file(self.mine / "bench.json", json.dumps(bench))
        for name, unread in (("accuracy", {"slits": 1}), ("needs", {"edges": [{"witness": 9}]})):
            data = read(self.built / f"facts/{name}.json")
            for entry in data["scenes"] if name == "accuracy" else data:
                entry |= unread
            self.file(self.built / f"facts/{name}.json", json.dumps(data, indent=1))
        found = self.published()
        for path in (RESULTS.parent / "facts").glob("*.json"):
            self.assertTrue(found[f"facts/{path.name}"] == path.read_bytes(), f"{path} is not what publish writes")
        self.assertLess(2 * len(found["mine/bench.json"]), (self.mine / "bench.json").stat().st_size)
        before, after = (read_bench(folder) for folder in (self.mine, self.results / "mine"))
        self.assertEqual((after.context, list(after.rows)), (before.context, list(before.rows)))
        for row, kept in zip(before.rows.values(), after.rows.values()):
            self.assertEqual((kept.counters, kept.error, kept.rounds), (row.counters, row.error, row.rounds))
            for ms, kept_ms in zip(row.times_ms, kept.times_ms, strict=True):
                self.assertLess(abs(kept_ms / ms - 1), 1e-4)

    def test_what_is_no_whole_run_is_refused_and_changes_nothing(self):
        before, bench = self.published(), self.mine / "bench.json"
        for folder in (self.folder / "nowhere", self.results / "mine", self.built / "facts"):
            self.fails(self.script("publish", folder), f"publish: {folder}: no results of a run")
        (self.built / "facts/errors/crack.png").unlink()
        self.fails(self.script("publish", self.mine), "results/facts/errors/crack.png: a README shows it, but the run did not draw it")
        bench.write_text(bench.read_text().replace('"suite":"full"', '"suite":"quick"'))
        self.fails(self.script("publish", self.mine), "`scripts/run --full` makes")
        self.assertEqual(self.files(), before)

    def test_records_without_a_benchmark_are_added(self):
        self.published()
        for file in self.mine.glob("*.json"):
            file.unlink()
        self.file(self.mine / "fresh.json", "[]")
        self.assertLessEqual({"mine/fresh.json", "mine/bench.json"}, set(self.published()))

    def test_check_lists_what_is_superfluous_and_what_is_missing(self):
        self.published()
        self.git("add", "results")
        result = self.script("publish", "--check")
        self.assertEqual((result.returncode, result.stdout), (0, ""), result.stderr)
        self.file(self.results / "mine/page.html", "")
        self.git("add", "results")
        self.git("rm", "--quiet", "--cached", "results/facts/errors/crack.png")
        result = self.script("publish", "--check")
        self.assertEqual((result.returncode, result.stdout.splitlines()),
                         (1, ["results/mine/page.html: no README shows it",
                              "results/facts/errors/crack.png: a README shows it, but it is not committed"]))


class CommittedResults(unittest.TestCase):
    def test_only_what_readmes_show_is_committed_and_little_of_it(self):
        if run("git", "-C", ROOT, "rev-parse", "--show-toplevel").stdout.strip() != str(ROOT):
            self.skipTest("not a git checkout")
        result = run(SCRIPTS / "publish", "--check")
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        files = run("git", "-C", ROOT, "ls-files", "results").stdout.splitlines()
        for folder in {file.split("/")[1] for file in files if file.count("/") > 1}:
            size = sum((ROOT / file).stat().st_size for file in files if file.startswith(f"results/{folder}/"))
            self.assertLess(size, 1e6 if folder == "facts" else 2e6, folder)


if __name__ == "__main__":
    unittest.main()

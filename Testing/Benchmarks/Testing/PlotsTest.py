"""Tests of plots.py, which draws the JSON files of petrous bench."""

import importlib.util
import json
import locale
import shutil
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree
from pathlib import Path

SCRIPT = Path(__file__).resolve().parents[1] / "plots.py"
FIGURES = SCRIPT.parents[2] / "Documentation" / "benchmarks"

if importlib.util.find_spec("matplotlib") is None:
    print("skipped: python3-matplotlib is not installed")
    sys.exit(77)
spec = importlib.util.spec_from_file_location("plots", SCRIPT)
plots = importlib.util.module_from_spec(spec)
spec.loader.exec_module(plots)


def point(scene="scene", series=None, value=None, seconds=1.0, error=1.0, peer=None, default=False,
          unit="mm", extra=None, **setting):
    setting |= {"scene": scene, "default": default}
    if series:
        setting |= {"varied": series, series.split(",")[0]: value}
    return {"setting": setting, "seconds": seconds, "error": error, "error_unit": unit,
            "peer": peer, "extra": extra or {}}


def report(points, name="bench"):
    return {"name": name, "title": "What was measured", "commit": "0123456789ab",
            "machine": {"processor": "Some CPU", "threads": 2, "gl": "some GL"}, "points": points}


def crowd(seconds, error):
    """Five settings at the same position, in the middle of the plot or near a corner."""
    points = [point(series="step", value="2", seconds=0.21, error=4.9),
              point(series="step", value="0.125", seconds=1.9, error=0.52)]
    points += [point(series="entries", value=value, seconds=seconds, error=error,
                     default=value == "4096") for value in ("64", "256", "512", "1024", "4096")]
    return points


def trial(kind, verdict, error, wrong):
    return point("stress: " + kind, error=error, trial="one", verdict=verdict, text="words",
                 extra={"wrong": float(wrong), "p95_mm": 0.5, "max_mm": 0.75})


def calibrated(stated, error):
    return point("calibration", error=error, verdict="good", images="phantom", pair="1",
                 extra={"p95_mm": stated, "covered": float(error <= stated)})


class Plots(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="petrous-plots-"))
        self.addCleanup(shutil.rmtree, self.folder)

    def write(self, content, name="bench.json"):
        path = self.folder / name
        path.write_text(content if isinstance(content, str) else json.dumps(content),
                        encoding="utf-8")
        return path

    def pages(self, points, name="bench"):
        return plots.pages_of(plots.Report(self.write(report(points, name))))

    def run_script(self, **environment):
        return subprocess.run([sys.executable, "-B", SCRIPT, self.folder], capture_output=True,
                              text=True, env=environment, check=False)

    def texts(self, name):
        tree = xml.etree.ElementTree.parse(self.folder / name)
        return [element.text for element in tree.iter("{http://www.w3.org/2000/svg}text")]

    def expect_apart(self, page):
        count = 0
        for axes in page.figure.axes:
            boxes = [(text.get_text(), text.get_window_extent(page.renderer))
                     for text in axes.texts if text.get_text()]
            count += len(boxes)
            for n, (words, box) in enumerate(boxes):
                for other_words, other in boxes[n + 1:]:
                    apart = (box.x1 <= other.x0 or other.x1 <= box.x0 or box.y1 <= other.y0 + 2 or
                             other.y1 <= box.y0 + 2)  # px of ascent and descent without ink
                    self.assertTrue(apart, f"{words} {other_words}")
        return count

    def test_draws_each_point_of_each_program_where_its_figures_say(self):
        points = [point(series="step, of rays", value="1", seconds=0.1, error=2.0, default=True),
                  point(series="step, of rays", value="2", seconds=0.2, error=4.0),
                  point(series="step, of rays", value="1", seconds=0.5, error=3.0, peer="Peer"),
                  point("other", seconds=0.3), point("other", seconds=7.0, peer="Rival")]
        pages = self.pages(points)
        self.assertEqual(list(pages), ["", "-frames"])
        lines = [list(zip(*line.get_data())) for line in pages[""].figure.axes[0].lines]
        self.assertIn([(0.1, 2.0), (0.2, 4.0)], lines)
        self.assertIn([(0.5, 3.0)], lines)
        self.assertEqual(lines.count([(0.1, 2.0)]), 1, "the default's ring")
        marks = [line.get_xdata()[0] for line in pages["-frames"].figure.axes[0].lines]
        self.assertEqual(marks, [0.3, 7.0])
        styles = {(line.get_marker(), line.get_markerfacecolor())
                  for page in pages.values() for line in page.figure.axes[0].lines
                  if line.get_markersize() < 10 and len(line.get_xdata())}
        self.assertEqual(len({marker for marker, _ in styles}), 3, "told apart without colour")

        self.assertEqual(self.run_script().returncode, 0)
        texts = self.texts("bench.svg")
        for words in ("What was measured: scene", "step, of rays", "petrous", "Peer", "the default",
                      "error, mm", "time", "100 ms", "2"):
            self.assertIn(words, texts)
        self.assertTrue(any("commit 0123456789ab; Some CPU, 2 threads; gl: some GL" in text
                            for text in texts))
        for words in ("other", "Rival", "300 ms"):
            self.assertIn(words, self.texts("bench-frames.svg"))

    def test_shows_peers_without_an_error_by_time_alone(self):
        points = [point(series="step", value="1", default=True), point(default=True, seconds=0.125),
                  point(seconds=2.5, error=None, peer="Peer")]
        figure = self.pages(points)[""].figure
        self.assertEqual(len(figure.axes), 2)
        self.assertEqual([text.get_text() for text in figure.axes[1].texts],
                         ["petrous: 125 ms", "Peer: 2.5 s"])

    def test_keeps_the_labels_of_settings_that_lie_together_apart(self):
        for seconds, error in ((0.57, 1.0), (0.21, 4.9), (1.9, 4.9), (0.21, 0.52), (1.9, 0.52)):
            with self.subTest(seconds=seconds, error=error):
                page = self.pages(crowd(seconds, error))[""]
                self.assertEqual(self.expect_apart(page), 7, "room for all")

    def test_leaves_out_labels_that_have_no_room_but_the_default(self):
        points = crowd(0.57, 1.0)
        points += [point(series="entries", value=str(10000 + n), seconds=0.57, error=1.0)
                   for n in range(200)]
        page = self.pages(points)[""]
        count = self.expect_apart(page)
        self.assertGreater(count, 20)
        self.assertLess(count, 120)
        labels = [text.get_text() for axes in page.figure.axes for text in axes.texts]
        self.assertEqual(labels.count("4096"), 1)

    def test_axes_run_from_one_mark_to_another_over_all_values(self):
        axis = plots.LogAxis([0.03, 4.0], 9, plots.number)
        self.assertEqual((axis.low, axis.high), (0.02, 5.0))
        self.assertEqual(list(axis.labels.values()), ["0.02", "0.05", "0.1", "0.2", "0.5", "1", "2",
                                                      "5"])
        axis = plots.LogAxis([0.03, 0.0, 1e-21, 4.0], 9, plots.number)
        self.assertEqual(axis.labels[axis.low], "0")
        self.assertLess(axis.low, 0.02)
        self.assertEqual([axis.place(value) for value in (0.0, 1e-21, 0.03)],
                         [axis.low, axis.low, 0.03])
        for least, most in ((1e-16, 1e-3), (3e-7, 5e-3), (0.99, 1.01)):
            axis = plots.LogAxis([least, most], 9, plots.duration)
            self.assertTrue(axis.low < least and most < axis.high)
            self.assertIn(len(axis.labels), range(2, 10))

    def test_numbers_and_times_are_short(self):
        self.assertEqual([plots.number(v) for v in (0.0, 0.05, 1, 2000.0, 1e-13, 2e-5, 1e6)],
                         ["0", "0.05", "1", "2000", "10⁻¹³", "2·10⁻⁵", "10⁶"])
        self.assertEqual([plots.duration(v) for v in (8e-8, 5e-5, 0.0124, 0.999, 1.0, 200.0)],
                         ["80 ns", "50 µs", "12.4 ms", "999 ms", "1 s", "200 s"])

    def test_history_shows_time_and_memory_against_strokes(self):
        points = [point(strokes=strokes, seconds=seconds, error=0.0, extra={"memory_mb": memory})
                  for strokes, seconds, memory in (("1", 0.5, 3.0), ("1000", 0.25, 30.0),
                                                   ("1000 at once", 9.0, 30.0))]
        time, memory = self.pages(points, "history")[""].figure.axes
        self.assertEqual(list(zip(*time.lines[0].get_data())), [(1.0, 0.5), (1000.0, 0.25)])
        self.assertEqual(list(zip(*memory.lines[0].get_data())), [(1.0, 3.0), (1000.0, 30.0)])

    def test_the_servo_shows_the_tail_of_its_live_sessions(self):
        extra = {"ticks": 2000.0, "real_time_priority": 0.0, "ticks_late": 3.0, "records_lost": 0.0,
                 "page_faults": 0.0, "ticks_that_left_motion": 7.0}
        points = [point("block", error=0.0), point("live: ear", points="500", of="session",
                                                   extra=extra)]
        points += [point("live: ear", points="500", of=of, percent=percent, seconds=seconds,
                         error=None)
                   for of, factor in (("tick", 1.0), ("lateness", 0.1))
                   for percent, seconds in (("50", 1e-4 * factor), ("99.9", 5e-4 * factor),
                                            ("100", 2e-3 * factor))]
        pages = self.pages(points, "servo")
        self.assertEqual(list(pages), ["", "-live"])
        tick, late = pages["-live"].figure.axes
        for axes, factor in ((tick, 1.0), (late, 0.1)):
            line = [line for line in axes.lines if len(line.get_xdata()) == 3][0]
            for value, expected in zip(line.get_xdata(), (1e-4, 5e-4, 2e-3)):
                self.assertAlmostEqual(value, expected * factor, 12)
            for value, expected in zip(line.get_ydata(), (0.5, 1e-3, 1 / 2000)):
                self.assertAlmostEqual(value, expected, 12, "the longest is one tick of all")
        words = [text.get_text() for text in pages["-live"].figure.texts]
        self.assertIn("500 points: 2000 ticks, no real-time priority, 3 late, 0 records lost, "
                      "0 page faults, 7 left motion to the next", words)

    def test_devices_show_what_is_stable_over_stiffness_and_delay(self):
        def coupling(delay, largest, cycles):
            extra = {f"cycle_n_pp_at_{k}": cycle for k, cycle in zip(("0.5", "2"), cycles)}
            extra |= {f"energy_mj_at_{k}": 10.0 * cycle for k, cycle in zip(("0.5", "2"), cycles)}
            extra |= {"largest_stable_n_per_mm": largest, "passive_n_per_mm": 3.0 / (1 + delay),
                      "described_n_per_mm": 1.0}
            return point("Touch", error=None, guard="on", missed_percent="0", missed_at_once="1",
                         delay_ms=str(delay), extra=extra)

        pages = self.pages([coupling(0, 2.0, (0.001, 0.002)), coupling(4, 0.5, (0.002, 5.0))],
                           "devices")
        self.assertEqual(list(pages), [""])
        axes = pages[""].figure.axes[0]
        cells = axes.collections[0].get_array().flatten().tolist()
        self.assertEqual(cells, [0.001, 0.002, 0.002, 5.0], "a row for each stiffness")
        lines = [list(zip(*line.get_data())) for line in axes.lines]
        self.assertIn([(4.0, 2.0)], lines, "energy comes out there alone")
        self.assertIn([(0.0, 3.0), (4.0, 0.6)], lines)
        self.assertIn([(0.0, 1.0), (4.0, 1.0)], lines)
        values = axes.patches[0].get_data().values
        self.assertAlmostEqual(values[0], 4.0, 12, "above the cell of 2 N/mm")
        self.assertAlmostEqual(values[1], 1.0, 12, "between 0.5 and 2 N/mm")

    def test_counts_stress_trials_by_kind_and_names_each_wrong_one(self):
        pages = self.pages(
            [trial("noise", "failed", None, False), trial("noise", "good", None, True),
             trial("turned", "good", 0.25, False), trial("turned", "refused", None, False),
             trial("turned", "good", 3.5, True)], "registration")
        self.assertEqual(list(pages), ["-stress.md"])
        for words in ("| noise | 2 | 1 | 0 | 1 | 0 |  | 1 |",
                      "| turned | 3 | 2 | 0 | 0 | 1 | 3.50 | 1 |",
                      "| **all** | 5 | 3 | 0 | 1 | 1 | 3.50 | 2 |", "noise (one): no truth exists",
                      "turned (one): true error 3.50 mm, stated p95 0.50"):
            self.assertIn(words, pages["-stress.md"])

    def test_says_how_many_errors_the_stated_ones_cover(self):
        pages = self.pages([calibrated(1.0, 0.5), calibrated(1.0, 0.9), calibrated(1.0, 1.1),
                            calibrated(0.2, 0.1)], "registration")
        self.assertEqual(list(pages), ["-calibration"])
        legend = [text.get_text() for text in pages["-calibration"].figure.legends[0].get_texts()]
        self.assertEqual(legend, ["good: 3 of 4 within, 75.0 %"])

    def test_conditions_show_median_worst_and_stated_error(self):
        points = [point("conditions: noise", noise=value, error=error,
                        extra={"worst_mm": 2 * error, "stated_p95_mm": 3 * error, "good": 4.0,
                               "pairs": 6.0}) for value, error in (("0", 0.1), ("0.4", 0.2))]
        axes = self.pages(points, "registration")["-conditions"].figure.axes[0]
        self.assertEqual([list(line.get_ydata()) for line in axes.lines],
                         [[0.1, 0.2], [0.2, 0.4], [0.30000000000000004, 0.6000000000000001]])
        self.assertEqual([label.get_text() for label in axes.get_xticklabels()],
                         ["0\n4/6", "0.4\n4/6"])

    def test_the_same_figures_give_the_same_bytes_in_every_locale(self):
        self.write(report(crowd(0.57, 1.0)))
        self.assertEqual(self.run_script(LC_ALL="C").returncode, 0)
        first = (self.folder / "bench.svg").read_bytes()
        self.assertIn(b"0.125", first)
        self.assertEqual(self.run_script(LC_ALL="de_DE.UTF-8", TZ="Asia/Tokyo").returncode, 0)
        self.assertEqual((self.folder / "bench.svg").read_bytes(), first)
        try:
            locale.setlocale(locale.LC_ALL, "de_DE.UTF-8")
        except locale.Error:
            self.skipTest("there is no locale with a decimal comma")
        self.addCleanup(locale.setlocale, locale.LC_ALL, "C")
        plots.draw(self.folder / "bench.json")
        self.assertEqual((self.folder / "bench.svg").read_bytes(), first)

    def test_errors_name_the_file_and_what_is_missing(self):
        broken = report([point(), point()])
        del broken["points"][1]["seconds"]
        self.write(broken, "a.json")
        without = report([point()])
        del without["commit"]
        self.write(without, "b.json")
        self.write("{", "c.json")
        self.write(report([trial("noise", "good", None, True)], "registration") |
                   {"points": [point("calibration")]}, "d.json")
        self.write(report([point()]), "whole.json")
        outcome = self.run_script()
        self.assertEqual(outcome.returncode, 1)
        for words in ("a.json: point 2 has no 'seconds'", "b.json: has no 'commit'", "c.json: ",
                      "d.json: point 1, 'extra' has no 'p95_mm'"):
            self.assertIn(words, outcome.stderr)
        self.assertEqual(len(outcome.stderr.splitlines()), 4)
        self.assertTrue((self.folder / "whole.svg").exists(), "the others are drawn")

    def test_says_where_it_looked_if_there_is_nothing(self):
        outcome = self.run_script()
        self.assertEqual(outcome.returncode, 1)
        self.assertIn(str(self.folder), outcome.stderr)

    def test_the_plots_of_the_documentation_are_those_of_its_figures(self):
        figures = sorted(FIGURES.glob("*.json"))
        self.assertGreater(len(figures), 5)
        for path in figures:
            commit = json.loads(path.read_text(encoding="utf-8"))["commit"]
            for ending in plots.pages_of(plots.Report(path)):
                with self.subTest(path=path.name, ending=ending):
                    text = path.with_name(path.stem + ending + ".svg").read_text(encoding="utf-8")
                    self.assertTrue(f"commit {commit};" in text, "drawn from other figures")


if __name__ == "__main__":
    unittest.main()

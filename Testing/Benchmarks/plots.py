#!/usr/bin/python3
"""Draws what `petrous bench` measured.

    plots.py [FOLDER]

Reads every NAME.json of FOLDER (by default the checkout's Documentation/benchmarks) and writes
NAME*.svg beside it, and registration-stress.md. Needs matplotlib (Debian: python3-matplotlib). The
same JSON gives the same bytes, in every locale.

Petrous has filled markers, its default setting ringed; each peer has hollow ones, with a shape and
a colour of its own (Okabe and Ito's palette, safe for colour-blind readers), and dashed lines.
"""

import json
import math
import sys
import textwrap
from collections import Counter
from pathlib import Path

try:
    import matplotlib
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.colors import LogNorm
    from matplotlib.figure import Figure
    from matplotlib.lines import Line2D
    from matplotlib.patheffects import withStroke
    from matplotlib.ticker import FixedFormatter, FixedLocator
except ImportError as error:
    sys.exit(f"plots.py: {error}; install python3-matplotlib")

matplotlib.rcdefaults()  # not the user's settings
matplotlib.rcParams.update({
    "font.size": 10.0, "axes.edgecolor": "#888888", "axes.axisbelow": True, "grid.color": "#dddddd",
    "axes.titlesize": 10.0, "axes.titleweight": "bold", "legend.fontsize": 10.0,
    "legend.frameon": False, "svg.fonttype": "none", "svg.hashsalt": "petrous",
    "path.simplify": False})

DPI = 72  # one point is one pixel, in the SVG and where text is measured
LEFT, TOP, BOTTOM = 90, 62, 64  # px around the axes
OURS = "petrous"
COLORS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000"]
MARKERS = ["o", "s", "^", "D", "v", "P", "X"]
ZERO = 1e-15  # of the largest value of a plot: below it lies the rounding of double precision


class BadReport(Exception):
    """A JSON file that cannot be drawn: names the file and what is missing."""


class Point:
    """One measurement of a report."""

    def __init__(self, where, entry):
        def take(parent, key, kinds, place):
            if not isinstance(parent, dict) or key not in parent:
                raise BadReport(f"{place} has no '{key}'")
            value = parent[key]
            if not isinstance(value, kinds) or isinstance(value, bool) != (kinds is bool):
                raise BadReport(f"{place}: '{key}' is {value!r}")
            return value

        self.where = where
        self.setting = take(entry, "setting", dict, where)
        self.scene = take(self.setting, "scene", str, where + ", 'setting'")
        self.default = take(self.setting, "default", bool, where + ", 'setting'")
        self.series = self.setting.get("varied")
        self.seconds = float(take(entry, "seconds", (int, float), where))
        error = take(entry, "error", (int, float, type(None)), where)
        self.error = None if error is None else float(error)
        self.unit = take(entry, "error_unit", str, where)
        self.program = take(entry, "peer", (str, type(None)), where) or OURS
        self.extras = take(entry, "extra", dict, where)

    def ours(self):
        return self.program == OURS

    def set(self, name):
        """A setting of which the plot cannot do without."""
        if name not in self.setting:
            raise BadReport(f"{self.where}, 'setting' has no '{name}'")
        return self.setting[name]

    def extra(self, name):
        if name not in self.extras:
            raise BadReport(f"{self.where}, 'extra' has no '{name}'")
        return float(self.extras[name])

    def value(self):
        """The varied setting's; a series is named after it, further words follow a comma."""
        name = self.series.split(",")[0]
        return self.setting[self.series] if self.series in self.setting else self.set(name)


class Report:
    def __init__(self, path):
        try:
            content = json.loads(path.read_text(encoding="utf-8"))
        except (OSError, ValueError) as error:
            raise BadReport(f"{path}: {error}") from None
        for key, kind in {"name": str, "title": str, "commit": str, "machine": dict,
                          "points": list}.items():
            if not isinstance(content, dict) or not isinstance(content.get(key), kind):
                raise BadReport(f"{path}: has no '{key}'")
        self.path = path
        self.name = content["name"]
        self.title = content["title"]
        machine = content["machine"]
        rest = [f"{key}: {value}" for key, value in sorted(machine.items())
                if key not in ("processor", "threads")]
        self.measured = "; ".join(
            [f"petrous bench {self.name}, commit {content['commit']}",
             f"{machine.get('processor', 'unknown')}, {machine.get('threads', '?')} threads",
             *rest])
        self.points = [Point(f"{path}: point {n}", entry)
                       for n, entry in enumerate(content["points"], 1)]
        # Petrous first: a program looks the same in every plot of a report.
        self.programs = unique([OURS, *(point.program for point in self.points)])


def unique(values):
    return list(dict.fromkeys(values))


def number(value):
    """A number with three digits, tiny and huge ones as a power of ten."""
    if value == 0.0 or 1e-4 <= abs(value) < 1e5:
        return f"{value:.3g}" if abs(value) < 1000 else f"{value:.0f}"
    exponent = math.floor(math.log10(abs(value)) + 1e-9)
    mantissa = f"{value / 10.0 ** exponent:.3g}"
    power = "10" + str(exponent).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))
    return power if mantissa == "1" else f"{mantissa}·{power}"


def duration(seconds):
    for factor, unit in ((1.0, "s"), (1e3, "ms"), (1e6, "µs")):
        if seconds * factor >= 1.0:
            return f"{number(float(f'{seconds * factor:.3g}'))} {unit}"
    return f"{number(1e9 * seconds)} ns"


# Axes -------------------------------------------------------------------------------------------


def marks_over(values):
    """Marks 1, 2, 5 x 10^n from below the least to above the largest of the positive values."""
    positive = [value for value in values if value > 0.0] or [1.0]
    least, most = 0.93 * min(positive), 1.07 * max(positive)
    decades = range(math.floor(math.log10(least)), math.ceil(math.log10(most)) + 1)
    marks = [float(f"{mark}e{exponent}") for exponent in decades for mark in (1, 2, 5)]
    while len(marks) > 2 and marks[1] <= least:
        del marks[0]
    while len(marks) > 2 and marks[-2] >= most:
        del marks[-1]
    return marks


def is_decade(mark):
    return abs(math.log10(mark) - round(math.log10(mark))) < 1e-6


class LogAxis:
    """A logarithmic axis over all values; 0, and what is 0 but for rounding, lies at its start."""

    def __init__(self, values, room, text):
        """`room`: how many labels there is space for; `text`: of a value."""
        values = list(values)
        self.zero = ZERO * max(values, default=0.0)
        self.marks = marks_over(value for value in values if value > self.zero)
        has_zero = any(value <= self.zero for value in values)
        decades = [mark for mark in self.marks if is_decade(mark)]
        if len(self.marks) <= room:
            labelled = self.marks
        elif len(decades) < 4:
            labelled = self.marks[::2]
        else:  # there is space for powers of ten only
            labelled = decades[::math.ceil(len(decades) / room)]
            self.marks = [self.marks[0], *decades, self.marks[-1]]
        self.low, self.high = self.marks[0], self.marks[-1]
        self.labels = {mark: text(mark) for mark in labelled}
        if has_zero:
            share = (self.high / self.low) ** (1.0 / room)
            self.low /= max(share, 2.0)
            self.labels[self.low] = "0"

    def place(self, value):
        return value if value > self.zero else self.low

    def apply(self, axis):
        scale, limits = ((axis.axes.set_xscale, axis.axes.set_xlim) if axis.axis_name == "x" else
                         (axis.axes.set_yscale, axis.axes.set_ylim))
        scale("log")
        limits(self.low, self.high)
        axis.set_major_locator(FixedLocator(list(self.labels)))
        axis.set_major_formatter(FixedFormatter(list(self.labels.values())))
        axis.set_minor_locator(FixedLocator([m for m in self.marks if m not in self.labels]))
        axis.set_minor_formatter(FixedFormatter([]))
        axis.grid(True, which="both")
        axis.axes.tick_params(axis=axis.axis_name, which="both", length=0, pad=7)


def time_axis(points, room):
    return LogAxis((point.seconds for point in points), room, duration)


class Page:
    """A figure in pixels from its top left, with its title, and its origin in small print."""

    def __init__(self, report, width, height, title):
        width = max(width, 48 + 8 * len(title))
        print_lines = textwrap.wrap(report.measured, int((width - 48) / 4.8))
        height += 11 * (len(print_lines) - 1)
        self.figure = Figure(figsize=(width / DPI, height / DPI), dpi=DPI)
        self.renderer = FigureCanvasAgg(self.figure).get_renderer()
        self.width, self.height = width, height
        self.text(24, 28, title, fontsize=13)
        self.text(24, height - 12, "\n".join(print_lines), fontsize=8, color="#555555")

    def text(self, x, y, words, **style):
        return self.figure.text(x / self.width, 1.0 - y / self.height, words, **style)

    def axes(self, left, top, width, height):
        return self.figure.add_axes((left / self.width, 1.0 - (top + height) / self.height,
                                     width / self.width, height / self.height))

    def legend(self, entries, x, y, columns=1):
        """`entries`: name -> style; with its upper left corner at x, y."""
        handles = [Line2D([], [], label=name, **style) for name, style in entries.items()]
        self.figure.legend(handles=handles, ncol=columns, loc="upper left", borderaxespad=0.0,
                           bbox_to_anchor=(x / self.width, 1.0 - y / self.height),
                           handlelength=2.5, columnspacing=2.0)

    def save(self, path):
        # Neither date nor version: the same figures give the same file.
        self.figure.savefig(path, metadata={"Date": None, "Creator": None}, dpi=DPI)


def style_of(programs, program, line=True):
    n = programs.index(program) % len(COLORS)
    style = {"color": COLORS[n], "marker": MARKERS[n], "markersize": 6.5,
             "linestyle": ("-" if n == 0 else "--") if line else "none", "linewidth": 1.1}
    if n > 0:
        style |= {"markerfacecolor": "white", "markeredgewidth": 1.4}
    return style


RING = {"marker": "o", "markersize": 13, "markerfacecolor": "none", "markeredgecolor": COLORS[0],
        "markeredgewidth": 1.0, "linestyle": "none"}


def legend_of(report, points, line=True):
    present = {point.program for point in points}
    entries = {name: style_of(report.programs, name, line) for name in report.programs
               if name in present}
    if any(point.default for point in points):
        entries["the default"] = RING
    return entries


class Labels:
    """Labels beside points, overlapping neither each other nor a point: a label without space
    beside its point is moved, with a leader line, and omitted if there is no space nearby."""

    # Upper right first: curves of error over time fall.
    WAYS = ((1, 1), (-1, -1), (-1, 1), (1, -1), (1, 0), (-1, 0), (0, 1), (0, -1))
    RINGS, STEP = 6, 13.0  # px

    def __init__(self, page, axes):
        self.page, self.axes, self.taken = page, axes, []
        box = axes.get_window_extent(page.renderer)
        self.within = (box.x0, box.y0, box.x1, box.y1)

    def keep_clear(self, x, y, radius):
        px, py = self.axes.transData.transform((x, y))
        half = 0.7 * radius  # a square within the circle
        self.taken.append((px - half, py - half, px + half, py + half))

    def free(self, box):
        left, bottom, right, top = box
        return (left >= self.within[0] and bottom >= self.within[1] and right <= self.within[2]
                and top <= self.within[3]
                and not any(left < t[2] and t[0] < right and bottom < t[3] and t[1] < top
                            for t in self.taken))

    def add(self, x, y, words, radius, size=9.0):
        text = self.axes.annotate(words, (x, y), xytext=(0, 0), textcoords="offset points",
                                  fontsize=size, ha="center", va="center_baseline")
        extent = text.get_window_extent(self.page.renderer)
        wide, high = 0.5 * extent.width + 1.5, 0.5 * size
        px, py = self.axes.transData.transform((x, y))
        for ring in range(self.RINGS):
            for way in self.WAYS:
                # Diagonally as near as the corner of the text may come; otherwise beside the point.
                near = 0.75 * radius if way[0] and way[1] else radius
                dx = way[0] * (near + 1.0 + wide + self.STEP * ring)
                dy = way[1] * (near + 1.0 + high + self.STEP * ring)
                box = (px + dx - wide, py + dy - high, px + dx + wide, py + dy + high)
                if not self.free(box):
                    continue
                self.taken.append(box)
                text.set_position((dx, dy))
                if ring > 0:
                    end = (dx - way[0] * wide, dy - way[1] * high)
                    self.axes.annotate("", (x, y), xytext=end, textcoords="offset points",
                                       arrowprops={"arrowstyle": "-", "color": "#aaaaaa",
                                                   "linewidth": 0.6, "shrinkA": 0, "shrinkB": 3})
                return
        text.remove()


# Kinds of plots ---------------------------------------------------------------------------------


def same_program(points):
    return {program: [point for point in points if point.program == program]
            for program in unique(point.program for point in points)}


def draw_points(page, axes, points, programs, x, y, label):
    """Time against error, a series joined; labelled where `label` has words for a point."""
    def radius(point):
        return 9.0 if point.default else 5.0

    for program, of_program in same_program(points).items():
        for line in (True, False):
            part = [point for point in of_program if bool(point.series) is line]
            axes.plot([x.place(point.seconds) for point in part],
                      [y.place(point.error) for point in part],
                      **style_of(programs, program, line), clip_on=False, zorder=3)
    labels = Labels(page, axes)
    for point in points:
        at = x.place(point.seconds), y.place(point.error)
        if point.default:
            axes.plot(*at, **RING, clip_on=False, zorder=4)
        labels.keep_clear(*at, radius(point))
    for point in sorted(points, key=lambda point: not point.default):  # the default's first
        if label(point):
            labels.add(x.place(point.seconds), y.place(point.error), label(point), radius(point))


def scatter(report, title, points, label):
    """One panel: x the time, y the error."""
    width, height, right = 820, 520, 250
    page = Page(report, width, height, title)
    wide, high = width - LEFT - right, height - TOP - BOTTOM - 16
    axes = page.axes(LEFT, TOP, wide, high)
    x = time_axis(points, 9)
    y = LogAxis((point.error for point in points), 14, number)
    x.apply(axes.xaxis)
    y.apply(axes.yaxis)
    axes.set_xlabel("time")
    axes.set_ylabel("error, " + points[0].unit)
    draw_points(page, axes, points, report.programs, x, y, label)
    page.legend(legend_of(report, points, line=False), LEFT + wide + 16, TOP)
    return page


def panels(report, title, points, panel_of=lambda point: point.series, label=Point.value,
           others=()):
    """One panel for each varied setting, with common axes; below them the times of programs that
    have no error (`others`)."""
    columns, wide, high, step_x, step_y = 3, 290, 215, 350, 280
    names = unique(panel_of(point) for point in points)
    strip_top = TOP + 52 + step_y * math.ceil(len(names) / columns)
    strip_high = 22 * len(others) + 54 if others else -20
    width = max(LEFT + step_x * min(columns, len(names)), 640)
    page = Page(report, width, strip_top + strip_high + 24, title)
    page.legend(legend_of(report, points), 24, 40, columns=4)
    x = time_axis(points, 6)
    y = LogAxis((point.error for point in points), 12, number)
    for n, name in enumerate(names):
        axes = page.axes(LEFT + step_x * (n % columns), TOP + 36 + step_y * (n // columns), wide,
                         high)
        x.apply(axes.xaxis)
        y.apply(axes.yaxis)
        axes.set_title(name)
        axes.set_xlabel("time")
        if n % columns == 0:
            axes.set_ylabel("error, " + points[0].unit)
        draw_points(page, axes, [point for point in points if panel_of(point) == name],
                    report.programs, x, y, label)
    if others:
        page.text(LEFT, strip_top - 8, "The same scene by other programs, which draw other optics: "
                  "time alone", fontsize=10)
        axes = page.axes(LEFT, strip_top, width - LEFT - 60, 22 * len(others))
        x = time_axis(others, 10)
        x.apply(axes.xaxis)
        axes.set_xlabel("time")
        axes.set_ylim(len(others) - 0.5, -0.5)
        axes.set_yticks([])
        for row, point in enumerate(others):
            axes.plot(point.seconds, row, **style_of(report.programs, point.program, line=False),
                      zorder=3)
            right = point.seconds ** 2 < x.low * x.high
            axes.annotate(f"{point.program}: {duration(point.seconds)}", (point.seconds, row),
                          textcoords="offset points", xytext=(9 if right else -9, 0), fontsize=9,
                          va="center_baseline", ha="left" if right else "right")
    return page


def rows(report, title, points, name_of, label):
    """Times alone: one row per name, one marker per program with `label` above it; the default is
    ringed if the rows differ by more than their scene."""
    names = unique(name_of(point) for point in points)
    left, wide, row = 40 + 5.6 * max(map(len, names)), 620, 28
    ringed = len({point.scene for point in points}) == 1 and len(names) > 1
    legend = legend_of(report, points, line=False)
    if not ringed:
        legend.pop("the default", None)
    top = TOP + 16 * math.ceil(len(legend) / 3)
    page = Page(report, left + wide + 40, top + row * len(names) + BOTTOM + 8, title)
    page.legend(legend, 24, 42, columns=3)
    axes = page.axes(left, top, wide, row * len(names))
    x = time_axis(points, 10)
    x.apply(axes.xaxis)
    axes.set_xlabel("time")
    axes.set_ylim(len(names) - 0.4, -0.85)  # the first row's label lies above its point
    axes.set_yticks(range(len(names)), names, fontsize=9)
    axes.tick_params(axis="y", length=0)
    axes.grid(True, axis="y")
    for point in points:
        at = point.seconds, names.index(name_of(point))
        axes.plot(*at, **style_of(report.programs, point.program, line=False), zorder=3,
                  clip_on=False)
        if ringed and point.default:
            axes.plot(*at, **RING, zorder=4)
        axes.annotate(label(point), at, textcoords="offset points", fontsize=8,
                      xytext=(0, 8), va="baseline", ha="center")
    return page


def measured_rows(report):
    """A row for each scene and program: its time, labelled with that and the error."""
    def label(point):
        unit = point.unit.split(",")[0].split()[0] if point.unit else ""
        error = "" if point.error is None else f", {number(point.error)} {unit}"
        return duration(point.seconds) + error

    words = distinguishing(report.points)
    return rows(report, report.title, report.points,
                lambda p: ", ".join(filter(None, (p.scene, words(p)))) +
                ("" if p.ours() or "filter" in p.setting else f" ({p.program})"), label)


def tilt(report):
    """x: angle of the gantry; y: the largest error, one line per program. Below 1e-5 voxel there is
    but rounding."""
    def height(point):
        return max(point.error, 1e-5)

    points = [point for point in report.points if point.error is not None]
    page = Page(report, LEFT + 600, TOP + 420, report.title)
    axes = page.axes(LEFT, TOP, 560, 280)
    y = LogAxis(map(height, points), 12, number)
    y.apply(axes.yaxis)
    axes.set_xlabel("tilt, degrees")
    axes.set_ylabel("largest error, voxels")
    axes.grid(True)
    for program in report.programs:
        line = [point for point in points if point.program == program]
        axes.plot([float(point.set("tilt_degrees")) for point in line],
                  [y.place(height(point)) for point in line],
                  **style_of(report.programs, program), clip_on=False, zorder=3)
    page.legend({name: style_of(report.programs, name) for name in report.programs},
                LEFT - 8, TOP + 324)
    return page


def growth(report, by, extra, unit):
    """x: the setting `by` (points without a numeric value are omitted); y: time, and the figure
    `extra`. One line per program and scene."""
    def is_number(text):
        try:
            return math.isfinite(float(text))
        except ValueError:
            return False

    points = [point for point in report.points
              if is_number(point.setting.get(by, "")) and extra in point.extras]
    if not points:
        raise BadReport(f"{report.path}: no point has a numeric '{by}' and '{extra}'")
    names = unique(point.scene if point.ours() else point.program for point in points)
    ours = unique(point.scene for point in points if point.ours())
    high, wide, between = 300, 350, 110
    page = Page(report, LEFT + 2 * wide + between + 30, TOP + high + 96 + 20 * len(names),
                report.title)
    x = LogAxis((float(point.set(by)) for point in points), 4, number)
    entries = {}
    for n, (title, get, text) in enumerate((
            ("time", lambda point: point.seconds, duration),
            (unit, lambda point: point.extra(extra), number))):
        axes = page.axes(LEFT + n * (wide + between), TOP, wide, high)
        x.apply(axes.xaxis)
        y = LogAxis(map(get, points), 12, text)
        y.apply(axes.yaxis)
        axes.set_xlabel(by)
        axes.set_ylabel(title)
        for name in names:
            line = [p for p in points if name == (p.scene if p.ours() else p.program)]
            style = style_of(names, name)
            if name in ours[1:]:
                style |= {"linestyle": ":", "markerfacecolor": style["color"]}
            axes.plot([float(p.set(by)) for p in line], [y.place(get(p)) for p in line], **style,
                      clip_on=False, zorder=3)
            for p in line:
                if p.default:
                    axes.plot(float(p.set(by)), y.place(get(p)), **RING, clip_on=False, zorder=4)
            entries[f"{OURS}: {name}" if name in ours else name] = style
    if any(point.default for point in points):
        entries["the default"] = RING
    page.legend(entries, LEFT - 8, TOP + high + 44)
    return page


def tail(report, title, points):
    """Distribution of the live sessions' times: x the time, y the share of the ticks that took
    longer, to the last of them. Only the largest time lies on the axis below; its share is that of
    one tick."""
    sessions = [point for point in points if point.set("of") == "session"]
    kinds = {"tick": "wall time of a tick", "lateness": "start of a tick after it was due"}
    wide, high, between = 400, 330, 60
    page = Page(report, LEFT + 2 * wide + between + 40, TOP + high + 110 + 20 * len(sessions),
                title)
    quantiles = [point for point in points if point.set("of") in kinds]
    least = min((1.0 / point.extra("ticks") for point in sessions), default=1e-4)
    x = LogAxis([max(point.seconds, 1e-6) for point in quantiles] + [2.5e-4, 5e-4], 8, duration)
    y = LogAxis([least, 1.0], 9, number)
    names = [f"{point.set('points')} points" for point in sessions]
    for n, (kind, label) in enumerate(kinds.items()):
        axes = page.axes(LEFT + n * (wide + between), TOP, wide, high)
        x.apply(axes.xaxis)
        y.apply(axes.yaxis)
        axes.set_xlabel(label)
        if n == 0:
            axes.set_ylabel("share of the ticks above")
            for seconds, share in ((2.5e-4, 1e-3), (5e-4, 1e-4)):
                if y.low < share:
                    axes.plot(seconds, share, marker="v", color="#555555", linestyle="none")
        for session, name in zip(sessions, names):
            line = [point for point in quantiles if point.set("of") == kind and
                    point.set("points") == session.set("points")]
            shares = [1.0 - float(point.set("percent")) / 100.0 for point in line]
            one = 1.0 / session.extra("ticks")
            axes.plot([max(point.seconds, 1e-6) for point in line],
                      [max(share, one) for share in shares], **style_of(names, name), zorder=3,
                      clip_on=False)
    entries = {name: style_of(names, name) for name in names}
    if any(y.low < share for share in (1e-3, 1e-4)):
        entries["wanted: 250 µs at 99.9 %, 500 µs at 99.99 %"] = {
            "marker": "v", "color": "#555555", "linestyle": "none"}
    page.legend(entries, LEFT - 8, TOP + high + 44, columns=3)
    for n, (session, name) in enumerate(zip(sessions, names)):
        priority = ("real-time priority" if session.extra("real_time_priority") > 0.5
                    else "no real-time priority")
        page.text(LEFT, TOP + high + 92 + 20 * n,
                  f"{name}: {session.extra('ticks'):.0f} ticks, {priority}, "
                  f"{session.extra('ticks_late'):.0f} late, "
                  f"{session.extra('records_lost'):.0f} records lost, "
                  f"{session.extra('page_faults'):.0f} page faults, "
                  f"{session.extra('ticks_that_left_motion'):.0f} left motion to the next",
                  fontsize=9, color="#555555")
    return page


def servo(report):
    """"": the block's ticks; "-live": the tails of the live sessions."""
    live = [point for point in report.points if point.scene.startswith("live: ")]
    block = [point for point in report.points if point not in live]
    pages = {}
    if block:
        words = distinguishing(block)
        pages[""] = rows(report, report.title, block,
                         lambda p: ", ".join(filter(None, (p.scene, words(p)))),
                         lambda p: duration(p.seconds))
    if live:
        pages["-live"] = tail(report, "Live session at 1 kHz: " + live[0].scene[len("live: "):],
                              live)
    return pages


# Devices ----------------------------------------------------------------------------------------

ENERGY, CYCLE = 0.1, 0.1  # mJ; N, peak to peak: above it a coupling is not stable


def edges_of(values, logarithmic):
    """Borders of the cells around these values."""
    at = [math.log(value) for value in values] if logarithmic else list(values)
    if len(at) == 1:
        at = [at[0] - 0.5, at[0] + 0.5]
        edges = at
    else:
        middle = [0.5 * (a + b) for a, b in zip(at, at[1:])]
        edges = [2 * at[0] - middle[0], *middle, 2 * at[-1] - middle[-1]]
    return [math.exp(edge) for edge in edges] if logarithmic else edges


def device(report, points):
    """Of one device: a panel for each share of missed ticks, with the guard and without. x the
    delay, y the stiffness; the colour is the force's range at rest; crossed out where energy comes
    out."""
    guards = unique(point.set("guard") for point in points)
    missed = unique((point.set("missed_percent"), point.set("missed_at_once")) for point in points)
    wide, high, step_x, step_y = 250, 220, 290, 290
    page = Page(report, LEFT + step_x * len(missed) + 90, TOP + 30 + step_y * len(guards) + 90,
                f"{report.title}: {points[0].scene}")
    stiffnesses = sorted(float(key[len("cycle_n_pp_at_"):]) for key in points[0].extras
                         if key.startswith("cycle_n_pp_at_"))
    keys = {float(key[len("cycle_n_pp_at_"):]): key[len("cycle_n_pp_at_"):]
            for key in points[0].extras if key.startswith("cycle_n_pp_at_")}
    if not stiffnesses:
        raise BadReport(f"{points[0].where}, 'extra' has no 'cycle_n_pp_at_'")
    y_edges = edges_of(stiffnesses, True)
    labels = {k: number(k) for k in (0.25, 0.5, 1.0, 2.0, 4.0, 10.0)}
    lines = {"passive_n_per_mm": ("b / (T/2 + delay)", {"color": "#000000", "linewidth": 1.4}),
             "border_n_per_mm": ("measured border", {"color": "#D55E00", "marker": "s",
                                                     "markersize": 5, "linestyle": "none"}),
             "described_n_per_mm": ("set by the server's description",
                                    {"color": "#009E73", "linestyle": "--", "linewidth": 1.6}),
             "tested_n_per_mm": ("set by device-test", {"color": "#CC79A7", "marker": "D",
                                                        "markersize": 5, "linewidth": 1.2})}
    entries = {}
    for row, guard in enumerate(guards):
        for column, (share, burst) in enumerate(missed):
            part = sorted((point for point in points if point.set("guard") == guard and
                           point.set("missed_percent") == share and
                           point.set("missed_at_once") == burst),
                          key=lambda point: float(point.set("delay_ms")))
            delays = [float(point.set("delay_ms")) for point in part]
            axes = page.axes(LEFT + step_x * column, TOP + 30 + step_y * row, wide, high)
            cycles = [[max(point.extra("cycle_n_pp_at_" + keys[k]), 1e-3) for point in part]
                      for k in stiffnesses]
            mesh = axes.pcolormesh(edges_of(delays, False), y_edges, cycles, cmap="cividis",
                                   norm=LogNorm(1e-2, 1e1))
            wild = [(d, k) for d, point in zip(delays, part) for k in stiffnesses
                    if point.extra("energy_mj_at_" + keys[k]) > ENERGY]
            axes.plot([d for d, _ in wild], [k for _, k in wild], **ENERGETIC, zorder=2)
            edges = edges_of(delays, False)
            stable = [y_edges[0] if point.extra("largest_stable_n_per_mm") == 0.0 else
                      y_edges[1 + min(range(len(stiffnesses)), key=lambda n, p=point: abs(
                          stiffnesses[n] - p.extra("largest_stable_n_per_mm")))]
                      for point in part]
            axes.stairs(stable, edges, baseline=None, **STABLE, zorder=3)
            for name, (words, style) in lines.items():
                line = [(d, point.extra(name)) for d, point in zip(delays, part)
                        if name in point.extras]
                if line:
                    axes.plot(*zip(*line), **style, zorder=4)
                    entries[words] = style
            axes.set_yscale("log")
            axes.set_ylim(y_edges[0], y_edges[-1])
            axes.yaxis.set_major_locator(FixedLocator(list(labels)))
            axes.yaxis.set_major_formatter(FixedFormatter(list(labels.values())))
            axes.yaxis.set_minor_locator(FixedLocator([]))
            axes.set_xticks(delays)
            axes.xaxis.set_major_formatter(FixedFormatter([number(d) for d in delays]))
            axes.tick_params(length=0, pad=6)
            together = "" if burst == "1" else f", {burst} at a time"
            axes.set_title(f"guard {guard}, {share} % of ticks missed{together}")
            axes.set_xlabel("delay, ms")
            if column == 0:
                axes.set_ylabel("stiffness, N/mm")
    bar = page.axes(LEFT + step_x * len(missed) + 6, TOP + 30, 12, high)
    page.figure.colorbar(mesh, cax=bar)
    marks = (1e-2, 1e-1, 1.0, 1e1)
    bar.yaxis.set_major_locator(FixedLocator(list(marks)))
    bar.yaxis.set_major_formatter(FixedFormatter([number(mark) for mark in marks]))
    bar.yaxis.set_minor_locator(FixedLocator([]))
    bar.set_ylabel("range of the force at rest, N")
    entries["largest stable"] = STABLE
    entries["energy out over 0.1 mJ"] = ENERGETIC
    page.legend(entries, LEFT - 8, TOP + 30 + step_y * len(guards) - 6,
                columns=3 if len(missed) > 2 else 2)
    return page


STABLE = {"color": "#ffffff", "linewidth": 2.4,
          "path_effects": [withStroke(linewidth=4.0, foreground="#333333")]}
ENERGETIC = {"marker": "x", "markersize": 5, "color": "#D55E00", "linestyle": "none"}


def devices(report):
    """A page for each device."""
    return {"" if n == 0 else f"-{n + 1}":
            device(report, [point for point in report.points if point.scene == scene])
            for n, scene in enumerate(unique(point.scene for point in report.points))}


# Registration -----------------------------------------------------------------------------------


def calibration(report, points):
    size = 460
    page = Page(report, LEFT + size + 290, TOP + size + BOTTOM + 16,
                "Stated p95 against true error, simulated pairs of known motion")
    axes = page.axes(LEFT, TOP, size, size)
    both = LogAxis([value for p in points for value in (p.extra("p95_mm"), p.error)], 13, number)
    both.apply(axes.xaxis)
    both.apply(axes.yaxis)
    axes.plot([both.low, both.high], [both.low, both.high], color="#888888", linewidth=1.0)
    axes.set_xlabel("stated p95, mm")
    axes.set_ylabel("true error at the ear, mm")
    verdicts = ["good", "doubtful", "failed"]
    entries = {}
    for verdict in verdicts:
        judged = [point for point in points if point.set("verdict") == verdict]
        if not judged:
            continue
        style = style_of(verdicts, verdict, line=False)
        axes.plot([both.place(point.extra("p95_mm")) for point in judged],
                  [both.place(point.error) for point in judged], **style, clip_on=False, zorder=3)
        inside = sum(point.extra("covered") > 0.5 for point in judged)
        entries[f"{verdict}: {inside} of {len(judged)} within, "
                f"{100.0 * inside / len(judged):.1f} %"] = style
    page.legend(entries, LEFT + size + 16, TOP)
    page.text(LEFT + size + 24, TOP + 84, "below the line: covered", fontsize=9, color="#555555")
    return page


def conditions(report, points):
    names = unique(point.scene.split(" ", 1)[1] for point in points)
    wide, high, step = 300, 300, 360
    page = Page(report, LEFT + step * max(2, len(names)), TOP + high + 150,
                "True error at the ear, simulated pairs: median and worst of each condition")
    curves = {"median of the true error": lambda point: point.error,
              "the worst true error": lambda point: point.extra("worst_mm"),
              "median of the stated p95": lambda point: point.extra("stated_p95_mm")}
    y = LogAxis([get(point) for get in curves.values() for point in points], 14, number)
    for n, name in enumerate(names):
        axes = page.axes(LEFT + step * n, TOP + 12, wide, high)
        part = [point for point in points if point.scene == "conditions: " + name]
        y.apply(axes.yaxis)
        for curve, get in curves.items():
            axes.plot([y.place(get(point)) for point in part], **style_of(list(curves), curve),
                      clip_on=False, zorder=3)
        axes.set_xlim(-0.5, len(part) - 0.5)
        axes.set_xticks(range(len(part)), [
            f"{point.set(name)}\n{point.extra('good'):.0f}/{point.extra('pairs'):.0f}"
            for point in part])
        axes.tick_params(axis="x", length=0)
        axes.set_xlabel(name)
        axes.set_title(name)
        if n == 0:
            axes.set_ylabel("error, mm")
    page.legend({curve: style_of(list(curves), curve) for curve in curves}, LEFT - 8,
                TOP + high + 72, columns=3)
    page.text(LEFT, TOP + high + 114, "below the values: how many of the pairs were called good",
              fontsize=9, color="#555555")
    return page


def stress_table(points):
    """Stress trials by kind, followed by each confidently wrong one, as Markdown."""
    def row(name, trials):
        verdicts = Counter(point.set("verdict") for point in trials)
        good = [p.error for p in trials if p.set("verdict") == "good" and p.error is not None]
        worst = f"{max(good):.2f}" if good else ""
        wrong = sum(point.extra("wrong") > 0.5 for point in trials)
        counts = " | ".join(str(verdicts[v]) for v in ("good", "doubtful", "failed", "refused"))
        return f"| {name} | {len(trials)} | {counts} | {worst} | {wrong} |\n"

    def kind(point):
        return point.scene[len("stress: "):]

    table = ("| trial | of them | good | doubtful | failed | refused by the reader | true error of "
             "a good one, worst, mm | confidently wrong |\n|---|---|---|---|---|---|---|---|\n")
    for name in unique(map(kind, points)):
        table += row(name, [point for point in points if kind(point) == name])
    table += row("**all**", points)
    wrong = ""
    for point in points:
        if point.extra("wrong") > 0.5:
            truth = ("no truth exists" if point.error is None
                     else f"true error {point.error:.2f} mm")
            wrong += (f"- {kind(point)} ({point.set('trial')}): {truth}, stated p95 "
                      f"{point.extra('p95_mm'):.2f}, max {point.extra('max_mm'):.2f} mm: "
                      f"\"{point.set('text')}\"\n")
    return ("# Stress trials of the registration\n\nConfidently wrong: the verdict good, and a "
            "true error over 2 mm or over 3 times the stated maximum, or no truth at all.\n\n" +
            table + (f"\nConfidently wrong:\n\n{wrong}" if wrong else ""))


def registration(report):
    """Depending on the parts measured: "" error over time of the pairs; "-schedule" the same for
    each setting; "-conditions", "-calibration", "-stress.md"."""
    def part(beginning):
        return [point for point in report.points if point.scene.startswith(beginning)]

    pages = {}
    pairs = [point for point in report.points
             if point.setting.get("what", "").startswith("fit") and point.error is not None]
    if pairs:
        def label(point):
            if point.ours():
                return point.set("what").replace("fit and ", "+ ")
            schedule = point.setting.get("schedule", "")  # "3 x 50, 32 bins" becomes "3x50/32"
            return schedule.replace(" x ", "x").replace(", ", "/").removesuffix(" bins")

        pages[""] = panels(
            report, "Registration: time of a fit (+ error estimate) against true error; elastix by "
            "levels x iterations / bins", pairs, lambda point: point.scene, label)
    if part("schedule"):
        pages["-schedule"] = panels(
            report, "Time of a fit against mean error at the target, one setting varied at a time",
            part("schedule"))
    if part("conditions: "):
        pages["-conditions"] = conditions(report, part("conditions: "))
    if part("calibration"):
        pages["-calibration"] = calibration(report, part("calibration"))
    if part("stress: "):
        pages["-stress.md"] = stress_table(part("stress: "))
    return pages


# Files ------------------------------------------------------------------------------------------


def distinguishing(points):
    """What tells the points of one program apart: settings that differ, as words."""
    keys = unique(key for point in points for key in point.setting)
    differing = [key for key in keys if key not in ("default", "reader", "scene") and
                 len({str(point.setting.get(key)) for point in points}) > 1]
    return lambda point: ", ".join(f"{key} {point.setting[key]}" for key in differing
                                   if key in point.setting)


def pages_of(report):
    """The files beside the report: ending of the name -> page, or text."""
    if not report.points:
        raise BadReport(f"{report.path}: has no points")
    if report.name == "registration":
        return registration(report)
    if report.name == "history":
        return {"": growth(report, "strokes", "memory_mb", "memory, MB")}
    if report.name == "nerve":
        return {"": growth(report, "spacing_mm", "max_mm", "largest distance from the axis, mm")}
    if report.name in ("library", "node", "segment", "structures"):
        return {"": measured_rows(report)}
    if report.name == "tilt":
        return {"": tilt(report)}
    if report.name == "devices":
        return devices(report)
    if report.name == "servo" and any(p.scene.startswith("live: ") for p in report.points):
        return servo(report)
    plain = [point for point in report.points if not point.series]
    scenes = unique(point.scene for point in report.points if point.series)
    if not scenes and report.name != "renderer":  # whose parts have errors of different units
        words = distinguishing(plain)
        measured = [point for point in plain if point.error is not None]
        if any(point.error > 0.0 for point in measured):
            return {"": scatter(report, report.title, measured, words)}
        exact = f"; error of all: 0 {measured[0].unit}" if measured else ""
        return {"": rows(report, report.title + exact, plain,
                         lambda p: ", ".join(filter(None, (p.scene, words(p)))),
                         lambda p: duration(p.seconds))}
    pages = {}
    for n, scene in enumerate(scenes):
        part = [p for p in report.points
                if p.scene == scene and (p.series or p.error is None or p.default)]
        varied = [p for p in part if p.series and p.error is not None]
        pages["" if n == 0 else f"-{n + 1}"] = panels(
            report, f"{report.title}: {scene}", varied, others=[p for p in part if not p.series])
    if plain:
        pages["-frames"] = rows(report, f"{report.title} (median time alone)", plain,
                                lambda p: p.scene,
                                lambda p: duration(p.seconds) if p.ours() else "")
    return pages


def draw(path):
    """Writes what belongs to one JSON file; returns the paths."""
    report = Report(path)
    written = []
    for ending, page in pages_of(report).items():
        target = path.with_name(path.stem + ending + ("" if "." in ending else ".svg"))
        if isinstance(page, str):
            target.write_text(page, encoding="utf-8")
        else:
            page.save(target)
        written.append(target)
    return written


def main(arguments):
    if len(arguments) > 1 or any(argument.startswith("-") for argument in arguments):
        print(__doc__)
        return 0 if arguments in (["-h"], ["--help"]) else 2
    folder = (Path(arguments[0]) if arguments else
              Path(__file__).resolve().parents[2] / "Documentation" / "benchmarks")
    files = sorted(folder.glob("*.json"))
    if not files:
        print(f"plots.py: {folder}: no JSON files of petrous bench", file=sys.stderr)
        return 1
    failed = False
    for path in files:
        try:
            for target in draw(path):
                print(target)
        except (BadReport, OSError) as error:
            print(f"plots.py: {error}", file=sys.stderr)
            failed = True
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

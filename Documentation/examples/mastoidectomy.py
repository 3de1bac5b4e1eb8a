#!/usr/bin/env python3
"""Plans the mastoidectomy and the retrosigmoid approach of the user guide.

usage: mastoidectomy.py CT.nrrd OUT

CT.nrrd is `petrous export --what ct` of the Visible Human's head at 1 mm (series vhm_1080-1245,
left ear). Into OUT come two structures, sigmoid_sinus.nrrd and dura.nrrd, the tool paths of the
strokes, and look and cameras of the pictures. The dura is the border of the soft tissue within the
skull; the sigmoid sinus is what of this tissue lies in the sinus' groove, whose course is given
below as it was read off the slices. A path leads the burr's centre over a floor that keeps a
distance from all that is to be spared, in layers from the cortex inwards. All positions are patient
LPS, mm. Nothing but Python's own library is needed.
"""
import array
import gzip
import json
import math
import sys
from pathlib import Path

BOX = ((276, 334), (244, 314), (1100, 1146))  # what is looked at
FINE = 0.5                                    # its grid
BONE, CELL = 180.0, -150.0                    # HU: bone above, air below
BRAIN = (280, 285, 1130)                      # a place within the skull
SKULL_BASE = 1113.0                           # z: below, the neck is reached through foramina
SINUS = ((304, 288, 1146), (303, 286, 1138), (302, 283, 1131), (300, 279, 1126),
         (297, 275, 1121), (294, 271, 1116), (289, 269, 1110))
SINUS_RADIUS = 4.5
CANAL = ((284, 247, 1125), (300, 247, 1122), (316, 245, 1117))  # ear canal: line and radius
CANAL_RADIUS = 4.5
LABYRINTH = ((288, 252, 1130), 7.5)
OUTSIDE = 340.0                               # x of the tool between strokes

# Outlines of the craters on the cortex and DEPTH mm below it, (y, z), as a surgeon would draw them:
# steep along the canal's back wall, sloping where tool and eye come from.
DEPTH = 12.0
MASTOID = ((252, 1133), (259, 1140), (272, 1141), (283, 1137), (288, 1128), (284, 1116),
           (275, 1107), (266, 1103), (260, 1106), (255, 1116), (251, 1126))
MASTOID_FLOOR = ((254, 1131), (260, 1137), (270, 1138), (279, 1134), (282, 1127), (278, 1117),
                 (271, 1111), (264, 1108), (260, 1111), (257, 1118), (254, 1126))
BEHIND = ((284, 1136), (297, 1140), (305, 1138), (309, 1130), (306, 1122), (298, 1118),
          (289, 1119), (283, 1128))
BEHIND_FLOOR = ((287, 1134), (297, 1137), (303, 1135), (306, 1130), (303, 1124), (298, 1121),
                (291, 1122), (286, 1128))

SHAFT = (0.97, 0.20, 0.12)                    # from the burr to the hand
SHAFT_BEHIND = (0.80, 0.42, 0.42)

# Thin bone lets shine through what lies behind it.
BONE_LOOK = {"points": [
    {"value": 180, "color": [0.88, 0.74, 0.58], "opacity": 0.10, "specular": 0.35},
    {"value": 700, "color": [0.93, 0.84, 0.69], "opacity": 0.30, "specular": 0.5},
    {"value": 1800, "color": [0.96, 0.93, 0.85], "opacity": 0.95, "specular": 0.6}]}
CAMERAS = {"mastoid": ((530, 250, 1150), (312, 271, 1123)),
           "behind": ((485, 385, 1150), (304, 293, 1128))}  # from, to


def read_ct(name):
    data = Path(name).read_bytes()
    head, body = data.split(b"\n\n", 1)
    fields = dict(line.split(": ", 1) for line in head.decode().splitlines() if ": " in line)
    sizes = [int(n) for n in fields["sizes"].split()]
    origin = [float(c) for c in fields["space origin"].strip("()").split(",")]
    if fields["space directions"].split() != ["(1,0,0)", "(0,1,0)", "(0,0,1)"]:
        sys.exit("mastoidectomy: this plan is for the head at 1 mm")
    voxels = array.array("h")
    voxels.frombytes(gzip.decompress(body) if fields["encoding"] == "gzip" else body)
    return voxels, sizes, origin


class Grid:
    """Values at FINE mm over BOX, x fastest."""

    def __init__(self, values=None):
        self.n = [int((b - a) / FINE) + 1 for a, b in BOX]
        self.stride = (1, self.n[0], self.n[0] * self.n[1])
        self.count = self.n[0] * self.n[1] * self.n[2]
        self.values = values if values is not None else [0.0] * self.count

    def index(self, point):
        at = [min(max(round((p - low) / FINE), 0), n - 1)
              for p, (low, _), n in zip(point, BOX, self.n)]
        return sum(i * s for i, s in zip(at, self.stride))

    def at_edge(self, n):
        return any(n // s % m in (0, m - 1) for s, m in zip(self.stride, self.n))

    def points(self):
        for k in range(self.n[2]):
            for j in range(self.n[1]):
                for i in range(self.n[0]):
                    yield (BOX[0][0] + FINE * i, BOX[1][0] + FINE * j, BOX[2][0] + FINE * k)

    def save(self, name):
        low = [side[0] for side in BOX]
        head = ("NRRD0004\ntype: uint8\ndimension: 3\nspace: left-posterior-superior\n"
                "sizes: %d %d %d\nspace directions: (%g,0,0) (0,%g,0) (0,0,%g)\n"
                "kinds: domain domain domain\nencoding: gzip\nspace origin: (%g,%g,%g)\n\n"
                % (*self.n, FINE, FINE, FINE, *low))
        Path(name).write_bytes(head.encode() + gzip.compress(bytes(self.values), mtime=0))


def resampled(ct):
    """HU on the fine grid, trilinear."""
    voxels, sizes, origin = ct
    row, slab = sizes[0], sizes[0] * sizes[1]
    grid = Grid()
    for n, point in enumerate(grid.points()):
        at = [p - o for p, o in zip(point, origin)]
        i, j, k = (int(a) for a in at)
        a, b, c = at[0] - i, at[1] - j, at[2] - k
        v = k * slab + j * row + i
        planes = []
        for w in (v, v + slab):
            planes.append((voxels[w] * (1 - a) + voxels[w + 1] * a) * (1 - b)
                          + (voxels[w + row] * (1 - a) + voxels[w + row + 1] * a) * b)
        grid.values[n] = planes[0] * (1 - c) + planes[1] * c
    return grid


def squared_distances(inside, grid):
    """Exact squared distances in mm² to the points of `inside` (Felzenszwalb)."""
    far = 1e6
    d = [0.0 if i else far for i in inside]
    for axis in range(3):
        n, stride = grid.n[axis], grid.stride[axis]
        others = [a for a in range(3) if a != axis]
        for u in range(grid.n[others[0]]):
            for w in range(grid.n[others[1]]):
                first = u * grid.stride[others[0]] + w * grid.stride[others[1]]
                line = d[first:first + n * stride:stride]
                if min(line) < far:
                    d[first:first + n * stride:stride] = envelope(line)
    return [v * FINE * FINE for v in d]


def envelope(line):
    hull, starts = [], []
    for q, f in enumerate(line):
        if f >= 1e6:
            continue
        start = -math.inf
        while hull:
            v = hull[-1]
            start = (f + q * q - line[v] - v * v) / (2.0 * (q - v))
            if start > starts[-1]:
                break
            hull.pop()
            starts.pop()
        if not hull:
            start = -math.inf
        hull.append(q)
        starts.append(start)
    out, m = [], 0
    for q in range(len(line)):
        while m + 1 < len(hull) and starts[m + 1] < q:
            m += 1
        out.append((q - hull[m]) ** 2 + line[hull[m]])
    return out


def to_line(point, line):
    best = math.inf
    for a, b in zip(line, line[1:]):
        ab = [q - p for p, q in zip(a, b)]
        t = sum((p - q) * r for p, q, r in zip(point, a, ab)) / sum(r * r for r in ab)
        t = min(max(t, 0.0), 1.0)
        best = min(best, math.dist(point, [p + t * r for p, r in zip(a, ab)]))
    return best


def within_skull(hu):
    """Soft tissue that a ball of 1.5 mm reaches from the brain: it does not fit through the
    gaps of a thin plate. Then 1.5 mm outwards again, up to bone and air."""
    soft = [CELL < v < BONE for v in hu.values]
    room = squared_distances([not s for s in soft], hu)
    open_to = [d >= 1.5 * 1.5 for d in room]
    reached = [False] * hu.count
    floor = hu.index((BOX[0][0], BOX[1][0], SKULL_BASE))
    first = hu.index(BRAIN)
    front = [first]
    reached[first] = True
    steps = [s * sign for s in hu.stride for sign in (1, -1)]
    while front:
        n = front.pop()
        for step in steps:
            m = n + step
            if hu.at_edge(m):
                continue
            if floor <= m < hu.count and open_to[m] and not reached[m]:
                reached[m] = True
                front.append(m)
    near = squared_distances(reached, hu)
    return [s and d <= 1.5 * 1.5 for s, d in zip(soft, near)]


def in_outline(y, z, outline):
    """Distance to the outline, mm, positive within."""
    inside, nearest = False, math.inf
    for (y0, z0), (y1, z1) in zip(outline, outline[1:] + outline[:1]):
        if (z0 > z) != (z1 > z) and y < y0 + (y1 - y0) * (z - z0) / (z1 - z0):
            inside = not inside
        nearest = min(nearest, to_line((y, z), ((y0, z0), (y1, z1))))
    return nearest if inside else -nearest


class Plan:
    def __init__(self, hu, inside):
        self.hu = hu
        self.dura = [math.sqrt(d) for d in squared_distances(inside, hu)]
        self.surfaces = {}

    def surface(self, y, z):
        """x of the cortex, smoothed over 4 mm."""
        key = (round(y), round(z))
        if key not in self.surfaces:
            found = []
            for dy in (-2, 0, 2):
                for dz in (-2, 0, 2):
                    at = self.hu.index((BOX[0][1], key[0] + dy, key[1] + dz))
                    hit = next((i for i in range(self.hu.n[0]) if self.hu.values[at - i] > BONE),
                               None)
                    if hit is not None:
                        found.append(BOX[0][1] - FINE * hit)
            self.surfaces[key] = sum(found) / len(found) if found else BOX[0][0]
        return self.surfaces[key]

    def spared(self, point, radius, bone):
        """Whether a burr there leaves `bone` mm over the dura, and canal and labyrinth alone."""
        return (self.dura[self.hu.index(point)] >= radius + bone
                and to_line(point, CANAL) >= CANAL_RADIUS + radius
                and math.dist(point, LABYRINTH[0]) >= LABYRINTH[1] + radius)

    def floor(self, y, z, radius, bone, outlines):
        """x of the burr's centre at the deepest place that it may go to from outside."""
        rim, bottom = (in_outline(y, z, line) for line in outlines)
        if rim < -1.0:
            return None
        cortex = self.surface(y, z)
        x, deepest = cortex + radius + 2.0, BOX[0][0]
        if bottom < 0.0:  # between the two outlines
            deepest = cortex + radius - DEPTH * max(rim, 0.0) / (max(rim, 0.0) - bottom)
        while x - 0.25 >= deepest and self.spared((x - 0.25, y, z), radius, bone):
            x -= 0.25
        return x


def smoothed(floors):
    """Mean over 3 × 3 neighbours, and never deeper than before."""
    out = {}
    for (m, n), x in floors.items():
        near = [floors[(m + a, n + b)] for a in (-1, 0, 1) for b in (-1, 0, 1)
                if (m + a, n + b) in floors]
        out[(m, n)] = max(x, sum(near) / len(near))
    return out


def heading(shaft):
    """The quaternion that takes +z to the shaft's direction."""
    length = math.sqrt(sum(c * c for c in shaft))
    x, y, z = (c / length for c in shaft)
    size = math.sqrt((1 + z) ** 2 + x * x + y * y)
    return ((1 + z) / size, -y / size, x / size, 0.0)


def write_path(name, plan, outlines, shaft, radius, bone, depths, row, speed):
    """Rows along z, to and fro, at growing depths below the cortex and nowhere below the floor; a
    row that lies as in the layer before is left out. Where `depth` exceeds all bone it is the floor.
    """
    floors = {}
    ys = [p[0] for p in outlines[0]]
    zs = [p[1] for p in outlines[0]]
    rows_of = int((max(ys) - min(ys)) / row) + 1
    points_of = int((max(zs) - min(zs)) / row) + 1
    for m in range(rows_of):
        for n in range(points_of):
            y, z = min(ys) + m * row, min(zs) + n * row
            x = plan.floor(y, z, radius, bone, outlines)
            if x is not None:
                floors[(m, n)] = x
    floors = smoothed(floors)
    time, previous, lines = 0.0, None, []
    quaternion = heading(shaft)

    def go(point, drill):
        nonlocal time, previous
        if previous is not None:
            fast = speed if drill else 60.0
            time += max(math.dist(point, previous) / fast, 0.02)
        previous = point
        lines.append("%.3f,%.2f,%.2f,%.2f,%.9f,%.9f,%.9f,%.9f,%d\n"
                     % (time, *point, *quaternion, drill))

    def place(m, n, depth):
        y, z = min(ys) + m * row, min(zs) + n * row
        return (max(floors[(m, n)], plan.surface(y, z) + radius - depth), y, z)

    before = {}
    for depth in depths:
        for m in range(rows_of):
            line = [n for n in range(points_of) if (m, n) in floors]
            if not line:
                continue
            places = [place(m, n, depth) for n in (line if m % 2 == 0 else line[::-1])]
            if before.get(m) == sorted(places) and depth != depths[-1]:
                continue
            before[m] = sorted(places)
            if previous is None:
                go((OUTSIDE, *places[0][1:]), 0)
            for point in places:
                go(point, 1)
    last = previous
    lines[-1] = lines[-1][:-2] + "0\n"
    go((OUTSIDE, *last[1:]), 0)
    Path(name).write_text("t_s,x_mm,y_mm,z_mm,qw,qx,qy,qz,drill\n" + "".join(lines))
    print("%s: %.0f s, %d places" % (name, time, len(lines)))


def main(ct, out):
    out = Path(out)
    out.mkdir(parents=True, exist_ok=True)
    hu = resampled(read_ct(ct))
    inside = within_skull(hu)
    (out / "bone.json").write_text(json.dumps(BONE_LOOK))
    for name, (position, focus) in CAMERAS.items():
        (out / (name + ".json")).write_text(json.dumps(
            {"position_mm": position, "focal_point_mm": focus, "view_up": (0, 0, 1),
             "view_angle_deg": 11.5}))
    course = [to_line(p, SINUS) for p in hu.points()]
    sinus = Grid([int(i and c < SINUS_RADIUS) for i, c in zip(inside, course)])
    sinus.save(out / "sigmoid_sinus.nrrd")
    # A skin, apart from the sinus by a voxel and a half: each then has a smooth border of its own.
    outwards = squared_distances([not i for i in inside], hu)
    dura = Grid([int(i and d <= 1.5 * 1.5 and c > SINUS_RADIUS + 1.5 * FINE)
                 for i, d, c in zip(inside, outwards, course)])
    dura.save(out / "dura.nrrd")
    plan = Plan(hu, inside)
    mastoid, behind = (MASTOID, MASTOID_FLOOR), (BEHIND, BEHIND_FLOOR)
    write_path(out / "cortex.csv", plan, mastoid, SHAFT, 3.0, 2.0, (2, 4), 1.5, 15.0)
    write_path(out / "deepen.csv", plan, mastoid, SHAFT, 3.0, 1.5, (*range(6, 24, 2), 30), 1.5,
               10.0)
    write_path(out / "thin.csv", plan, mastoid, SHAFT, 2.0, 1.0, (30, 30), 1.0, 8.0)
    # The nearer the burr is to the hand the less it is pressed, so it comes to the floor slowly.
    write_path(out / "behind.csv", plan, behind, SHAFT_BEHIND, 3.0, 1.0,
               (2, 4, 6, 8, 10, 12, 30, 30, 30), 1.5, 8.0)
    write_path(out / "plate.csv", plan, behind, SHAFT_BEHIND, 2.0, 1.0, (30, 30), 1.0, 8.0)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])

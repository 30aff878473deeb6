"""Charts as SVG, in one style: axes with units, lines, scatter with labels that do not overlap."""

import itertools
import math

INK, PALE, GRID = "#1f2933", "#616e7c", "#e4e7eb"
OURS, COLOURS = "#0b63ce", {"occt": "#c2410c", "sisl": "#15803d", "cgal": "#7e22ce"}
SERIES = ["#0b63ce", "#c2410c", "#15803d", "#7e22ce", "#b45309", "#0e7490"]
FONT = "font-family='Helvetica, Arial, sans-serif'"
# Width of a letter as a share of the size of the type, roughly.
LETTER = 0.6


def escaped(text):
    return str(text).replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")


def figure(value):
    """A number as an axis or a label shows it."""
    if value == 0:
        return "0"
    if abs(value) >= 1000:
        return f"{value:,.0f}"
    return f"{value:.3g}" if abs(value) >= 1e-3 else f"{value:.0e}".replace("e-0", "e-")


class Axis:
    """Values to a stretch of pixels, by logarithm or not."""

    def __init__(self, low, high, start, end, log=True):
        self.low, self.high, self.start, self.end, self.log = low, high, start, end, log

    def at(self, value):
        value = min(max(value, self.low), self.high)
        if self.log:
            share = math.log(value / self.low) / math.log(self.high / self.low)
        else:
            share = (value - self.low) / (self.high - self.low)
        return self.start + share * (self.end - self.start)

    def ticks(self):
        if not self.log:
            step = 10 ** math.floor(math.log10((self.high - self.low) / 2))
            while (self.high - self.low) / step > 8:
                step *= 2
            first = math.ceil(self.low / step)
            return [k * step for k in range(first, int(self.high / step + 1e-9) + 1)]
        powers = range(math.ceil(math.log10(self.low) - 1e-9), math.floor(math.log10(self.high) + 1e-9) + 1)
        return [10.0**k for k in powers]


class Drawing:
    def __init__(self, width, height, title):
        self.width, self.height = width, height
        # What is drawn; the boxes of dots and texts, and of texts alone.
        self.parts, self.taken, self.texts = [], [], []
        self.text(width / 2, 24, title, size=16, anchor="middle", weight="bold")

    def add(self, part):
        self.parts.append(part)

    def line(self, x1, y1, x2, y2, colour=INK, width=1.0, dash=""):
        dash = f" stroke-dasharray='{dash}'" if dash else ""
        self.add(f"<line x1='{x1:.1f}' y1='{y1:.1f}' x2='{x2:.1f}' y2='{y2:.1f}' stroke='{colour}' stroke-width='{width}'{dash}/>")

    def text(self, x, y, text, size=12, anchor="start", colour=INK, weight="normal", turn=0):
        turned = f" transform='rotate({turn} {x:.1f} {y:.1f})'" if turn else ""
        self.add(f"<text x='{x:.1f}' y='{y:.1f}' font-size='{size}' text-anchor='{anchor}' fill='{colour}' "
                 f"font-weight='{weight}'{turned}>{escaped(text)}</text>")
        wide = LETTER * size * len(str(text))
        left = x - wide * {"start": 0, "middle": 0.5, "end": 1}[anchor]
        self.texts.append((left, y - 0.8 * size, left + wide, y + 0.2 * size))
        self.taken.append(self.texts[-1])

    def dot(self, x, y, colour, hollow=False, size=5.0):
        fill = "white" if hollow else colour
        self.add(f"<circle cx='{x:.1f}' cy='{y:.1f}' r='{size}' fill='{fill}' stroke='{colour}' stroke-width='1.8'/>")
        self.taken.append((x - size - 1, y - size - 1, x + size + 1, y + size + 1))

    def curve(self, points, colour, dash="", width=2.0):
        path = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
        dash = f" stroke-dasharray='{dash}'" if dash else ""
        self.add(f"<polyline points='{path}' fill='none' stroke='{colour}' stroke-width='{width}' stroke-linejoin='round'{dash}/>")

    def frame(self, x, y, x_title, y_title, x_ticks=None, y_ticks=None, x_names=None, below=0):
        """Grid and names of both axes. `x_names`: texts in the place of numbers. `below`: room for a lane under the plot."""
        bottom = y.start + below
        for value in x_ticks if x_ticks is not None else x.ticks():
            self.line(x.at(value), bottom, x.at(value), y.end, GRID)
            name = x_names[value] if x_names else figure(value)
            self.text(x.at(value), bottom + 17, name, size=11, anchor="middle", colour=PALE)
        for value in y_ticks if y_ticks is not None else y.ticks():
            self.line(x.start, y.at(value), x.end, y.at(value), GRID)
            self.text(x.start - 7, y.at(value) + 4, figure(value), size=11, anchor="end", colour=PALE)
        self.line(x.start, y.start, x.end, y.start, PALE)
        self.line(x.start, y.start, x.start, y.end, PALE)
        self.text((x.start + x.end) / 2, bottom + 36, x_title, anchor="middle")
        middle = (y.start + y.end) / 2
        self.text(x.start - 54, middle, y_title, anchor="middle", turn=-90)

    def label(self, x, y, text, colour, bounds, size=11.5):
        """The text beside a dot, where neither dots nor other labels nor `bounds` are in the way."""
        wide = LETTER * size * len(text) * (1.07 if colour == OURS else 1)
        for far, degrees in itertools.product((9, 16, 26, 38, 52, 68, 86, 106), (0, 180, 270, 90, 315, 225, 45, 135, 340, 200, 20, 160)):
            dx, dy = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
            beside = 0 if abs(dx) < 0.3 else math.copysign(1, dx)
            over = 0 if beside else math.copysign(1, dy)
            end = (x + far * dx, y + far * dy)
            middle = (end[0] + beside * wide / 2, end[1] + over * size / 2)
            box = (middle[0] - wide / 2 - 2, middle[1] - size / 2 - 2, middle[0] + wide / 2 + 2, middle[1] + size / 2 + 2)
            if self.free(box, bounds) and self.clear(x, y, *end):
                if far > 16:
                    self.line(x, y, *end, colour, 0.7)
                self.text(middle[0], middle[1] + 0.35 * size, text, size=size, anchor="middle", colour=colour,
                          weight="bold" if colour == OURS else "normal")
                return

    def free(self, box, bounds):
        inside = box[0] >= bounds[0] and box[1] >= bounds[1] and box[2] <= bounds[2] and box[3] <= bounds[3]
        apart = lambda other: box[2] < other[0] or box[0] > other[2] or box[3] < other[1] or box[1] > other[3]
        return inside and all(apart(other) for other in self.taken)

    def clear(self, x1, y1, x2, y2):
        """Whether a line passes no text."""
        points = [(x1 + (x2 - x1) * k / 20, y1 + (y2 - y1) * k / 20) for k in range(20)]
        return not any(box[0] <= x <= box[2] and box[1] <= y <= box[3] for x, y in points for box in self.texts)

    def legend(self, x, y, entries):
        """Lines of (text, colour, dash)."""
        for k, (text, colour, dash) in enumerate(entries):
            self.curve([(x, y + 19 * k), (x + 26, y + 19 * k)], colour, dash)
            self.text(x + 33, y + 19 * k + 4, text)

    def write(self, path):
        head = (f"<svg xmlns='http://www.w3.org/2000/svg' width='{self.width}' height='{self.height}' "
                f"viewBox='0 0 {self.width} {self.height}' {FONT}>\n<rect width='100%' height='100%' fill='white'/>\n")
        path.write_text(head + "\n".join(self.parts) + "\n</svg>\n")

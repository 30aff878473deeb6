"""The files of the drivers, read and condensed. Times are in microseconds."""

import json
import math
import pathlib
import statistics
from collections import defaultdict
from dataclasses import dataclass, field

# Farther than the truth by more than this share of the diagonal is wrong.
WRONG = 1e-7


def median(values):
    values = [v for v in values if not math.isnan(v)]
    return statistics.median(values) if values else math.nan


def share_below(values, share):
    values = sorted(values)
    return values[min(len(values) - 1, int(share * len(values)))] if values else math.nan


@dataclass
class DuelCase:
    """One case of a duel: theirs and ours in turns."""

    name: str
    set_up: float
    our_set_up: float
    batch: float
    batch_of_two: float
    # (class, state, time, excess, our time, our excess)
    queries: list = field(default_factory=list)

    def times(self, ours=False):
        return [q[4 if ours else 2] for q in self.queries if not math.isnan(q[2])]


def read_duel(path):
    cases = []
    for line in path.read_text().splitlines():
        words = line.split(",")
        if words[0] == "case":
            numbers = [float(w) for w in words[4:]]
            cases.append(DuelCase(words[1], numbers[0] * 1e6, numbers[1] * 1e6, numbers[2] / 1e3, numbers[3] / 1e3))
        else:
            theirs, excess, ours, our_excess = (float(w) for w in words[3:])
            cases[-1].queries.append((words[1], words[2], theirs / 1e3, excess, ours / 1e3, our_excess))
    return [case for case in cases if case.queries]


@dataclass
class Duel:
    """What one call did on one group of cases."""

    cases: list

    def __bool__(self):
        return any(case.times() for case in self.cases)

    def queries(self):
        return [q for case in self.cases for q in case.queries]

    def wrong(self, ours=False):
        found = [q[5 if ours else 3] for q in self.queries()]
        return sum(not e <= WRONG for e in found) / len(found)

    def state(self, *names):
        return sum(q[1] in names for q in self.queries())

    def medians(self, ours=False):
        return [median(case.times(ours)) for case in self.cases]

    def means(self, ours=False):
        return [statistics.fmean(case.times(ours)) for case in self.cases if case.times()]

    def batches(self):
        return [case.batch if case.batch > 0 else math.nan for case in self.cases]

    def worst(self):
        return max(t for case in self.cases for t in case.times())

    def ratios(self, batch=False):
        """Their median over ours, case by case. With `batch`: their mean over what a query costs in our batch."""
        if batch:
            pairs = [(statistics.fmean(c.times()), c.batch) for c in self.cases if c.times() and c.batch > 0]
        else:
            pairs = [(median(c.times()), median(c.times(True))) for c in self.cases if c.times()]
        return [a / b for a, b in pairs]

    def class_time(self, kind):
        return median([median([q[2] for q in case.queries if q[0] == kind]) for case in self.cases])


def duel_of(raw, call, prefix):
    path = raw / f"{call.key}.csv"
    return Duel([c for c in read_duel(path) if c.name.startswith(prefix)] if path.exists() else [])


PLAIN, HINT, WALK = 0, 1, 2


@dataclass
class LatencyCase:
    name: str
    pieces: int
    set_up: float
    memory: float
    batch: float
    batch_of_two: float
    batch_hinted: float
    unproven: int
    classes: dict = field(default_factory=dict)
    # (class, (time, time with hint, time with a closer one), excess)
    queries: list = field(default_factory=list)

    def times(self, kind=PLAIN):
        return [q[1][kind] for q in self.queries]


def read_latency(path):
    cases = []
    for line in path.read_text().splitlines() if path.exists() else []:
        words = line.split(",")
        if words[0] == "case":
            n = [float(w) for w in words[3:]]
            cases.append(LatencyCase(words[1], int(n[0]), n[1] * 1e6, n[2], n[3] / 1e3, n[4] / 1e3, n[5] / 1e3, int(n[6])))
        elif words[0] == "class":
            cases[-1].classes[words[1]] = float(words[2]) / 1e3
        else:
            times = tuple(float(w) / 1e3 for w in words[2:5])
            cases[-1].queries.append((words[1], times, float(words[5])))
    return cases


def read_growth(path):
    """Lists of rows by experiment and kind; times are still nanoseconds and seconds."""
    rows = defaultdict(list)
    for line in path.read_text().splitlines() if path.exists() else []:
        words = line.split(",")
        rows[words[0], words[1]].append([float(w) for w in words[2:]])
    return rows


def read_scenes(path):
    """(name, scene, nearest member alone, with a hint, worst, wrong, not proven), times in microseconds."""
    lines = [line.split(",") for line in path.read_text().splitlines()] if path.exists() else []
    return [(words[1], *map(float, words[2:])) for words in lines]


class Figures:
    def __init__(self, out):
        raw = pathlib.Path(out) / "raw"
        self.raw = raw
        self.about = json.loads((raw / "run.json").read_text())
        self.latency = read_latency(raw / "latency.csv")
        self.growth = read_growth(raw / "growth.csv")
        self.scenes = read_scenes(raw / "scene.csv")
        self.cache = {}

    def duel(self, call, prefix):
        key = (call.key, prefix)
        if key not in self.cache:
            self.cache[key] = duel_of(self.raw, call, prefix)
        return self.cache[key]

    def ours(self, prefix):
        return [case for case in self.latency if case.name.startswith(prefix)]

"""Cancelling, progress, forks, the GIL."""

import multiprocessing
import os
import signal
import sys
import threading
import time

import numpy as np
import pytest
from shapes import circle, cloud, wavy

import footpoint

posix = pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork here")


def interrupted_after(seconds, work):
    timer = threading.Timer(seconds, lambda: os.kill(os.getpid(), signal.SIGINT))
    timer.start()
    start = time.perf_counter()
    with pytest.raises(KeyboardInterrupt):
        work()
    return time.perf_counter() - start


@posix
def test_keyboard_interrupt():
    surface, points = wavy(), cloud(3_000_000)
    assert interrupted_after(0.3, lambda: surface.closest(points)) < 10
    slow = footpoint.Curve.from_function(lambda u, order: [np.cos(u), np.sin(u), u], [0, 6], second_bound=1)
    assert interrupted_after(0.3, lambda: slow.closest(points)) < 10
    scene = footpoint.Scene([surface])
    assert interrupted_after(0.3, lambda: scene.closest(points)) < 10
    assert surface.closest(points[:5]).proven.all()


def test_should_stop_and_errors_in_callbacks():
    surface, points = wavy(), cloud(200_000)
    with pytest.raises(footpoint.Cancelled) as caught:
        surface.closest(points, should_stop=lambda: True)
    assert np.isnan(caught.value.feet.distance).any()

    def wrong(*_):
        raise ZeroDivisionError("mine")

    for option in ("should_stop", "progress", "trace"):
        with pytest.raises(ZeroDivisionError, match="mine"):
            surface.closest(points[:50_000], **{option: wrong})
    with pytest.raises(footpoint.Cancelled):
        surface.extrema([1, 2, 3], should_stop=lambda: True)


def test_progress(capsys):
    told = []
    wavy().closest(cloud(300_000), progress=lambda done, total: told.append((done, total)))
    assert told[-1] == (300_000, 300_000) and len(told) > 3 and told == sorted(told)
    pytest.importorskip("tqdm")
    wavy().closest(cloud(100_000), progress=True)
    assert "100%" in capsys.readouterr().err


def test_other_python_threads_run():
    counted = [0]
    stop = threading.Event()

    def count():
        while not stop.is_set():
            counted[0] += 1
            time.sleep(0.001)

    other = threading.Thread(target=count)
    other.start()
    surface, points = wavy(), cloud(400_000)
    before = counted[0]
    surface.closest(points)
    during = counted[0] - before
    stop.set(), other.join()
    assert during > 20


def _distance(arguments):
    shape, point = arguments
    return float(shape.closest(point).distance)


@posix
def test_fork():
    surface, points = wavy(), cloud(4)
    ring = circle()
    expected = [float(surface.closest(point).distance) for point in points]
    unused = wavy(7)
    read, write = os.pipe()
    with multiprocessing.get_context("fork").Pool(2) as pool:
        assert pool.map(_distance, [(surface, point) for point in points]) == expected
    child = os.fork()
    if child == 0:
        try:
            ok = [float(surface.closest(point).distance) for point in points] == expected and unused.closest(points).proven.all()
            ok = ok and ring.closest(points).proven.all() and surface.closest(cloud(5000)).proven.all()
            os.write(write, b"1" if ok else b"0")
        finally:
            os._exit(0)
    os.waitpid(child, 0)
    assert os.read(read, 1) == b"1"


@posix
def test_fork_while_the_index_is_built():
    """The child must not wait for a thread that it does not have."""
    rng = np.random.default_rng(5)
    grid = np.stack(np.meshgrid(np.arange(500.0), np.arange(500.0), indexing="ij"), -1)
    for wait in (0.0, 0.002, 0.01, 0.05):
        surface = footpoint.Surface.from_poles(3, 3, np.concatenate([grid, rng.normal(size=(500, 500, 1))], -1))
        builder = threading.Thread(target=surface.prepare)
        builder.start()
        time.sleep(wait)
        child = os.fork()
        if child == 0:
            signal.alarm(60)
            os._exit(0 if surface.closest([3, 4, 5]).proven else 1)
        assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0
        builder.join()


def test_spawned_processes():
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        assert pool.map(abs, [-1]) == [1]
        surface = wavy()
        other = pool.apply(footpoint.Surface.closest, (surface, cloud(20)))
    assert other.tobytes() == surface.closest(cloud(20)).tobytes()


def test_nothing_leaks():
    resource = pytest.importorskip("resource")
    points = cloud(2000)

    def rounds(count):
        for _ in range(count):
            surface = wavy()
            surface.closest(points), surface.extrema([1, 2, 3]), footpoint.Scene([surface]).closest(points[:9])
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss

    warm = rounds(40)
    assert rounds(160) - warm < 20_000 * (1024 if sys.platform == "darwin" else 1)

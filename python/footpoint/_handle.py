"""Owner of a C handle, and the Python function behind a shape that is given by one."""

from __future__ import annotations

import ctypes
import os
import threading
from typing import TYPE_CHECKING, Any, Callable

import numpy as np

from . import _library as lib
from ._query import address, array

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

_forks = 0


def _forked() -> None:
    global _forks
    _forks += 1


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_forked)


class Owner:
    """Owner of a C handle. Immutable; threads may share it.

    After a fork the child uses the parent's memory. Only when the search index may have been half built at that moment, by another
    thread that the child does not have, the child makes a handle of its own.
    """

    _kind = ""

    def _own(self, pointer: int | None) -> None:
        self._pointer = pointer
        self._forks = _forks
        self._indexed = False

    def _keep(self) -> None:
        """Uses the handle as it is, in this process too."""
        self._forks = _forks

    def _renew(self) -> None:
        """Makes a handle of this process's own."""
        raise NotImplementedError

    @property
    def _handle(self) -> int:
        pointer = getattr(self, "_pointer", None)
        if pointer is None:
            raise ValueError(f"this {type(self).__name__} was never made: its __init__ did not run or failed")
        if self._forks != _forks:
            if not self._indexed:
                self._renew()
            self._forks = _forks
        return self._pointer

    def __del__(self, functions: dict = lib.functions) -> None:
        pointer = getattr(self, "_pointer", None)
        if pointer is not None and self._forks == _forks or pointer is not None and self._indexed:
            functions[f"{self._kind}_free"](pointer)

    def __copy__(self) -> Any:
        return self

    def __deepcopy__(self, memo: Any) -> Any:
        return self

    def _call(self, name: str, *arguments: Any) -> int:
        return lib.call(f"{self._kind}_{name}", self._handle, *arguments)


class Handle(Owner):
    """Owner of a curve, a surface or a scene."""

    def _get(self, name: str, count: int, dtype: Any = np.float64) -> np.ndarray:
        out = np.zeros(count, dtype)
        self._call(name, address(out))
        return out

    def _number(self, name: str, kind: Any) -> int:
        out = kind()
        self._call(name, ctypes.byref(out))
        return out.value

    @property
    def box(self) -> np.ndarray:
        """The box in which it lies, shape (2, 3): least and greatest x, y, z, in the unit of the poles."""
        return self._get("box", 6).reshape(2, 3)

    @property
    def memory(self) -> int:
        """Bytes that the library holds: the inputs, and the search index once it is built."""
        return self._number("memory", ctypes.c_size_t)

    def prepare(self) -> "Handle":
        """Builds the search index now instead of on the first query; returns itself."""
        self._call("prepare")
        self._indexed = True
        return self


class OfFunction:
    """What a shape from a Python function needs: the function as C calls it, and its last error."""

    def __init__(self, kind: str, function: Callable, domain: ArrayLike, first: ArrayLike, second: ArrayLike):
        if not callable(function):
            raise TypeError(f"function: a function is needed, not {type(function).__name__}")
        width = 1 if kind == "curve" else 2
        self.kind, self.function, self.error = kind, function, None
        self.domain = array("domain", domain).reshape(-1)
        self.first, self.second = (array(name, values).reshape(-1) for name, values in (("first", first), ("second", second)))
        for name, values, count in (("domain", self.domain, 2 * width), ("first", self.first, width), ("second", self.second, 2 * width - 1)):
            if len(values) != count:
                raise ValueError(f"{name}: {len(values)} numbers, and must be {count}")
        prototype = lib.CurveFunction if kind == "curve" else lib.SurfaceFunction
        self.callback = prototype(self._curve if kind == "curve" else self._surface)

    def _curve(self, _user: Any, u: float, order: int, out: Any) -> int:
        return self._answer(order, order + 1, out, u)

    def _surface(self, _user: Any, u: float, v: float, order: int, out: Any) -> int:
        return self._answer(order, (order + 1) * (order + 2) // 2, out, u, v)

    def _answer(self, order: int, most: int, out: Any, *parameters: float) -> int:
        try:
            rows = np.asarray(self.function(*parameters, order), np.float64).reshape(-1, 3)
            orders = range(order + 1)
            sizes = [k + 1 for k in orders] if self.kind == "curve" else [(k + 1) * (k + 2) // 2 for k in orders]
            written = max((k for k in orders if sizes[k] <= len(rows)), default=-1)
            if written >= 0:
                np.ctypeslib.as_array(out, (3 * most,))[: 3 * sizes[written]] = rows[: sizes[written]].reshape(-1)
            return written
        except BaseException as error:  # the C call fails at this parameter and the caller is told why
            self.error = error
            return -1

    def data(self) -> Any:
        if self.kind == "curve":
            data = lib.CurveCallback(speed_bound=self.first[0], second_bound=self.second[0])
        else:
            data = lib.SurfaceCallback()
            data.speed_bounds[:], data.second_bounds[:] = self.first.tolist(), self.second.tolist()
        data.struct_size, data.evaluate = ctypes.sizeof(data), self.callback
        data.domain[:] = self.domain.tolist()
        return data

    def run(self, call: Callable[[], int], stop: Callable[[], None]) -> int:
        """Runs a C call that calls the function. Python interrupts the main thread at the start of a function, where it could not be
        caught; so the main thread waits, and another one calls."""
        if threading.current_thread() is not threading.main_thread():
            return call()
        result: list[Any] = []
        finished = threading.Event()

        def work() -> None:
            try:
                result.append(call())
            except BaseException as error:
                result.append(error)
            finished.set()

        threading.Thread(target=work).start()
        interrupt: BaseException | None = None
        while not finished.is_set():
            try:
                finished.wait()  # Thread.join, once interrupted, takes a running thread for ended
            except BaseException as error:
                interrupt = error
                stop()
        if interrupt is not None:
            raise interrupt
        if isinstance(result[0], BaseException):
            raise result[0]
        return result[0]

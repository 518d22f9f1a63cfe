"""The compiler of networks of springs, dampers and slips, from Python.

    tissue = dashpot.compile("networks/paper/second_order_maxwell.json")
    response = tissue.simulate(t, u)

Each function starts the command `dashpot`: the one that was installed with this package, or $DASHPOT, or the one on the
path. A network or a device is a path, or a dictionary with what its file would hold. Options are those of the command
line, with underscores: `compile(network, rate=4000, set={"K1": "200 N/m"}, uncertified=True)`. What the command refuses
is raised as `Refusal`, in its own words; what it warns of is a `Warned` warning.
"""
import csv
import decimal
import importlib.util
import itertools
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import warnings
import weakref
from typing import NamedTuple

import numpy

__all__ = ["Fit", "Network", "Refusal", "Simulated", "Warned", "compile", "explain", "fit"]

# As in `dashpot simulate`:
_SAME_RATE = 1e-6  # relative, that a motion may differ by from the rate it is for
_COARSEST_SHARE = 0.1  # of the period, of a last digit that is allowed for
_numbers = itertools.count()


class Refusal(ValueError):
    """What the command says of a network, device, recording or option that it does not take."""


class Warned(UserWarning):
    """What the command warns of."""


def _command() -> str:
    installed = pathlib.Path(__file__).resolve().parents[4:5]
    named = os.environ.get("DASHPOT")
    for candidate in [named] if named else [str(prefix / "bin" / "dashpot") for prefix in installed] + ["dashpot"]:
        found = shutil.which(candidate)
        if found:
            return found
    raise FileNotFoundError(
        f"there is no command '{named or 'dashpot'}'; install dashpot, or name it in the variable DASHPOT")


def _words(options) -> list:
    words = []
    for name, value in options.items():
        option = "--" + name.replace("_", "-")
        if isinstance(value, dict):
            value = [f"{key}={number}" for key, number in value.items()]
        if value is True:
            words.append(option)
        elif value is not None and value is not False:
            for one in value if isinstance(value, (list, tuple)) else [value]:
                words += [option, os.fspath(one) if isinstance(one, os.PathLike) else str(one)]
    return words


def _call(*words) -> str:
    done = subprocess.run([_command(), *words], stdout=subprocess.PIPE, stderr=subprocess.PIPE, encoding="utf-8")
    said = done.stderr.strip()
    if done.returncode != 0:
        raise Refusal(said or f"dashpot ended with {done.returncode}")
    if said:
        warnings.warn(said, Warned, stacklevel=5)
    return done.stdout


class _Folder:
    """A folder of its own, for as long as something refers to it."""

    def __init__(self):
        self.path = pathlib.Path(tempfile.mkdtemp(prefix="dashpot-"))
        weakref.finalize(self, shutil.rmtree, self.path, ignore_errors=True)

    def file(self, what, name) -> str:
        """The path of a network or a device."""
        if not isinstance(what, dict):
            return os.fspath(what)
        path = self.path / name
        path.write_text(json.dumps(what, default=lambda number: number.item()), encoding="utf-8")
        return str(path)

    def choices(self, device, options) -> list:
        return _words(options if device is None else dict(options, device=self.file(device, "device.json")))


class Simulated(NamedTuple):
    """A row for each sample, as numpy arrays; what `dashpot simulate` prints."""
    time: numpy.ndarray
    position: numpy.ndarray
    velocity: numpy.ndarray
    force: numpy.ndarray
    damping: numpy.ndarray
    motor_force: numpy.ndarray


def _seconds(t):
    """The times as numbers of the type that they have, where it is one of single or double precision."""
    time = numpy.asarray(t)
    if time.dtype.kind == "M" or time.dtype.kind == "m" and numpy.datetime_data(time.dtype)[0] in {"Y", "M", "generic"}:
        raise ValueError(f"t is of type {time.dtype}; numbers of seconds are expected, or a timedelta64 whose unit is "
                         "always as long")
    if time.dtype.kind == "m":
        return time / numpy.timedelta64(1, "s")
    return time if time.dtype in (numpy.float64, numpy.float32) else time.astype(numpy.float64)


class _Rate(NamedTuple):
    """Of times at one period."""
    meant: float  # a whole number, or that of a period with few digits, rather than the rounding of times [Hz]
    period: float  # [s]
    same: float  # relative, that another rate may differ by


def _rate_with(period, error) -> _Rate:
    """Of a period to which the times' rounding leaves an error."""
    rate, same = 1 / period, max(_SAME_RATE, error / period)
    whole = float(round(rate))
    return _Rate(whole if whole and abs(rate - whole) <= same * rate else 1 / float(f"{period:.7g}"), period, same)


def _last_digits(time):
    """What 1 in the last digit of each is [s]: times are written with one number of decimals, or of digits."""
    size = numpy.abs(time)
    written = [decimal.Decimal(text).normalize().as_tuple() for text in size[size > 0].astype(str)]
    first = numpy.log10(size, where=size > 0, out=numpy.full(len(size), -numpy.inf))
    return 10.0 ** numpy.maximum(min(number.exponent for number in written),
                                 numpy.floor(first) + 1 - max(len(number.digits) for number in written))


def _rate_of(time) -> _Rate:
    """As `dashpot simulate` finds it: steps are alike, or times are on a straight line but for the rounding of the type
    that holds them, or of their digits as well, where that is a small share of the period."""
    wrong = numpy.flatnonzero(~numpy.isfinite(time))
    if len(wrong) > 0:
        raise ValueError(f"t is {time.flat[wrong[0]]} in row {wrong[0]}; a finite time is expected")
    seconds = time.astype(numpy.float64)
    steps = numpy.diff(seconds) if time.ndim == 1 else []
    if len(steps) == 0 or not numpy.all(steps > 0):
        raise ValueError("t is no array of two rising times or more")
    median, rounding = numpy.median(steps), 4 * numpy.finfo(numpy.float64).eps * numpy.abs(seconds)

    def off_step(allowance):
        return numpy.flatnonzero(numpy.abs(steps - median) > _SAME_RATE * median + rounding[1:] + allowance) + 1

    period = (seconds[-1] - seconds[0]) / len(steps)
    if len(off_step(0)) == 0:
        return _rate_with(period, rounding[-1] / len(steps))
    line, held, allowance = seconds[0] + period * numpy.arange(len(seconds)), numpy.spacing(numpy.abs(time)), 0
    for units in [held, held + _last_digits(time)]:
        unit = max(units[0], units[-1])
        if unit <= _COARSEST_SHARE * median:
            off_line = numpy.flatnonzero(numpy.abs(seconds - line) > (unit + units) / 2 + rounding)
            if len(off_line) == 0:
                return _rate_with(period, (unit + rounding[-1]) / len(steps))
            allowance = unit
    gaps = off_step(allowance)
    if len(gaps) > 0:
        raise ValueError(f"t has steps of {median:g} s but for row {gaps[0]}, {steps[gaps[0] - 1]:g} s after the one "
                         "before; one period throughout is expected")
    row = off_line[0]
    raise ValueError(f"t is at {seconds[row]:.9g} s in row {row}; at a period of {period:.9g} s that row is at "
                     f"{line[row]:.9g} s")


class Network:
    """A compiled network. `law()` is its law for a loop at `rate`; `simulate()` compiles it again for a motion at
    another rate, where neither `rate` nor a device was asked for."""

    def __init__(self, network, device=None, **options):
        self._folder = _Folder()
        self._fixed = device is not None or options.get("rate") is not None
        self._words = [self._folder.file(network, "network.json"), *self._folder.choices(device, options)]
        self._packages = {}
        self.package = self._compiled([])
        self._packages[self.package.RATE] = self.package
        self.rate = self.package.RATE

    def _compiled(self, more):
        folder = self._folder.path / f"law{len(self._packages)}"
        _call("compile", *self._words, *more, "--target", "python", "-o", str(folder))
        (package,) = folder.iterdir()
        name = f"_dashpot_{next(_numbers)}_{package.name}"  # two networks may be called alike
        spec = importlib.util.spec_from_file_location(name, package / "__init__.py")
        module = importlib.util.module_from_spec(spec)
        sys.modules[name] = module
        try:
            spec.loader.exec_module(module)
        finally:
            del sys.modules[name]
        self.name = package.name
        return module

    def _at(self, rate):
        if self._fixed:
            if abs(self.rate * rate.period - 1) > rate.same:
                raise ValueError(f"t is at {1 / rate.period:g} Hz, and the law is for a loop at {self.rate:g} Hz")
            return self.package
        if rate.meant not in self._packages:
            self._packages[rate.meant] = self._compiled(["--rate", repr(rate.meant)])
        return self._packages[rate.meant]

    def law(self):
        """A law at rest, for step() and set()."""
        return self.package.Law()

    @property
    def parameters(self) -> dict:
        """That may be set while the law runs: unit, value, min, max of each."""
        return self.package.parameters

    def explain(self) -> dict:
        """What `dashpot explain --json` says."""
        return self.package.explain()

    def simulate(self, t, u, velocity=None, values=None) -> Simulated:
        """The law, at rest at 0, led along the positions `u` at the times `t`, in seconds or as timedelta64, all at
        one period. Without velocities each is the difference to the row before over the period. `values` has arrays of
        parameters by name."""
        time = _seconds(t)
        law = self._at(_rate_of(time)).Law()
        position = numpy.asarray(u)
        if position.shape != time.shape:
            raise ValueError(f"u has the shape {position.shape}, and t {time.shape}")
        response = law.simulate(position, velocity, values=values)
        return Simulated(time.astype(numpy.float64), position, *response)


def compile(network, *, device=None, **options) -> Network:
    """A network, ready to run. With a `device`, for that device: at its rate, and certified."""
    return Network(network, device, **options)


def explain(network, *, device=None, **options) -> dict:
    """What `dashpot explain --json` says of a network: its canonical form, the candidates, and the choice."""
    folder = _Folder()
    return json.loads(_call("explain", folder.file(network, "network.json"), *folder.choices(device, options),
                            "--json"))


class Fit(NamedTuple):
    """What was fitted."""
    network: dict  # as a file would hold it: for compile(), or json.dump()
    report: dict  # what `dashpot fit --json` says


def _recording(recording, folder, name) -> str:
    """The path of a recording; columns by name, in SI units, are written into a table first."""
    if not hasattr(recording, "items"):
        return os.fspath(recording)
    path = folder.path / f"{name}.csv"
    columns = dict((name, numpy.asarray(values, dtype=numpy.float64)) for name, values in recording.items())
    if len(set(values.shape for values in columns.values())) != 1:
        raise ValueError("the columns of a recording have different lengths")
    with open(path, "w", encoding="utf-8", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(columns)
        table.writerows(zip(*(values.tolist() for values in columns.values())))
    return str(path)


def fit(*recordings, hold_out=None, **options) -> Fit:
    """A network fitted to recordings: paths of tables, or dictionaries of arrays whose names say what they are, with
    units, as {"time [s]": t, "position [m]": u, "force [N]": f}. `hold_out` has one or several that are predicted and
    not fitted."""
    folder = _Folder()
    several = hold_out if isinstance(hold_out, (list, tuple)) else [] if hold_out is None else [hold_out]
    fitted, held_out = ([_recording(recording, folder, f"{what}{number}") for number, recording in enumerate(those)]
                        for what, those in [("recording", recordings), ("held_out", several)])
    output = folder.path / "fitted.json"
    report = json.loads(_call("fit", *fitted, *_words(dict({"name": "fitted"}, **options, hold_out=held_out)), "--json",
                              "-o", str(output)))
    return Fit(json.loads(output.read_text(encoding="utf-8")), report)

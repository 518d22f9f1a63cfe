"""A small importer of FMI 2.0 and 3.0 units for co-simulation: unpacks, loads the shared library with dlopen, plays
it."""
import ctypes
import pathlib
import platform
import xml.etree.ElementTree as ET
import zipfile

OK, WARNING, DISCARD, ERROR, FATAL = range(5)

LOG3 = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_int, ctypes.c_char_p, ctypes.c_char_p)
LOG2 = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_char_p, ctypes.c_int, ctypes.c_char_p, ctypes.c_char_p)


class Callbacks2(ctypes.Structure):
    _fields_ = [("logger", LOG2), ("allocate", ctypes.c_void_p), ("free", ctypes.c_void_p),
                ("finished", ctypes.c_void_p),
                ("environment", ctypes.c_void_p)]


def numbers(values, kind=ctypes.c_double):
    return (kind * len(values))(*values)


class Fmu:
    """An unpacked unit: its description and its library."""

    def __init__(self, path, folder):
        self.folder = pathlib.Path(folder)
        with zipfile.ZipFile(path) as archive:
            self.names = sorted(archive.namelist())
            archive.extractall(self.folder)
        self.description = ET.parse(self.folder / "modelDescription.xml").getroot()
        self.version = int(float(self.description.get("fmiVersion")))
        machine = platform.machine()
        place = "linux64" if self.version == 2 and machine == "x86_64" else f"{machine}-linux"
        self.name = self.description.find("CoSimulation").get("modelIdentifier")
        self.library_path = self.folder / "binaries" / place / f"{self.name}.so"
        self.library = ctypes.CDLL(str(self.library_path))
        self.token = self.description.get("instantiationToken" if self.version == 3 else "guid")
        self.references = {v.get("name"): int(v.get("valueReference")) for v in self.description.find("ModelVariables")}

    def call(self, name, *arguments):
        function = getattr(self.library, f"fmi{self.version}{name}")
        function.restype = ctypes.c_int
        return function(*arguments)


class Instance:
    """One of a unit. Whatever it says is kept in `said`, and by whose name it says it, in FMI 2, in `speakers`."""

    def __init__(self, fmu, token=None, kind="CoSimulation", name=b"one", logging=True):
        self.fmu, self.said, self.speakers = fmu, [], []
        token = (fmu.token if token is None else token).encode()
        library = fmu.library
        if fmu.version == 3:
            self.log = LOG3(lambda environment, status, category, message: self.said.append(
                (status, category, message.decode())))
            create = getattr(library, f"fmi3Instantiate{kind}")
            create.restype = ctypes.c_void_p
            head = (name, token, None, ctypes.c_bool(False), ctypes.c_bool(logging))
            tail = (None, self.log, None, None, None)
            between = (ctypes.c_bool(False), ctypes.c_bool(False), None,
                       ctypes.c_size_t(0)) if kind == "CoSimulation" else ()
            self.pointer = create(*head, *between, *tail)
        else:
            def log(environment, speaker, status, category, message):
                self.said.append((status, category, message.decode()))
                self.speakers.append(speaker)

            self.log = LOG2(log)
            self.callbacks = Callbacks2(self.log, None, None, None, None)
            create = library.fmi2Instantiate
            create.restype = ctypes.c_void_p
            given = ctypes.create_string_buffer(name)
            self.pointer = create(given, 1 if kind == "CoSimulation" else 0, token, None, ctypes.byref(self.callbacks),
                                  0, int(logging))
            ctypes.memset(given, 0, len(given))  # it is the unit's during the call alone

    def call(self, name, *arguments):
        return self.fmu.call(name, ctypes.c_void_p(self.pointer), *arguments)

    def free(self):
        function = getattr(self.fmu.library, f"fmi{self.fmu.version}FreeInstance")
        function.restype = None
        function(ctypes.c_void_p(self.pointer))

    def debug_logging(self, on, categories):
        count = ctypes.c_size_t(len(categories))
        flag = ctypes.c_bool(on) if self.fmu.version == 3 else int(on)
        return self.call("SetDebugLogging", flag, count, numbers(categories, ctypes.c_char_p))

    def begin(self, start=0.0):
        """To the phase of steps; what is set in between is for the caller."""
        self.enter(start)
        return self.call("ExitInitializationMode")

    def enter(self, start=0.0):
        f = ctypes.c_double
        if self.fmu.version == 3:
            no = ctypes.c_bool(False)
            return self.call("EnterInitializationMode", no, f(0), f(start), no, f(0))
        return self.call("SetupExperiment", 0, f(0), f(start), 0, f(0)) or self.call("EnterInitializationMode")

    def which(self, names):
        return numbers([self.fmu.references[n] if isinstance(n, str) else n for n in names],
                       ctypes.c_uint32), ctypes.c_size_t(len(names))

    def set(self, **values):
        tail = (ctypes.c_size_t(len(values)),) if self.fmu.version == 3 else ()
        return self.call("SetFloat64" if self.fmu.version == 3 else "SetReal", *self.which(values),
                         numbers(values.values()), *tail)

    def get(self, *names):
        found = numbers([0.0] * len(names))
        tail = (ctypes.c_size_t(len(names)),) if self.fmu.version == 3 else ()
        status = self.call("GetFloat64" if self.fmu.version == 3 else "GetReal", *self.which(names), found, *tail)
        return tuple(found) if status == OK else status

    def step(self, now, length):
        f = ctypes.c_double
        if self.fmu.version == 2:
            return self.call("DoStep", f(now), f(length), 1)
        flags = [ctypes.c_bool(True) for _ in range(3)]
        last = f(-1)
        status = self.call("DoStep", f(now), f(length), ctypes.c_bool(True), *map(ctypes.byref, flags),
                           ctypes.byref(last))
        assert status != OK or not any(flag.value for flag in flags)
        self.last_time = last.value
        return status

    def state(self, name, *arguments):
        return self.call(f"{name}FMU{'State' if self.fmu.version == 3 else 'state'}", *arguments)

    def derivatives(self, unknowns, knowns, seed):
        found = numbers([0.0] * len(unknowns))
        three = self.fmu.version == 3
        sizes = [(ctypes.c_size_t(n),) if three else () for n in (len(seed), len(unknowns))]
        status = self.call("GetDirectionalDerivative", *self.which(unknowns), *self.which(knowns), numbers(seed),
                           *sizes[0], found, *sizes[1])
        return tuple(found) if status == OK else status

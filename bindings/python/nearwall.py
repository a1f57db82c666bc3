"""What happens when a particle hits a wall: libnearwall for Python, with NumPy arrays that are not copied.

    import nearwall
    model = nearwall.Model.from_file("nearWall.toml")
    out = model.resolve(v_n=v_n, d=d, T_p=T_p)      # arrays of float64, SI units; numbers stand for all impacts
    out.e_n, out.e_t, out.p_stick, out.stuck        # arrays

The library is the one that NEARWALL_LIBRARY names, else the installed one beside this file, else whatever the loader
finds as libnearwall.so.1. A model never changes and may be used by many threads; calls release the interpreter lock.
Licence: MIT OR Apache-2.0.
"""

import ctypes
import os
from collections import namedtuple
from ctypes import POINTER, byref, c_char_p, c_double, c_int32, c_size_t, c_uint32, c_uint64, c_void_p

import numpy

ABI_VERSION = 1
OK = 0
REGIMES = ("NSP-NSW", "NSP-SW", "SP-NSW", "SP-SW")  # what the numbers in `Outcomes.regime` stand for
OUTSIDE_VALID_RANGE = 1  # bit of `Outcomes.flags`

# The inputs of an impact, as in nw_impact: speeds [m/s], lengths [m], temperatures [K], omega [rad/s], shares 0 to 1.
INPUTS = ("v_n", "v_t", "d", "T_p", "T_w", "conversion", "layer_thickness", "film_thickness", "v_gas", "roughness",
          "omega", "coverage")

Outcomes = namedtuple("Outcomes", "e_n e_t p_stick omega regime stuck flags")
Speeds = namedtuple("Speeds", "adhesive yielding sticking")
TemperatureRanges = namedtuple("TemperatureRanges", "particle_low particle_high wall_low wall_high")


class Error(Exception):
    """The library refused; `status` is its number, `index` the impact at fault or None."""

    def __init__(self, status, text, index=None):
        super().__init__(text if index is None else f"impact {index}: {text}")
        self.status, self.index = status, index


class _Impact(ctypes.Structure):
    _fields_ = ([("struct_size", c_uint32), ("wall", c_uint32)] + [(name, c_double) for name in INPUTS]
                + [("seed", c_uint64), ("key", c_uint64), ("melt_thickness", c_double)])


class _Impacts(ctypes.Structure):
    _fields_ = ([("struct_size", c_uint32), ("wall", c_uint32), ("count", c_size_t), ("seed", c_uint64),
                 ("walls", c_void_p)] + [(name, c_void_p) for name in INPUTS]
                + [("key", c_void_p), ("melt_thickness", c_void_p)])


class _Outcomes(ctypes.Structure):
    _fields_ = [("struct_size", c_uint32)] + [(name, c_void_p) for name in Outcomes._fields]


class Deposit(ctypes.Structure):
    """What lies on a piece of wall, per area of it, bare at first: masses molten and powder [kg/m2], volume solid [m3/m2] and
    projected area cover [1] of the powder's particles, carbon conversion of all [1]."""
    _fields_ = ([("struct_size", c_uint32), ("wall", c_uint32)]
                + [(name, c_double) for name in ("molten", "powder", "solid", "cover", "conversion")])

    def __init__(self, wall=0):
        super().__init__()
        _check(_library.nw_deposit_init(byref(self)))
        self.wall = _index("wall", wall, 32)

    def add(self, arrivals):
        """What arrived in a step; powder that melt buries becomes part of the melt, mass is kept."""
        _check(_library.nw_deposit_add(byref(arrivals), byref(self)))


class DepositSource(ctypes.Structure):
    """What arrived on a piece of wall in a step and stayed, summed, per area of it; nothing at first (`Model.add_captured` adds)."""
    _fields_ = ([("struct_size", c_uint32), ("count", c_uint32)]
                + [(name, c_double) for name in ("molten", "powder", "solid", "cover", "buried", "converted")])

    def __init__(self):
        super().__init__()
        _check(_library.nw_deposit_source_init(byref(self)))


# The structs of nearwall.h that this module knows.
STRUCTS = {"nw_impact": _Impact, "nw_impacts": _Impacts, "nw_outcomes": _Outcomes, "nw_deposit": Deposit,
           "nw_deposit_source": DepositSource}


def _load():
    here = os.path.dirname(os.path.abspath(__file__))
    name = f"libnearwall.so.{ABI_VERSION}"
    beside = os.path.join(here, "..", "..", "..", "lib", name)
    library = ctypes.CDLL(os.environ.get("NEARWALL_LIBRARY") or (beside if os.path.exists(beside) else name))
    found = library.nw_abi_version()
    if found != ABI_VERSION:
        raise ImportError(f"libnearwall has interface version {found}, this module is for {ABI_VERSION}")
    message = [c_char_p, c_size_t]
    doubles = [POINTER(c_double)]
    for name, arguments in {
        "nw_model_load": [c_char_p, POINTER(c_void_p)] + message,
        "nw_model_parse": [c_char_p, c_size_t, c_char_p, POINTER(c_void_p)] + message,
        "nw_model_find_wall": [c_void_p, c_char_p, POINTER(c_uint32)],
        "nw_impact_init": [POINTER(_Impact)],
        "nw_speeds": [c_void_p, POINTER(_Impact)] + 3 * doubles,
        "nw_temperature_ranges": [c_void_p, c_uint32] + 4 * doubles,
        "nw_resolve_batch": [c_void_p, POINTER(_Impacts), POINTER(_Outcomes), POINTER(c_size_t)],
        "nw_deposit_init": [POINTER(Deposit)],
        "nw_deposit_initial": [c_void_p, c_double, POINTER(Deposit)],
        "nw_deposit_source_init": [POINTER(DepositSource)],
        "nw_deposit_source_add": [c_void_p, POINTER(_Impact), c_double, c_double, POINTER(DepositSource)],
        "nw_deposit_add": [POINTER(DepositSource), POINTER(Deposit)],
        "nw_deposit_apply": [c_void_p, POINTER(Deposit), c_double, POINTER(_Impact)],
        "nw_film_velocity": [c_void_p, POINTER(Deposit), c_double, c_double] + doubles,
    }.items():
        function = getattr(library, name)
        function.argtypes, function.restype = arguments, c_int32
    library.nw_model_free.argtypes, library.nw_model_free.restype = [c_void_p], None
    library.nw_status_text.argtypes, library.nw_status_text.restype = [c_int32], c_char_p
    library.nw_version.argtypes, library.nw_version.restype = [], c_char_p
    return library


_library = _load()
VERSION = _library.nw_version().decode()


def _check(status, message="", index=None):
    if status != OK:
        raise Error(status, message or _library.nw_status_text(status).decode(), index)


def _column(name, value, count, kind):
    """An array for C: as it is, or a number repeated."""
    if numpy.ndim(value) == 0:
        return numpy.full(count, value, kind)
    if not isinstance(value, numpy.ndarray) or value.dtype != kind or not value.flags.c_contiguous:
        raise TypeError(f"{name} has to be a contiguous array: numpy.ascontiguousarray({name}, numpy.{numpy.dtype(kind).name})")
    if value.shape != (count,):
        raise ValueError(f"{name} has shape {value.shape}, there are {count} impacts")
    return value


def _index(name, value, bits):
    """A whole number that C would otherwise cut to its last bits."""
    if not 0 <= value < 2**bits:
        raise ValueError(f"{name} has to be between 0 and 2**{bits} - 1, not {value}")
    return value


def _text(name, value):
    """Bytes for C, where a zero ends a text."""
    data = os.fsencode(value)
    if b"\0" in data:
        raise ValueError(f"{name} has a zero byte in it")
    return data


def _impact(wall, inputs):
    """One impact for C, from numbers."""
    impact = _Impact()
    _check(_library.nw_impact_init(byref(impact)))
    impact.wall = _index("wall", wall, 32)
    for name, value in inputs.items():
        if name not in INPUTS + ("melt_thickness",):
            raise TypeError(f"no such input: {name}")
        setattr(impact, name, value)
    return impact


class Model:
    """A model file, read; freed with the object."""

    def __init__(self, handle):
        self._handle = handle

    @classmethod
    def from_file(cls, path):
        return cls._read(_library.nw_model_load, _text("path", path))

    @classmethod
    def from_toml(cls, text, name="model"):
        toml = text.encode()
        return cls._read(_library.nw_model_parse, toml, len(toml), name.encode())

    @classmethod
    def _read(cls, function, *arguments):
        handle, message = c_void_p(), ctypes.create_string_buffer(2048)
        status = function(*arguments, byref(handle), message, len(message))
        _check(status, message.value.decode(errors="replace"))
        return cls(handle)

    def __del__(self):
        if getattr(self, "_handle", None):
            _library.nw_model_free(self._handle)
            self._handle = None

    def find_wall(self, name):
        """The index of the wall that a patch name belongs to."""
        wall = c_uint32()
        _check(_library.nw_model_find_wall(self._handle, _text("name", name), byref(wall)))
        return wall.value

    def resolve(self, v_n, wall=0, seed=0, key=None, **inputs):
        """Decides len(v_n) impacts. `inputs` are those of INPUTS and melt_thickness, arrays of float64 or numbers; `wall` an
        index or an array of uint32; `key` an array of uint64 (a number would give all the same draw), the impact's own index if not given."""
        unknown = set(inputs) - set(INPUTS) - {"melt_thickness"}
        if unknown:
            raise TypeError(f"no such input: {', '.join(sorted(unknown))}")
        count = 1 if numpy.ndim(v_n) == 0 else len(v_n)
        columns = {name: _column(name, value, count, numpy.float64) for name, value in inputs.items()}
        columns["v_n"] = _column("v_n", v_n, count, numpy.float64)
        if key is not None:
            if numpy.ndim(key) == 0 and count > 1:
                raise TypeError("key has to be an array: one number would give every impact the same draw")
            columns["key"] = _column("key", key, count, numpy.uint64)
        if numpy.ndim(wall) > 0:
            columns["walls"], wall = _column("wall", wall, count, numpy.uint32), 0
        impacts = _Impacts(struct_size=ctypes.sizeof(_Impacts), wall=_index("wall", wall, 32), count=count,
                           seed=_index("seed", seed, 64), **{name: column.ctypes.data for name, column in columns.items()})
        found = Outcomes(*(numpy.empty(count, numpy.float64 if i < 4 else numpy.uint32) for i in range(7)))
        outcomes = _Outcomes(ctypes.sizeof(_Outcomes), *(column.ctypes.data for column in found))
        none = ctypes.c_size_t(-1).value
        first_bad = c_size_t(none)
        status = _library.nw_resolve_batch(self._handle, byref(impacts), byref(outcomes), byref(first_bad))
        _check(status, index=None if first_bad.value == none else first_bad.value)
        return found

    def speeds(self, wall=0, **inputs):
        """Adhesive, yield and sticking velocity [m/s] of one impact; inputs are numbers as in `resolve`."""
        impact = _impact(wall, inputs)
        found = [c_double() for _ in range(3)]
        _check(_library.nw_speeds(self._handle, byref(impact), *map(byref, found)))
        return Speeds(*(number.value for number in found))

    def temperature_ranges(self, wall=0):
        """Temperatures [K] between which impacts on a wall can be decided."""
        found = [c_double() for _ in range(4)]
        _check(_library.nw_temperature_ranges(self._handle, _index("wall", wall, 32), *map(byref, found)))
        return TemperatureRanges(*(number.value for number in found))

    def initial_deposit(self, wall, voidage):
        """What the model file says lies on a wall, with a share `voidage` of voids in the powder: where a memory begins."""
        deposit = Deposit(wall)
        _check(_library.nw_deposit_initial(self._handle, voidage, byref(deposit)))
        return deposit

    def apply_deposit(self, deposit, voidage, T_w):
        """The arguments of `resolve` that tell impacts of the deposit on its wall of T_w [K]: resolve(..., **apply_deposit(...))."""
        impact = _impact(deposit.wall, {"T_w": T_w})
        _check(_library.nw_deposit_apply(self._handle, byref(deposit), voidage, byref(impact)))
        names = ("wall", "T_w", "layer_thickness", "coverage", "melt_thickness")
        return {name: getattr(impact, name) for name in names}

    def add_captured(self, arrivals, mass, density, T_w, wall=0, **inputs):
        """Adds a particle that stayed on a wall of T_w [K], which decides whether as melt: `mass` of it per area [kg/m2],
        `density` [kg/m3]; inputs are numbers as in `resolve`."""
        impact = _impact(wall, {"T_w": T_w, **inputs})
        _check(_library.nw_deposit_source_add(self._handle, byref(impact), mass, density, byref(arrivals)))

    def film_velocity(self, deposit, T_w, gravity_along):
        """Mean speed [m/s] of a deposit's melt that runs down a wall of T_w [K]; gravity along the wall in m/s2."""
        found = c_double()
        _check(_library.nw_film_velocity(self._handle, byref(deposit), T_w, gravity_along, byref(found)))
        return found.value

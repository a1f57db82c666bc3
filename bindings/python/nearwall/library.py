"""The C library for Python: a model, and the deposit on a wall, with NumPy arrays that are read in place.

The module loads the library that NEARWALL_LIBRARY names, else the compiled part of the package, else the library that
`bindings/install` put beside it, else libnearwall.so.1 on the loader's path. A model never changes and many threads may use
it; calls release the interpreter lock.
Licence: MIT OR Apache-2.0.
"""

from __future__ import annotations

import ctypes
import os
import warnings
from ctypes import (POINTER, Structure, byref, c_char_p, c_double, c_int32, c_size_t, c_uint32, c_uint64,
                    c_void_p)
from typing import Any, Callable, Dict, List, NamedTuple, Optional, Tuple, Union

import numpy
from numpy.typing import NDArray

#: One number or word for all impacts, or anything with one entry for each: an array, a list, a column of a frame.
Input = Any
#: Name or index of a wall.
Wall = Union[int, str]

# GENERATED from nearwall.h: `NEARWALL_BLESS=1 cargo test --test library interface` writes it again.
ABI_VERSION = 1
EXTRA_INPUTS = 8
PROCESSES = 5
DIRECTIONS = 3
OUTSIDE_VALID_RANGE = 1
OK = 0
NULL_POINTER = 1
STRUCT_SIZE = 2
NOT_UTF8 = 3
FILE = 4
MODEL = 5
UNKNOWN_WALL = 6
BAD_STATE = 7
OUT_OF_RANGE = 8
PANIC = 9
UNKNOWN_INPUT = 10
NO_CONDUCTIVITY = 11
NO_HEAT_CAPACITY = 12
NSP_NSW = 0
NSP_SW = 1
SP_NSW = 2
SP_SW = 3

# The inputs of an impact; nearwall.h describes them.
INPUTS = (
    "v_n", "v_t", "omega", "d", "T_p", "rho_p", "conversion", "T_w", "T_under", "roughness", "coverage",
    "layer_thickness", "film_thickness", "melt_thickness", "v_gas")


class nw_impact(Structure):
    _fields_ = [
        ("struct_size", c_uint32), ("wall", c_uint32), ("seed", c_uint64), ("key", c_uint64),
        ("v_n", c_double), ("v_t", c_double), ("omega", c_double), ("d", c_double), ("T_p", c_double),
        ("rho_p", c_double), ("conversion", c_double), ("T_w", c_double), ("T_under", c_double),
        ("roughness", c_double), ("coverage", c_double), ("layer_thickness", c_double),
        ("film_thickness", c_double), ("melt_thickness", c_double), ("v_gas", c_double),
        ("extra", c_double * EXTRA_INPUTS)]


class nw_outcome(Structure):
    _fields_ = [
        ("struct_size", c_uint32), ("regime", c_uint32), ("stuck", c_uint32), ("flags", c_uint32),
        ("e_n", c_double), ("e_t", c_double), ("p_stick", c_double), ("omega", c_double)]


class nw_impacts(Structure):
    _fields_ = [
        ("struct_size", c_uint32), ("wall", c_uint32), ("count", c_size_t), ("seed", c_uint64),
        ("walls", c_void_p), ("key", c_void_p), ("v_n", c_void_p), ("v_t", c_void_p), ("omega", c_void_p),
        ("d", c_void_p), ("T_p", c_void_p), ("rho_p", c_void_p), ("conversion", c_void_p), ("T_w", c_void_p),
        ("T_under", c_void_p), ("roughness", c_void_p), ("coverage", c_void_p),
        ("layer_thickness", c_void_p), ("film_thickness", c_void_p), ("melt_thickness", c_void_p),
        ("v_gas", c_void_p), ("extra", c_void_p * EXTRA_INPUTS)]


class nw_outcomes(Structure):
    _fields_ = [
        ("struct_size", c_uint32), ("e_n", c_void_p), ("e_t", c_void_p), ("p_stick", c_void_p),
        ("omega", c_void_p), ("regime", c_void_p), ("stuck", c_void_p), ("flags", c_void_p)]


class nw_wall_cooling(Structure):
    _fields_ = [
        ("struct_size", c_uint32), ("reserved", c_uint32), ("coolant_temperature", c_double),
        ("coolant_coefficient", c_double), ("wall_resistance", c_double), ("gas_temperature", c_double),
        ("gas_coefficient", c_double), ("emissivity", c_double), ("irradiation", c_double),
        ("further_flux", c_double), ("gas_conductivity", c_double), ("void_temperature", c_double),
        ("other_conductivity", c_double), ("other_temperature", c_double), ("vapour_fraction", c_double),
        ("vapour_coefficient", c_double)]


class nw_wall_heat(Structure):
    _fields_ = [
        ("struct_size", c_uint32), ("reserved", c_uint32), ("surface_temperature", c_double),
        ("wall_temperature", c_double), ("heat_flux", c_double), ("coolant_flux", c_double),
        ("deposit_resistance", c_double), ("disagreement", c_double), ("behind_temperature", c_double),
        ("behind_resistance", c_double)]


class nw_deposit(Structure):
    _fields_ = [
        ("struct_size", c_uint32), ("wall", c_uint32), ("molten", c_double), ("powder", c_double),
        ("solid", c_double), ("cover", c_double), ("conversion", c_double), ("closed", c_double),
        ("resuspended", c_double), ("frozen", c_double), ("behind", c_double)]


class nw_deposit_source(Structure):
    _fields_ = [
        ("struct_size", c_uint32), ("count", c_uint32), ("molten", c_double), ("powder", c_double),
        ("solid", c_double), ("cover", c_double), ("buried", c_double), ("converted", c_double)]


class nw_deposit_surroundings(Structure):
    _fields_ = [
        ("struct_size", c_uint32), ("reserved", c_uint32), ("voidage", c_double),
        ("wall_temperature", c_double), ("gas_density", c_double), ("kinematic_viscosity", c_double),
        ("shear_down", c_double), ("shear_across", c_double), ("gravity_outward", c_double),
        ("gravity_along", c_double), ("draw", c_double)]


class nw_deposit_losses(Structure):
    _fields_ = [
        ("struct_size", c_uint32), ("reserved", c_uint32), ("mass", c_double * PROCESSES),
        ("heat_taken", c_double), ("heat_to_coolant", c_double), ("heat_of_fusion", c_double),
        ("heat_released", c_double), ("deposit_resistance", c_double)]


class nw_walk(Structure):
    _fields_ = [
        ("struct_size", c_uint32), ("reserved", c_uint32), ("seed", c_uint64), ("key", c_uint64),
        ("step", c_uint64), ("duration", c_double), ("relaxation_time", c_double),
        ("friction_velocity", c_double), ("kinematic_viscosity", c_double), ("wall_distance", c_double),
        ("normal", c_double * DIRECTIONS), ("flow", c_double * DIRECTIONS), ("core_fluctuation", c_double),
        ("core_time", c_double), ("core_gradient", c_double * DIRECTIONS), ("values", c_double * DIRECTIONS),
        ("velocity", c_double * DIRECTIONS), ("longest_step", c_double)]


# Result and arguments of every function.
FUNCTIONS = {
    "nw_abi_version": (c_uint32, []),
    "nw_version": (c_char_p, []),
    "nw_status_text": (c_char_p, [c_int32]),
    "nw_regime_name": (c_char_p, [c_uint32]),
    "nw_model_load": (c_int32, [c_char_p, POINTER(c_void_p), c_char_p, c_size_t]),
    "nw_model_parse": (c_int32, [c_char_p, c_size_t, c_char_p, POINTER(c_void_p), c_char_p, c_size_t]),
    "nw_model_free": (None, [c_void_p]),
    "nw_model_find_wall": (c_int32, [c_void_p, c_char_p, POINTER(c_uint32)]),
    "nw_impact_init": (c_int32, [POINTER(nw_impact)]),
    "nw_outcome_init": (c_int32, [POINTER(nw_outcome)]),
    "nw_resolve": (c_int32, [c_void_p, POINTER(nw_impact), POINTER(nw_outcome)]),
    "nw_explain": (c_int32, [c_void_p, POINTER(nw_impact), c_char_p, c_size_t]),
    "nw_beyond": (c_int32, [c_void_p, POINTER(nw_impact), c_char_p, c_size_t]),
    "nw_unlikely": (c_int32, [POINTER(nw_impact), c_char_p, c_size_t]),
    "nw_key_of_values": (c_int32, [POINTER(c_double), c_size_t, POINTER(c_uint64)]),
    "nw_speeds": (c_int32, [c_void_p, POINTER(nw_impact), POINTER(c_double), POINTER(c_double), POINTER(c_double)]),
    "nw_particle_density": (c_int32, [c_void_p, POINTER(nw_impact), POINTER(c_double)]),
    "nw_erosion": (c_int32, [c_void_p, POINTER(nw_impact), c_double, POINTER(c_double)]),
    "nw_temperature_ranges": (c_int32, [c_void_p, c_uint32, POINTER(c_double), POINTER(c_double), POINTER(c_double), POINTER(c_double)]),
    "nw_resolve_batch": (c_int32, [c_void_p, POINTER(nw_impacts), POINTER(nw_outcomes), POINTER(c_size_t)]),
    "nw_wall_cooling_init": (c_int32, [POINTER(nw_wall_cooling)]),
    "nw_wall_heat_init": (c_int32, [POINTER(nw_wall_heat)]),
    "nw_deposit_heat": (c_int32, [c_void_p, POINTER(nw_deposit), c_double, POINTER(nw_wall_cooling), POINTER(nw_wall_heat)]),
    "nw_contact_heat": (c_int32, [c_void_p, POINTER(nw_impact), POINTER(c_double)]),
    "nw_heat_brought": (c_int32, [c_void_p, POINTER(nw_impact), c_double, POINTER(c_double)]),
    "nw_deposit_init": (c_int32, [POINTER(nw_deposit)]),
    "nw_deposit_initial": (c_int32, [c_void_p, c_double, POINTER(nw_deposit)]),
    "nw_deposit_source_init": (c_int32, [POINTER(nw_deposit_source)]),
    "nw_deposit_source_add": (c_int32, [c_void_p, POINTER(nw_impact), c_double, c_double, POINTER(nw_deposit_source)]),
    "nw_deposit_add": (c_int32, [POINTER(nw_deposit_source), POINTER(nw_deposit)]),
    "nw_deposit_apply": (c_int32, [c_void_p, POINTER(nw_deposit), c_double, POINTER(nw_impact)]),
    "nw_film_velocity": (c_int32, [c_void_p, POINTER(nw_deposit), c_double, c_double, POINTER(c_double)]),
    "nw_cooled_film_velocity": (c_int32, [c_void_p, POINTER(nw_deposit), c_double, c_double, c_double, POINTER(c_double)]),
    "nw_extra_input_count": (c_int32, [c_void_p, POINTER(c_uint32)]),
    "nw_extra_input_name": (c_int32, [c_void_p, c_uint32, c_char_p, c_size_t]),
    "nw_extra_input_default": (c_int32, [c_void_p, c_uint32, POINTER(c_double)]),
    "nw_extra_input_word": (c_int32, [c_void_p, c_uint32, c_uint32, c_char_p, c_size_t]),
    "nw_extra_input_value": (c_int32, [c_void_p, c_uint32, c_char_p, POINTER(c_double), c_char_p, c_size_t]),
    "nw_deposit_surroundings_init": (c_int32, [POINTER(nw_deposit_surroundings)]),
    "nw_deposit_losses_init": (c_int32, [POINTER(nw_deposit_losses)]),
    "nw_deposit_advance": (c_int32, [c_void_p, POINTER(nw_deposit_surroundings), POINTER(nw_wall_cooling), c_double, POINTER(nw_deposit), POINTER(nw_deposit_losses)]),
    "nw_wall_processes": (c_int32, [c_void_p, c_uint32, POINTER(c_uint32)]),
    "nw_process_name": (c_char_p, [c_uint32]),
    "nw_process_loss": (c_char_p, [c_uint32]),
    "nw_process_gain": (c_char_p, [c_uint32]),
    "nw_walk_init": (c_int32, [POINTER(nw_walk)]),
    "nw_walk_advance": (c_int32, [POINTER(nw_walk)]),
    "nw_thermophoresis": (c_int32, [c_double, c_double, c_double, c_double, c_double, c_double, c_double, POINTER(c_double)]),
}
# END GENERATED

#: The regimes of impacts: SP sticky particle, NSP non-sticky particle, SW sticky wall, NSW non-sticky wall.
REGIMES = ("NSP-NSW", "NSP-SW", "SP-NSW", "SP-SW")
_REGIME_NAMES = numpy.array(REGIMES)


class Outcomes(NamedTuple):
    """The outcomes of N impacts, arrays of shape (N,). `e_n` and `e_t` [1] are those of a rebound, `p_stick` [1] is the
    probability of capture, `omega` the spin afterwards [rad/s], `regime` one of REGIMES, `stuck` 1 for a captured
    particle, `flags` OUTSIDE_VALID_RANGE or 0."""

    e_n: NDArray[numpy.float64]
    e_t: NDArray[numpy.float64]
    p_stick: NDArray[numpy.float64]
    omega: NDArray[numpy.float64]
    regime: NDArray[numpy.str_]
    stuck: NDArray[numpy.uint32]
    flags: NDArray[numpy.uint32]


class Speeds(NamedTuple):
    """Characteristic velocities [m/s] of an impact."""

    adhesive: float
    yielding: float
    sticking: float


class TemperatureRanges(NamedTuple):
    """Limits of temperature [K] of the properties of particle and wall."""

    particle_low: float
    particle_high: float
    wall_low: float
    wall_high: float


class Error(Exception):
    """Something that the library refuses; the text names file, line or key and the remedy, as that of the command does.
    `status` is the number of the C function, None from functions without one; `index` is the invalid impact or None."""

    def __init__(self, status: Optional[int], text: str, index: Optional[int] = None) -> None:
        super().__init__(text if index is None else f"impact {index}: {text}")
        self.status, self.index = status, index


class Deposit(nw_deposit):
    """The deposit on a piece of wall, per wall area, initially bare: masses of molten and frozen slag and powder [kg/m2],
    volume solid [m3/m2] and projected area cover [1] of the powder's particles, carbon conversion [1], volume closed
    [m3/m2] of the voids that sintering has closed, share behind [1] of the powder that slag has enclosed. From the wall
    outwards lie enclosed powder, frozen slag, molten slag and the other powder."""

    def __init__(self, wall: int = 0) -> None:
        super().__init__()
        _check(_library.nw_deposit_init(byref(self)))
        self.wall = _index("wall", wall, 32)

    def add(self, source: DepositSource) -> None:
        """Adds the particles captured in a step. Powder that melt buries lies below the slag then; mass is conserved."""
        _check(_library.nw_deposit_add(byref(source), byref(self)))


class DepositSource(nw_deposit_source):
    """Sum of the particles captured in a step, per wall area, initially zero; `Model.add_captured` adds to it."""

    def __init__(self) -> None:
        super().__init__()
        _check(_library.nw_deposit_source_init(byref(self)))


class WallCooling(nw_wall_cooling):
    """What cools and heats a wall: coolant_temperature and gas_temperature [K]; coolant_coefficient (infinite unless given)
    and gas_coefficient [W/(m2 K)]; wall_resistance, thickness over conductivity [m2 K/W]; emissivity [1]; irradiation and
    further_flux [W/m2]; gas_conductivity of the gas at void_temperature [K], unless given 0.026 W/(m K) at 293.15, and
    other_conductivity at other_temperature, which tell how it changes in the voids of the powder; as that of air unless
    given; vapour_fraction [1] in the gas, that of the model file unless given. The others are 0 unless given."""

    def __init__(self, coolant_temperature: float, gas_temperature: float, **others: float) -> None:
        super().__init__()
        _check(_library.nw_wall_cooling_init(byref(self)))
        _set_numbers(self, {"coolant_temperature": coolant_temperature, "gas_temperature": gas_temperature, **others})


def _set_numbers(struct: Structure, numbers: Dict[str, float]) -> None:
    """Sets numbers of a struct by name."""
    unknown = set(numbers) - {name for name, kind, *_ in struct._fields_ if kind is c_double}
    if unknown:
        raise TypeError(f"no such input: {', '.join(sorted(unknown))}")
    for name, value in numbers.items():
        setattr(struct, name, value)


class WallHeat(nw_wall_heat):
    """Temperatures of a wall from `Model.heat`: surface_temperature [K], the T_w of the next impact; wall_temperature [K]
    under the deposit, the T_under of the next impact; heat_flux [W/m2] from the gas, and coolant_flux to the coolant, which
    differs where slag melts or freezes; deposit_resistance [m2 K/W]; disagreement [K], above 1e-9 where conductivities and
    temperatures did not come to agree."""

    def __init__(self) -> None:
        super().__init__()
        _check(_library.nw_wall_heat_init(byref(self)))


class DepositSurroundings(nw_deposit_surroundings):
    """What surrounds a piece of wall with a deposit, with the share `voidage` of voids in fresh powder [1]. Further, 0 unless
    given: wall_temperature [K] of a wall that is not cooled, by which its slag is liquid; the gas's gas_density [kg/m3],
    kinematic_viscosity [m2/s], shear_down the slope and shear_across it [Pa]; gravity_outward from the wall and gravity_along
    it [m/s2]; draw, the rank of this piece of wall from the weakest, 0, to below 1. A piece keeps its draw."""

    def __init__(self, voidage: float, **others: float) -> None:
        super().__init__()
        _check(_library.nw_deposit_surroundings_init(byref(self)))
        _set_numbers(self, {"voidage": voidage, **others})


def _load() -> Any:
    here = os.path.dirname(os.path.abspath(__file__))
    name = f"libnearwall.so.{ABI_VERSION}"
    places = [os.path.join(here, "_compiled.abi3.so"), os.path.join(here, "..", "..", "..", "..", "lib", name)]
    found = next((place for place in places if os.path.exists(place)), name)
    library = ctypes.CDLL(os.environ.get("NEARWALL_LIBRARY") or found)
    version = library.nw_abi_version()
    if version != ABI_VERSION:
        raise ImportError(f"libnearwall has interface version {version}, this module is for {ABI_VERSION}")
    for function, (result, arguments) in FUNCTIONS.items():
        getattr(library, function).restype, getattr(library, function).argtypes = result, arguments
    return library


_library = _load()
VERSION: str = _library.nw_version().decode()


def _check(status: int, message: str = "", index: Optional[int] = None) -> None:
    if status != OK:
        raise Error(status, message or _library.nw_status_text(status).decode(), index)


def _column(name: str, value: Any, count: int, kind: Any) -> NDArray[Any]:
    """The array itself where it can be read in place, else a copy of that kind; a number is repeated."""
    if getattr(getattr(value, "dtype", None), "na_value", None) is not None:  # pandas' numbers with blanks
        value = value.to_numpy(dtype=float, na_value=numpy.nan) if kind is numpy.float64 else value.to_numpy()
    given = numpy.asarray(value)
    if given.ndim > 0 and given.shape != (count,):
        raise ValueError(f"{name} has shape {given.shape}, there are {count} impacts")
    if kind is not numpy.float64:
        bits = 8 * numpy.dtype(kind).itemsize
        if given.dtype.kind not in "iu":
            raise TypeError(f"{name} has to be of integers, not of {given.dtype}")
        if given.size and not 0 <= int(given.min()) <= int(given.max()) < 2**bits:
            raise ValueError(f"{name} has to be between 0 and 2**{bits} - 1")
    try:
        return numpy.full(count, given, kind) if given.ndim == 0 else numpy.ascontiguousarray(given, kind)
    except (TypeError, ValueError) as fault:
        raise TypeError(f"{name} has to be of numbers: {fault}") from None


def _numbers_of_words(value: Any, number_of: Callable[[str], Any]) -> Any:
    """The value with a number for each word; a value without words as it is."""
    if isinstance(value, str):
        return number_of(value)
    if isinstance(value, (int, float)) or isinstance(value, numpy.ndarray) and value.dtype.kind not in "OSU":
        return value
    words = numpy.asarray(value)
    if words.dtype.kind not in "OU" or not all(isinstance(word, str) for word in words.flat):
        return value
    different, places = numpy.unique(words.astype(str), return_inverse=True)
    return numpy.array([number_of(word) for word in different])[places.reshape(words.shape)]


def _index(name: str, value: int, bits: int) -> int:
    """An integer that fits into so many bits; C would truncate it."""
    if not 0 <= value < 2**bits:
        raise ValueError(f"{name} has to be between 0 and 2**{bits} - 1, not {value}")
    return value


def _text(name: str, value: Union[str, bytes, os.PathLike[str]]) -> bytes:
    """Bytes without a zero, which would end the string in C."""
    data = os.fsencode(value)
    if b"\0" in data:
        raise ValueError(f"{name} has a zero byte in it")
    return data


def unlikely(**inputs: float) -> str:
    """Which input of an impact is probably in another unit; empty if none is. A temperature in degrees Celsius above 150 is not
    seen."""
    impact, text = nw_impact(), ctypes.create_string_buffer(2048)
    _check(_library.nw_impact_init(byref(impact)))
    for name, value in inputs.items():
        if name not in INPUTS:
            raise TypeError(f"no such input: {name}")
        setattr(impact, name, value)
    _check(_library.nw_unlikely(byref(impact), text, len(text)))
    return text.value.decode()


def key_of_values(*values: float) -> int:
    """A key from numbers that tell an impact from all others on any number of ranks, for codes that do not number their particles."""
    key = c_uint64()
    _check(_library.nw_key_of_values((c_double * len(values))(*values), len(values), byref(key)))
    return key.value


class Walk:
    """The walk of the gas's fluctuating velocity along the path of a particle; keywords are the fields of `nw_walk`."""

    def __init__(self, **fields) -> None:
        self.fields = nw_walk()
        _check(_library.nw_walk_init(byref(self.fields)))
        self._set(fields)

    def _set(self, fields) -> None:
        for name, value in fields.items():
            kind = dict(nw_walk._fields_).get(name)
            if kind is None:
                raise TypeError(f"a walk has no {name}")
            setattr(self.fields, name, kind(*value) if hasattr(value, "__len__") else value)

    def advance(self, **fields) -> tuple[float, ...]:
        """Takes the walk on by the step that has brought the particle here; returns the fluctuation of the gas [m/s]."""
        self._set(fields)
        _check(_library.nw_walk_advance(byref(self.fields)))
        return tuple(self.fields.velocity)


def thermophoresis(*, temperature: float, density: float, viscosity: float, conductivity: float, mean_free_path: float,
                   diameter: float, particle_conductivity: float) -> float:
    """The thermophoretic force on a sphere over the gradient of the gas's temperature [N m/K]; all in SI units."""
    force = c_double()
    _check(_library.nw_thermophoresis(temperature, density, viscosity, conductivity, mean_free_path, diameter,
                                      particle_conductivity, byref(force)))
    return force.value


class Model:
    """A model file that was read: what happens when its particles hit its walls.

    `Model.from_file("nearWall.toml")` reads a file; `name` and `text` are its path and its content. `extra_inputs` are the
    names of the inputs that it declares.
    """

    name: str
    text: str
    extra_inputs: List[str]

    def __init__(self, handle: c_void_p, name: str, text: str) -> None:
        self._handle, self.name, self.text = handle, name, text
        self.extra_inputs = self._extra_inputs()

    def __repr__(self) -> str:
        return f"<nearwall.Model {self.name}>"

    @classmethod
    def from_file(cls, path: Union[str, os.PathLike[str]]) -> Model:
        """Reads a model file. Raises Error, which names file, line, column and key."""
        name = _text("path", path)
        try:
            # Only once: the file may be replaced meanwhile.
            with open(path, encoding="utf-8", newline="") as file:
                text = file.read()
        except (OSError, UnicodeDecodeError):
            # The library says what is wrong.
            return cls._read(_library.nw_model_load, os.fsdecode(path), "", name)
        return cls.from_toml(text, os.fsdecode(path))

    @classmethod
    def from_toml(cls, text: str, name: str = "model") -> Model:
        """Reads the text of a model file; `name` stands for it in messages."""
        toml = text.encode()
        return cls._read(_library.nw_model_parse, name, text, toml, len(toml), os.fsencode(name))

    @classmethod
    def _read(cls, function: Any, name: str, text: str, *arguments: Any) -> Model:
        handle, message = c_void_p(), ctypes.create_string_buffer(2048)
        status = function(*arguments, byref(handle), message, len(message))
        _check(status, message.value.decode(errors="replace"))
        return cls(handle, name, text)

    def __reduce__(self) -> Tuple[Any, ...]:
        return Model.from_toml, (self.text, self.name)

    def __del__(self) -> None:
        if getattr(self, "_handle", None):
            _library.nw_model_free(self._handle)
            self._handle = c_void_p()

    def _extra_inputs(self) -> List[str]:
        count, name = c_uint32(), ctypes.create_string_buffer(2048)
        _check(_library.nw_extra_input_count(self._handle, byref(count)))
        names = []
        for index in range(count.value):
            _check(_library.nw_extra_input_name(self._handle, index, name, len(name)))
            names.append(name.value.decode(errors="replace"))
        return names

    def extra_input_default(self, name: str) -> float:
        """Value of an input of the model file where an impact does not state it; NaN if the file has none."""
        value = c_double()
        _check(_library.nw_extra_input_default(self._handle, self.extra_inputs.index(name), byref(value)))
        return value.value

    def extra_input_words(self, name: str) -> List[str]:
        """Words of an input of words in the model file, the value of each being its place; empty for a number."""
        words: List[str] = []
        index, word = self.extra_inputs.index(name), ctypes.create_string_buffer(2048)
        while _library.nw_extra_input_word(self._handle, index, len(words), word, len(word)) == OK:
            words.append(word.value.decode(errors="replace"))
        return words

    def extra_input_value(self, name: str, text: str) -> float:
        """Value of a text, a number or one of the words of an input of the model file."""
        value, message = c_double(), ctypes.create_string_buffer(2048)
        index, data = self.extra_inputs.index(name), _text(name, text)
        status = _library.nw_extra_input_value(self._handle, index, data, byref(value), message, len(message))
        _check(status, message.value.decode(errors="replace"))
        return value.value

    def _numbers(self, inputs: Dict[str, Any]) -> Dict[str, Any]:
        """The inputs with a number for each word."""
        unknown = set(inputs) - set(INPUTS) - set(self.extra_inputs)
        if unknown:
            raise TypeError(f"no such input: {', '.join(sorted(unknown))}")
        def number_of(name: str) -> Callable[[str], float]:
            return lambda word: self.extra_input_value(name, word)
        words = {name: _numbers_of_words(value, number_of(name)) for name, value in inputs.items() if name not in INPUTS}
        return {**inputs, **words}

    def _wall(self, wall: Wall) -> int:
        """The index of a wall given by name or index."""
        return self.find_wall(wall) if isinstance(wall, str) else _index("wall", int(wall), 32)

    def _impact(self, wall: Wall, inputs: Dict[str, Any]) -> nw_impact:
        """One impact from numbers and words."""
        impact = nw_impact()
        _check(_library.nw_impact_init(byref(impact)))
        impact.wall = self._wall(wall)
        for name, value in self._numbers(inputs).items():
            if name in INPUTS:
                setattr(impact, name, value)
            else:
                impact.extra[self.extra_inputs.index(name)] = value
        return impact

    def find_wall(self, name: str) -> int:
        """Index of the wall of a patch."""
        wall = c_uint32()
        _check(_library.nw_model_find_wall(self._handle, _text("name", name), byref(wall)))
        return wall.value

    def resolve(self, v_n: Input, wall: Any = 0, seed: int = 0, key: Any = None, **inputs: Input) -> Outcomes:
        """Resolves N impacts, with one random draw for each.

        v_n: normal speed [m/s], a number or N of them: an array, a list, a column of a frame. Contiguous arrays of float64 are
            read in place, all else is copied.
        wall: name of a wall or its index (`find_wall`), or N of them.
        seed, key: the random draws depend only on them; `key` has a unique integer for each impact, by default its index.
        inputs: v_t [m/s], omega [rad/s], d [m], T_p and T_w [K], rho_p [kg/m3], conversion [1] and the others of INPUTS and
            of `extra_inputs`, each a number or N of them; for an input of words also words.
        Returns Outcomes, arrays of shape (N,). Raises Error with the `index` of the first impact that cannot be decided. A
        warning lists the inputs that were assumed, and how many impacts lie outside a stated range.
        """
        given = {"v_n": v_n, **self._numbers(inputs)}
        wall = _numbers_of_words(wall, self.find_wall)
        many = [value for value in (*given.values(), wall, key) if numpy.ndim(value) > 0]
        count = len(many[0]) if many else 1
        columns = {name: _column(name, value, count, numpy.float64) for name, value in given.items()}
        if key is not None:
            if numpy.ndim(key) == 0 and count > 1:
                raise TypeError("key has to be an array: with one number every impact would have the same random draws")
            columns["key"] = _column("key", key, count, numpy.uint64)
        if numpy.ndim(wall) > 0:
            columns["walls"] = _column("wall", wall, count, numpy.uint32)
        impacts = nw_impacts(struct_size=ctypes.sizeof(nw_impacts), wall=0 if numpy.ndim(wall) else self._wall(wall), count=count,
                           seed=_index("seed", seed, 64))
        for name, column in columns.items():
            if name in self.extra_inputs:
                impacts.extra[self.extra_inputs.index(name)] = column.ctypes.data
            else:
                setattr(impacts, name, column.ctypes.data)
        found = [numpy.empty(count, numpy.float64 if place < 4 else numpy.uint32) for place in range(7)]
        outcomes = nw_outcomes(ctypes.sizeof(nw_outcomes), *(column.ctypes.data for column in found))
        none = ctypes.c_size_t(-1).value
        first_bad = c_size_t(none)
        status = _library.nw_resolve_batch(self._handle, byref(impacts), byref(outcomes), byref(first_bad))
        _check(status, index=None if first_bad.value == none else first_bad.value)
        self._warn(columns, found[6])
        del columns  # before the names of the regimes take their memory
        e_n, e_t, p_stick, omega, regime, stuck, flags = found
        return Outcomes(e_n, e_t, p_stick, omega, _REGIME_NAMES[regime], stuck, flags)

    def _warn(self, given: Dict[str, Any], flags: NDArray[numpy.uint32]) -> None:
        """Warns of inputs that were assumed and of ranges that were left."""
        impact = self._impact(0, {})
        assumed = [f"{name} = {getattr(impact, name):g}" for name in INPUTS if name not in given and getattr(impact, name)]
        if assumed:
            warnings.warn(f"assumed, in SI units: {', '.join(assumed)}", stacklevel=3)
        beyond = numpy.flatnonzero(flags & OUTSIDE_VALID_RANGE)
        if beyond.size:
            warnings.warn(f"{beyond.size} of {flags.size} impacts lie outside a stated range, the first at index {beyond[0]}; "
                          "Model.beyond and nearwall.predict say which and whether it matters", stacklevel=3)

    def speeds(self, wall: Wall = 0, **inputs: Union[float, str]) -> Speeds:
        """Adhesive, yield and sticking velocity [m/s] of one impact; inputs are numbers, named as in `resolve`."""
        impact = self._impact(wall, inputs)
        found = [c_double() for _ in range(3)]
        _check(_library.nw_speeds(self._handle, byref(impact), *map(byref, found)))
        return Speeds(*(number.value for number in found))

    def particle_density(self, **inputs: Union[float, str]) -> float:
        """Density [kg/m3] of the particle's material, which is taken where the input rho_p is 0."""
        impact, found = self._impact(0, inputs), c_double()
        _check(_library.nw_particle_density(self._handle, byref(impact), byref(found)))
        return found.value

    def erosion(self, mass: float, wall: Wall = 0, **inputs: Union[float, str]) -> float:
        """Volume of wall [m3] that particles of a total `mass` [kg] remove by impacts like this one."""
        impact, found = self._impact(wall, inputs), c_double()
        _check(_library.nw_erosion(self._handle, byref(impact), mass, byref(found)))
        return found.value

    def explain(self, v_n: float, wall: Wall = 0, **inputs: Union[float, str]) -> str:
        """Why an impact cannot be decided: the input, or material, property and range; empty if it can be."""
        impact, text = self._impact(wall, {"v_n": v_n, **inputs}), ctypes.create_string_buffer(2048)
        status = _library.nw_explain(self._handle, byref(impact), text, len(text))
        return text.value.decode() if status else ""

    def beyond(self, v_n: float, wall: Wall = 0, **inputs: Union[float, str]) -> list[str]:
        """What an impact uses outside of its stated range: properties and laws with their ranges; empty if all are kept."""
        impact, text = self._impact(wall, {"v_n": v_n, **inputs}), ctypes.create_string_buffer(2048)
        _check(_library.nw_beyond(self._handle, byref(impact), text, len(text)))
        return text.value.decode().splitlines()

    def temperature_ranges(self, wall: Wall = 0) -> TemperatureRanges:
        """Temperatures [K] for which the properties of particle and wall are defined."""
        found = [c_double() for _ in range(4)]
        _check(_library.nw_temperature_ranges(self._handle, self._wall(wall), *map(byref, found)))
        return TemperatureRanges(*(number.value for number in found))

    def initial_deposit(self, wall: Wall, voidage: float) -> Deposit:
        """The initial deposit of a wall in the model file; `voidage` is the share of voids in the powder [1]."""
        deposit = Deposit(self._wall(wall))
        _check(_library.nw_deposit_initial(self._handle, voidage, byref(deposit)))
        return deposit

    def apply_deposit(self, deposit: Deposit, voidage: float, T_w: float, d: float = 1e-4) -> Dict[str, Any]:
        """Arguments of `resolve` for impacts of particles of diameter d [m] on a deposit, whose wall has T_w [K]:
        resolve(d=d, ..., **apply_deposit(..., d)). Powder under slag that is thin against d is met, too."""
        impact = self._impact(deposit.wall, {"T_w": T_w, "d": d})
        _check(_library.nw_deposit_apply(self._handle, byref(deposit), voidage, byref(impact)))
        names = ("wall", "T_w", "layer_thickness", "coverage", "melt_thickness")
        return {name: getattr(impact, name) for name in names}

    def add_captured(self, source: DepositSource, mass: float, density: float, T_w: float, wall: Wall = 0,
                     **inputs: Union[float, str]) -> None:
        """Adds a captured particle: its `mass` per wall area [kg/m2] and its `density` [kg/m3]. The wall temperature T_w [K]
        decides whether it counts as molten; inputs are numbers, named as in `resolve`."""
        impact = self._impact(wall, {"T_w": T_w, **inputs})
        _check(_library.nw_deposit_source_add(self._handle, byref(impact), mass, density, byref(source)))

    def heat_brought(self, T_w: float, wall: int = 0, heat_capacity: float = 0.0, **inputs: Union[float, str]) -> float:
        """Heat [J/kg] that a captured particle brings to the surface of T_w [K] that it lands on, with its
        `heat_capacity` [J/(kg K)], or 0 for that of its material; inputs are numbers, named as in `resolve`."""
        impact, found = self._impact(wall, {"T_w": T_w, **inputs}), c_double()
        _check(_library.nw_heat_brought(self._handle, byref(impact), heat_capacity, byref(found)))
        return found.value

    def contact_heat(self, v_n: float, wall: Wall = 0, **inputs: Union[float, str]) -> float:
        """Heat [J] that one particle gives to the wall while it touches it and rebounds, where the wall's `contact_heat`
        asks for it."""
        impact, found = self._impact(wall, {"v_n": v_n, **inputs}), c_double()
        _check(_library.nw_contact_heat(self._handle, byref(impact), byref(found)))
        return found.value

    def film_velocity(self, deposit: Deposit, T_w: float, gravity_along: float, heat_flux: Optional[float] = None) -> float:
        """Mean speed [m/s] at which the melt runs down a wall of T_w [K]; gravity along the wall in m/s2. With a `heat_flux` to a
        cooled wall [W/m2], T_w is that of the surface, and the melt is colder below."""
        found = c_double()
        if heat_flux is None:
            _check(_library.nw_film_velocity(self._handle, byref(deposit), T_w, gravity_along, byref(found)))
        else:
            _check(_library.nw_cooled_film_velocity(
                self._handle, byref(deposit), T_w, heat_flux, gravity_along, byref(found)))
        return found.value

    def heat(self, deposit: Deposit, voidage: float, cooling: WallCooling) -> WallHeat:
        """The temperatures of a wall under its deposit, a WallHeat; `voidage` is the share of voids in fresh powder [1],
        `cooling` a WallCooling."""
        found = WallHeat()
        _check(_library.nw_deposit_heat(self._handle, byref(deposit), voidage, byref(cooling), byref(found)))
        return found

    def advance_deposit(self, deposit: Deposit, surroundings: DepositSurroundings, duration: float,
                        cooling: Optional[WallCooling] = None) -> Dict[str, float]:
        """Advances a deposit by a step of a `duration` [s]: with the `cooling` of its wall it melts, freezes and sinters, by
        the heat of a gas_coefficient that is finite; the gas carries loose powder away, and what the wall cannot hold falls off. Returns the mass [kg/m2] that left by each
        process, as `resuspended` and `shed`, or came, as `condensed`. These act on walls with a table of the process in the model
        file. Raises Error, and leaves the deposit as it is, where a number has no meaning or the model has no such wall."""
        losses = nw_deposit_losses()
        _check(_library.nw_deposit_losses_init(byref(losses)))
        _check(_library.nw_deposit_advance(
            self._handle, byref(surroundings), None if cooling is None else byref(cooling), duration, byref(deposit),
            byref(losses)))
        masses = {}
        for index, mass in enumerate(losses.mass):
            masses[_library.nw_process_loss(index).decode()] = mass
            masses[_library.nw_process_gain(index).decode()] = 0.0 - mass  # no negative zero
        del masses[""]
        return masses

    def wall_processes(self, wall: Wall = 0) -> List[str]:
        """Names of the processes that change a deposit on a wall, in the order in which they act."""
        found = c_uint32()
        _check(_library.nw_wall_processes(self._handle, self._wall(wall), byref(found)))
        return [_library.nw_process_name(index).decode() for index in range(PROCESSES) if found.value >> index & 1]

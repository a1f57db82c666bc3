"""What happens when a particle hits a wall: sticking, rebound, sliding.

    import nearwall
    model = nearwall.Model.from_file("nearWall.toml")
    out = model.resolve(v_n, d=d, T_p=T_p)            # NumPy arrays in SI units, read in place
    frame = nearwall.predict(frame, model)            # adds e_n, e_t, p_stick and regime to a pandas or polars frame
    found = nearwall.diagnose(measured, model)        # findings, intervals, gain and the extended model
    case = nearwall.openfoam.Case("run")              # tables, deposits and impacts of an OpenFOAM run as frames

Everything is in SI units. Errors are `nearwall.Error`, with the text that the command `nearwall` prints.
"""

from . import openfoam
from .diagnosis import Diagnosis, Finding, Gain, Parameter, diagnose
from .library import (ABI_VERSION, BAD_STATE, EXTRA_INPUTS, FILE, INPUTS, MODEL, NO_CONDUCTIVITY, NOT_UTF8, NSP_NSW, NSP_SW,
                      NULL_POINTER, OK, OUT_OF_RANGE, OUTSIDE_VALID_RANGE, PANIC, REGIMES, SP_NSW, SP_SW, STRUCT_SIZE,
                      UNKNOWN_INPUT, UNKNOWN_WALL, VERSION, Deposit, DepositSource, DepositSurroundings, Error, Model,
                      Outcomes, Speeds, TemperatureRanges, Walk, WallCooling, WallHeat, key_of_values,
                      thermophoresis, unlikely)
from .materials import Material, Property, materials
from .pages import Comparison, Map, Page, Sensitivity, check, compare, map, report, sensitivity
from .prediction import predict
from .simulation import Simulation, simulate

__version__ = VERSION

__all__ = [
    "ABI_VERSION", "BAD_STATE", "EXTRA_INPUTS", "FILE", "INPUTS", "MODEL", "NOT_UTF8", "NO_CONDUCTIVITY", "NSP_NSW", "NSP_SW",
    "NULL_POINTER", "OK", "OUTSIDE_VALID_RANGE", "OUT_OF_RANGE", "PANIC", "REGIMES", "SP_NSW", "SP_SW", "STRUCT_SIZE",
    "UNKNOWN_INPUT", "UNKNOWN_WALL", "VERSION", "Walk", "Comparison", "Deposit", "DepositSource", "DepositSurroundings", "Diagnosis", "Error", "Finding",
    "Gain", "Map", "Material", "Model", "Outcomes", "Page", "Parameter", "Property", "Sensitivity", "Simulation", "Speeds", "TemperatureRanges", "WallCooling", "WallHeat",
    "check", "compare", "diagnose", "key_of_values", "map", "materials", "openfoam", "predict", "report", "sensitivity", "simulate",
    "thermophoresis", "unlikely"]

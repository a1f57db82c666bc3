"""Resolves the impacts of a file as NumPy arrays.

    PYTHONPATH=$(pkg-config --variable=python_path nearwall) python3 example.py nearWall.toml impacts.csv

The table has the columns v_n,v_t,d,T_p,T_w (SI units) and one header line; more pairs of model and table may follow.
Prints e_n, e_t, the capture probability and 1 (captured) or 0 for each impact.
"""

import sys

import numpy

import nearwall


def decide(model_file, table_file):
    model = nearwall.Model.from_file(model_file)
    rows = numpy.loadtxt(table_file, delimiter=",", skiprows=1, ndmin=2)
    v_n, v_t, d, T_p, T_w = numpy.ascontiguousarray(rows.T)
    out = model.resolve(v_n, wall=model.find_wall("default"), seed=1, v_t=v_t, d=d, T_p=T_p, T_w=T_w)
    for e_n, e_t, p_stick, stuck in zip(out.e_n, out.e_t, out.p_stick, out.stuck):
        print(f"{e_n:.17g} {e_t:.17g} {p_stick:.17g} {stuck}")


for pair in range(1, len(sys.argv) - 1, 2):
    decide(sys.argv[pair], sys.argv[pair + 1])

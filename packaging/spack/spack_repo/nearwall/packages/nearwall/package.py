# SPDX-License-Identifier: MIT OR Apache-2.0
"""Spack recipe of nearwall; packaging/README.md has the commands."""

import os

from spack.package import *

try:
    from spack_repo.builtin.build_systems.generic import Package
except ImportError:  # Spack before 1.0 has it in spack.package
    pass


class Nearwall(Package):
    """What happens when a particle hits a wall: restitution and capture from contact mechanics,
    temperature and stickiness. A library for C, C++, Fortran and Python, a command, and with
    +openfoam the patch interaction model nearWallInteraction."""

    # The checkout that holds this recipe.
    git = "file://" + os.path.abspath(os.path.join(os.path.dirname(__file__), *[os.pardir] * 6))

    license("MIT OR Apache-2.0", when="~openfoam")
    license("(MIT OR Apache-2.0) AND GPL-3.0-or-later", when="+openfoam")

    version("main", branch="main")
    version("0.1.0", tag="v0.1.0")

    variant("openfoam", default=False, description="Build the OpenFOAM library nearWallInteraction")

    depends_on("c", type="build")
    depends_on("cxx", type="build", when="+openfoam")
    depends_on("rust@1.89:", type="build")
    depends_on("openfoam@1912:+source", when="+openfoam", type=("build", "link", "run"))

    def install(self, spec, prefix):
        which("make", required=True)(
            "-C", "packaging", "install", f"PREFIX={prefix}", "DESTDIR=", extra_env={"CARGO_BUILD_JOBS": str(make_jobs)}
        )
        if spec.satisfies("+openfoam"):
            # Allwmake fills FOAM_USER_LIBBIN; OpenFOAM's own environment is set by its recipe.
            Executable("openfoam/Allwmake")(
                extra_env={"FOAM_USER_LIBBIN": str(prefix.lib), "NEARWALL_JOBS": str(make_jobs)}
            )

    def setup_run_environment(self, env):
        if self.spec.satisfies("+openfoam"):
            env.prepend_path("LD_LIBRARY_PATH", self.prefix.lib)

// SPDX-FileCopyrightText: 2026 the nearwall authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// uncoupledKinematicParcelFoam that goes back, as implicit coupling does: it
// computes each window of `-steps` time steps `-repeats` times more.

#include "fvCFD.H"
#include "psiThermo.H"
#include "turbulentFluidThermoModel.H"
#include "basicKinematicCloud.H"
#include "rewindable.H"

int main(int argc, char *argv[])
{
    argList::addOption("repeats", "number", "times that each window is repeated");
    argList::addOption("steps", "number", "steps of a window");
    argList::addOption("cloud", "name", "name of the cloud");

    #include "setRootCaseLists.H"
    #include "createTime.H"
    #include "createMesh.H"
    #include "createFields.H"

    const label repeats = args.lookupOrDefault<label>("repeats", 0);
    const label steps = args.lookupOrDefault<label>("steps", 1);
    auto& walls = nearWall::rewindable::of(mesh, kinematicCloudName);

    while (runTime.run())
    {
        const scalar start = runTime.value();
        const label index = runTime.timeIndex();
        const nearWall::rewindable::state before(walls.save());

        for (label pass = 0; pass <= repeats; ++pass)
        {
            if (pass > 0)
            {
                kinematicCloud.restoreState();
                walls.restore(before);
                runTime.setTime(start, index);
            }
            if (pass < repeats) kinematicCloud.storeState();

            for (label step = 0; step < steps; ++step)
            {
                // Not run(), which writes for the step before
                const scalar dt = runTime.deltaTValue();
                if (runTime.value() > runTime.endTime().value() - 0.5*dt) break;

                ++runTime;
                Info<< "Time = " << runTime.timeName() << nl << endl;
                kinematicCloud.evolve();
                runTime.write();
            }
        }
    }
    return 0;
}

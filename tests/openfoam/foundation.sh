# Sourced by run: a test case as the Foundation's OpenFOAM (tried with 12) wants it.
# The solvers are modules of foamRun, a cloud names its type, and some keys have
# other names.

# The cases that run there. The others need what those versions do not have (the heterogeneous cloud, localInteraction on
# cyclic patches, tables of injection that name other columns) or name otherwise (movers of the mesh, coordinates,
# OpenFOAM.com's tutorials), or compare with places and times by hand: the function object `particles` solves once more at
# the start of a run and after the fields of its time are written.
foundation_cases="kinematic colliding mppic coal multiphase spray reacting single spin allwmake stuck cost remove inline groups
    list soft_restart unusable outside fields draws one-rank memory hot-wall cooled grown forgotten density extra-inputs film-effect alone bad-input"

# kind: change the case in this folder
as_foundation() {
    local c module="" types="" extra=""
    case "$1" in
        kinematic)  module="functions; subSolver incompressibleFluid"; types=cloud ;;
        colliding)  module="functions; subSolver incompressibleFluid"; types=collidingCloud ;;
        mppic)      module=incompressibleDenseParticleFluid; types=MPPICCloud
                    # With explicit sources only, the module misses a matrix
                    echo "solution { sourceTerms { schemes { U semiImplicit 1; } } }" >> constant/kinematicCloudProperties ;;
        coal)       module=multicomponentFluid; types="reactingMultiphaseCloud thermoCloud" ;;
        multiphase) module=multicomponentFluid; types=reactingMultiphaseCloud ;;
        spray)      module=multicomponentFluid; types=sprayCloud
                    # Without a drag SprayParcel divides by zero
                    echo "subModels { particleForces { sphereDrag; } }" >> constant/sprayCloudProperties ;;
        reacting)   module=multicomponentFluid; types=reactingCloud ;;
        *)          echo "the Foundation's versions have no cloud for '$1'" >&2; return 1 ;;
    esac
    solver=foamRun
    case "$module" in
        functions*)
            fields="U p"; gasT=""; thermoClass=""
            repeatsStep=yes     # its function object solves a step at each start of a run
            extra="functions { particles { type particles; libs (\"liblagrangianFunctionObjects.so\"); cloud $clouds; } }" ;;
        incompressible*)
            fields="U.air p"
            echo 'solvers { "alpha.*" { max 0.99; } }' >> system/fvSolution ;;
        *)
            fields="U p T species"; thermoClass=hePsiThermo
            with_header fvModels "clouds { type clouds; libs (\"liblagrangianParcel.so\"); clouds ($clouds); }" ;;
    esac
    moduleSettings="solver $module; $extra"

    rm -f constant/thermophysicalProperties constant/transportProperties constant/turbulenceProperties*
    physical_properties "${thermoClass:-}"
    { header wordList clouds; echo "($clouds)"; } > constant/clouds
    # shellcheck disable=SC2086
    set -- $types
    for c in $clouds; do echo "type $1;" >> "constant/${c}Properties"; shift; done
    with_header momentumTransport "simulationType laminar;"
    with_header momentumTransport.air "simulationType laminar;"
    # On the face between two cells a parcel would lie in either, by rounding
    sed -i '/^(0/ { s/ /37 /g; s/)/37)/ }' constant/parcels
    before_run
    sed -i 's/atomizationModel/atomisationModel/; s/breakupModel .*/& breakup none;/' constant/*loud*Properties
    for c in constant/limestoneCloud1Properties; do
        [ ! -e "$c" ] || echo "subModels { compositionModel singlePhaseMixture; singlePhaseMixtureCoeffs { phases ( solid { ash 1; } ); } }" >> "$c"
    done
    sed -i 's/Hf \([^;]*\);/Hf \1; hf \1;/' constant/thermo constant/condensed 2>/dev/null
}

# What a case added since it was built; a module that solves nothing writes no p, but reads it at a restart
before_run() {
    local t
    sed -i 's/parcelBasisType mass;/uniformParcelSize volume;/; s/parcelBasisType fixed;/uniformParcelSize nParticle;/
        s/fixedValueDistribution { value \([^}]*\); }/value \1;/; s/kinematicLookupTable/momentumLookupTable/' constant/cloudCommon constant/*Properties
    sed -i 's/kinematicParcelInjectionData/momentumParcelInjectionData/' constant/parcels
    for t in [1-9]* 0.* processor*/[1-9]* processor*/0.*; do
        [ ! -d "$t" ] || cp -n "${t%"${t##*/}"}0"/{p,U} "$t" 2>/dev/null
    done
}

physical_properties() {   # class of the gas, empty for an incompressible fluid
    if [ -z "$1" ]; then
        with_header physicalProperties "viscosityModel constant; nu 1.5e-5; rho 1.2; continuousPhaseName air; rho.air 1.2;"
        return
    fi
    [ -e constant/condensed ] || echo "liquids {} solids {}" > constant/condensed
    with_header physicalProperties "
thermoType
{
    type $1; mixture multicomponentMixture; transport const; thermo hConst;
    energy sensibleEnthalpy; equationOfState perfectGas; specie specie;
}
#include \"species\"
#include \"thermo\"
defaultSpecie N2;
#include \"condensed\""
}

with_header() {   # file text
    { header dictionary "$1"; echo "$2"; } > "constant/$1"
}

# Cases of run: a program that goes back in time, with the interface openfoam/rewind/rewindable.H.
# shellcheck shell=bash disable=SC2154

# program: compile tests/openfoam/rewind for the OpenFOAM that runs
build_rewinding() {
    local tree
    rm -rf "$work/rewindParcelFoam"; cp -r "$here/rewind" "$work/rewindParcelFoam" && mkdir -p "$work/bin"
    (
        cd "$work/rewindParcelFoam" || exit
        if [ "$NEARWALL_OPENFOAM" = debian ]; then
            tree="${NEARWALL_CACHE:-${XDG_CACHE_HOME:-$HOME/.cache}/nearwall}/openfoam-$(dpkg-query -W -f='${source:Version}' openfoam)"
            set +u
            unset WM_PROJECT_DIR WM_PROJECT
            # shellcheck disable=SC1091
            source "$tree/etc/bashrc"
            export WM_PROJECT_DIR="$tree" FOAM_LIBBIN=/usr/lib
        fi
        SOLVERS="$WM_PROJECT_DIR/applications/solvers" REWIND_EXE="$1" NEARWALL_LIB_DIR="$NEARWALL_LIB_DIR" wmake
    ) > "$work/log.rewinding" 2>&1
    [ -x "$1" ]
}

# Everything that a run writes: fields, parcels, totals and tables, but OpenFOAM's copy of the cloud and times of function objects
same_runs() { # name folder folder
    local difference
    if difference="$(diff -rq -x 'log.*' -x 'kinematicCloudCopy*' -x functionObjects -x settings "$2" "$3")"
    then ok "$1"; else bad "$1" "$(head -n 2 <<< "$difference" | tr '\n' ' ')"; fi
}

# Steps and windows computed four times leave no bit changed: parcels that stick, melt, run down, shed, are recorded
case_rewind() {
    local program="$work/bin/rewindParcelFoam" interval
    offers uncoupledKinematicParcelFoam || return
    build_rewinding "$program" || { bad rewind "cannot compile the program, see $work/log.rewinding"; return; }
    for interval in "" "intervalSteps 7;"; do
        shedding_box "$work/rewind" "$interval" || return
        sed -i '1i record { maxRows 100000; }' constant/interaction
        settings 0.12 0.05 startTime ascii
        rm -rf "$work/rewind-"*; cp -r . "$work/rewind-steps"; cp -r . "$work/rewind-windows"; cp -r . "$work/rewind-ranks"
        solve rewind once "$solver" || return
        cd "$work/rewind-steps" || return
        solve rewind steps "$program" -repeats 3 || return
        same_runs "rewind/steps ${interval:-each step}" "$work/rewind" .
        cd "$work/rewind-windows" || return
        solve rewind windows "$program" -repeats 3 -steps 9 || return
        same_runs "rewind/windows ${interval:-each step}" "$work/rewind" .
    done
    if awk 'NR > 1 { shed = $0 } END { exit shed == "" }' "$work/rewind/$(folder kinematicCloud)/floor.wall.dat" \
        && [ "$(wc -l < "$work/rewind/$(folder kinematicCloud)/impacts.csv")" -gt 100 ]
    then ok "rewind/of-something ($(wc -l < "$work/rewind/$(folder kinematicCloud)/impacts.csv") recorded lines, shed \
$(last "$work/rewind/$(folder kinematicCloud)/floor.wall.dat" shed_kg) kg)"
    else bad rewind/of-something "nothing happened"; fi

    # Two ranks, against two ranks without going back
    cd "$work/rewind-ranks" || return
    decompose_into 2 "(2 1 1)"
    cp -r . "$work/rewind-ranks-back"
    solve rewind ranks mpirun --oversubscribe -np 2 "$solver" -parallel || return
    cd "$work/rewind-ranks-back" || return
    solve rewind ranks-back mpirun --oversubscribe -np 2 "$program" -repeats 2 -steps 4 -parallel || return
    same_runs rewind/ranks "$work/rewind-ranks" .
}

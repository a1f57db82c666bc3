# Cases of run: stop and go on, on any number of ranks, also after a kill.
# shellcheck shell=bash disable=SC2154

# A closed box without gas forces in which n parcels, each with a diameter of
# its own by which it is known again, hit the walls until they stick, p = 0.2 or
# so by the melting transition. Numbers read back to the bit. No parcel starts
# where it could meet a rank's boundary while it is injected: OpenFOAM then
# forgets the rest of that step.
bouncing_box() {    # folder n
    build kinematic "$1" || return
    {
        header "GlobalIOList<kinematicParcelInjectionData>" parcels
        echo "("
        awk -v n="$2" 'BEGIN { srand(7); for (i = 0; i < n; i++) {
            do { x = 0.006 + 0.088*rand() } while (x > 0.044 && x < 0.056)
            do { y = 0.006 + 0.088*rand() } while (y > 0.044 && y < 0.056)
            do { z = 0.006 + 0.088*rand() } while (z > 0.044 && z < 0.058)
            printf "(%.9f %.9f %.9f) (%.9f %.9f %.9f) %.7e 1000 1e-6\n", x, y, z,
                1 + 0.5*rand(), 0.5 + 0.5*rand(), -2 - rand(), 1e-4 + 1e-9*i } }'
        echo ")"
    } > constant/parcels
    cat > constant/interaction <<'END'
model "<constant>/nearWall.toml";
particleTemperature 350;
patches
{
    ".*"   { type interact; wall default; wallTemperature 350; }
    outlet { type rebound; e 0.97; mu 0.02; }
}
END
    sed -i 's/e_n = 0.5/e_n = 0.93/; s/e_t = 0.75/e_t = 0.97/' constant/nearWall.toml
    printf '\n[[effects]]\nkind = "melting-transition"\ntemperature = 357\nwidth = 5\n' >> constant/nearWall.toml
    cat >> constant/kinematicCloudProperties <<'END'
subModels
{
    injectionModels
    {
        model1 { type kinematicLookupTableInjection; inputFile "parcels"; massTotal 1; duration 0.002; parcelsPerSecond 500.0001; randomise false; }
    }
}
cloudFunctions { hits { type $NEARWALL_ARRIVALS; maxStoredParcels 10000000; patches (floor lid sides outlet); } }
END
    sed -i 's/writePrecision .*/writePrecision 17;/' system/controlDict
}

ranks_are() {   # n
    local split="2 1 1"
    [ "$1" = 4 ] && split="2 2 1"
    [ "$1" = 8 ] && split="2 2 2"
    sed -i "s/numberOfSubdomains .*/numberOfSubdomains $1;/; s/n (. . .)/n ($split)/" system/decomposeParDict
}

# A wall field's values: patch value, for a list in one line or in many; nothing for a uniform value
face_values() {
    tr '\n()' '   ' < "$1" | awk -v RS='[ ;]+' '
        $1 == "floor" || $1 == "lid" || $1 == "sides" { patch = $1; list = 0; next }
        $1 == "{" { depth++ }
        $1 == "}" { depth-- }
        depth == 2 && $1 == "value" { list = patch != ""; next }
        depth < 2 && $1 == "}" { patch = "" }
        list == 1 && $1 == "nonuniform" { next }
        list == 1 { list = $1 == "List<scalar>" ? 2 : 0; next }
        list == 2 { list = 3; next }
        list == 3 && $1 ~ /^[-+0-9.]|^nan|^inf/ { print patch, $1; next }
        list == 3 { list = 0 }'
}

# What must be the same after all is done: totals, the wall fields face by face,
# and the deposit by diameter
state_of() {    # time-folder start-folder
    local d="$1/lagrangian/kinematicCloudDeposit" f
    totals kinematicCloud "$2"
    for f in depositedMass hitCount meanImpactSpeed; do
        face_values "$1/kinematicCloud:$f" | awk -v f="$f" '{ printf "%s-%s-%d %s\n", f, $1, ++k[$1], $2 }'
    done
    paste -d' ' <(values "$d/d") <(values "$d/captureTime") <(values "$d/positions" | cut -d' ' -f1-3) | sort -g | sed 's/^/deposit-/'
}

same_state() {  # name first second tolerance
    local difference
    if [ "$(grep -c ^deposit- "$2")" -gt 100 ] && grep -q '^hitCount' "$2" && difference="$(same_totals "$2" "$3" "$4")"
    then ok "$1 ($(grep -c ^deposit- "$2") deposited)"
    else bad "$1" "$(head -n 2 <<< "$difference" | tr '\n' ';')"; fi
}

# Stop at a written time and go on, from each of three and from all in a row
case_restarts() {
    local dir="$work/restarts" t next
    bouncing_box "$dir" 2000 || return
    settings 0.2 0.05 startTime ascii
    solve restarts whole "$solver" || return
    state_of 0.2 0 > state.whole
    for t in 0.05 0.1 0.15; do
        rm -rf "$dir-$t"; mkdir "$dir-$t"; cp -r 0 "$t" constant system "$dir-$t"; cd "$dir-$t" || return
        settings 0.2 0.05 latestTime ascii
        solve "restarts/$t" again "$solver" || return
        state_of 0.2 "$t" > state
        same_state "restarts/$t" "$dir/state.whole" state 1e-9
        check_balance "restarts/$t/balance" kinematicCloud "$t"
        cd "$dir" || return
    done
    rm -rf "$dir-row"; mkdir "$dir-row"; cp -r 0 constant system "$dir-row"; cd "$dir-row" || return
    t=0
    for next in 0.05 0.1 0.15 0.2; do
        settings "$next" 0.05 latestTime ascii
        solve "restarts/in-a-row" "$next" "$solver" || return
        [ "$next" = 0.2 ] || t="$next"
    done
    state_of 0.2 "$t" > state
    same_state "restarts/three-in-a-row" "$dir/state.whole" state 1e-9
    check_balance restarts/three-in-a-row/balance kinematicCloud 0.15
}

# The impacts that a stock cloud function recorded before the wall model acted,
# one a line with the patch in front, in the order of each parcel's path
impacts() {
    local f
    for f in floor lid sides outlet; do
        tail -q -n +2 postProcessing/lagrangian/kinematicCloud/hits/*/$f.{post,dat} 2>/dev/null | tr -d '()' | sed "s/^/$f /"
    done | LC_ALL=C sort -s -k2,2g -k15,15g
}

# Impact by impact: the same parcel (by its diameter) has the same next impact
# only if this one was decided the same way. Prints: impacts, equal, percent.
equal_decisions() {
    awk '
        { f = NR == FNR ? 1 : 2; n = ++count[f, $21]; at[f, $21, n] = $1 " " $2; if (f == 1) all[$21] = 1 }
        END {
            for (d in all) {
                m = count[1, d]; k = count[2, d]; total += m
                for (n = 1; n <= m && n <= k && at[1, d, n] == at[2, d, n]; n++);
                equal += (n > m && m == k) ? m : (n > 2 ? n - 2 : 0)
            }
            printf "%d %d %.5f\n", total, equal, 100*equal/total
        }' "$1" "$2"
}

# Serial, two, four and eight ranks on the same 10^5 impacts and more
case_ranks() {
    local dir="$work/ranks" n total equal percent
    bouncing_box "$dir" 21000 || return
    settings 0.3 0.3 startTime ascii
    for n in 2 4 8; do rm -rf "$dir-$n"; cp -r "$dir" "$dir-$n"; done
    solve ranks serial "$solver" || return
    impacts > impacts.list
    state_of 0.3 0 > state
    for n in 2 4 8; do
        cd "$dir-$n" || return
        ranks_are "$n"
        quiet decompose decomposePar
        solve "ranks/$n" ranks mpirun -np "$n" "$solver" -parallel || return
        quiet reconstruct reconstructPar -latestTime
        impacts > impacts.list
        state_of 0.3 0 > state
        read -r total equal percent <<< "$(equal_decisions "$dir/impacts.list" impacts.list)"
        if awk -v t="$total" -v p="$percent" 'BEGIN { exit !(t >= 1e5 && p >= 99.99) }'
        then ok "ranks/$n/decisions ($equal of $total impacts decided alike, $percent %)"
        else bad "ranks/$n/decisions" "$equal of $total impacts decided alike, $percent %"; fi
        same_state "ranks/$n/state" "$dir/state" state 1e-9
        check_balance "ranks/$n/balance" kinematicCloud 0
    done
    grazing
}

# A floor that is not along the axes, met at 0.001 to 0.1 degrees in a gas that
# drags along it: the normal speed is a small difference of large numbers, and
# ranks differ in it most
grazing() {
    local dir="$work/grazing" n total equal percent
    offers transformPoints || return
    bouncing_box "$dir" 10 || return
    quiet rotate transformPoints -rotate '((0 0 1) (0 -0.6 0.8))'
    {
        header "GlobalIOList<kinematicParcelInjectionData>" parcels
        echo "("
        awk 'BEGIN { srand(9); for (i = 0; i < 20000; i++) {
            vn = exp(log(2e-5) + rand()*log(100)); vy = 0.2 + 0.3*rand()
            do { x = 0.006 + 0.06*rand() } while (x > 0.044 && x < 0.056)
            y = 0.006 + 0.03*rand(); z = vn*(0.004 + 0.014*rand())
            printf "(%.12g %.12g %.12g) (%.12g %.12g %.12g) %.7e 1000 1e-6\n", x, 0.8*y - 0.6*z, 0.6*y + 0.8*z,
                0.5 + 0.3*rand(), 0.8*vy + 0.6*vn, 0.6*vy - 0.8*vn, 1e-4 + 1e-9*i } }'
        echo ")"
    } > constant/parcels
    sed -i 's/temperature = 357/temperature = 350/' constant/nearWall.toml
    sed -i 's/uniform (0 0 0)/uniform (0.3 0.16 0.12)/' 0/U
    sed -i 's/".\*" cell;/".*" cellPoint;/' constant/cloudCommon
    echo 'subModels { particleForces { sphereDrag; } }' >> constant/kinematicCloudProperties
    settings 0.06 0.06 startTime ascii
    rm -rf "$dir-2"; cp -r "$dir" "$dir-2"
    solve grazing serial "$solver" || return
    impacts | grep ^floor | awk '!seen[$21]++' > impacts.list
    values 0.06/lagrangian/kinematicCloudDeposit/d | sort > stuck.list
    cd "$dir-2" || return
    ranks_are 2
    quiet decompose decomposePar
    solve grazing ranks mpirun -np 2 "$solver" -parallel || return
    quiet reconstruct reconstructPar -latestTime
    values 0.06/lagrangian/kinematicCloudDeposit/d | sort > stuck.list
    total="$(wc -l < "$dir/impacts.list")"
    equal=$((total - $(comm -3 "$dir/stuck.list" stuck.list | wc -l)))
    if awk -v t="$total" -v e="$equal" -v s="$(wc -l < stuck.list)" \
        'BEGIN { exit !(t == 20000 && e >= 0.9999*t && s > 0.3*t && s < 0.7*t) }'
    then ok "ranks/grazing ($equal of $total decided alike, $(wc -l < stuck.list) stuck)"
    else bad ranks/grazing "$equal of $total decided alike, $(wc -l < stuck.list) stuck"
    fi
}

# All rows of a table over the starts of the solver: a later start replaces what
# an earlier one wrote after it
merged() {  # patch start...
    local patch="$1" start
    shift
    for start in "$@"; do grep -hv '^#' "$(folder kinematicCloud "$start")/$patch.dat" | sed "s/^/$start /"; done | awk '
        $1 != start { start = $1; for (i = n; i > 0 && time[i] >= $2; i--) n-- }
        { time[++n] = $2; row[n] = $0; sub(/^[^ ]+ /, "", row[n]) }
        END { for (i = 1; i <= n; i++) print row[i] }'
}

# SIGKILL between two writes, then go on from the last one
case_kill() {
    local dir="$work/kill" killed rows
    bouncing_box "$dir" 20000 || return
    settings 0.4 0.1 startTime ascii
    solve kill whole "$solver" || return
    state_of 0.4 0 > state.whole
    rm -rf "$dir-killed"; mkdir "$dir-killed"; cp -r 0 constant system "$dir-killed"; cd "$dir-killed" || return
    kill_at 0.15 killed
    killed="$(tail -n 1 "$(folder kinematicCloud)/balance.dat" | cut -d' ' -f1)"
    if awk -v t="$killed" 'BEGIN { exit !(t > 0.1001 && t < 0.2) }' && [ ! -e 0.2 ]
    then ok "kill/between-writes (last row at $killed s)"; else bad kill/between-writes "killed at $killed"; return; fi
    settings 0.4 0.1 latestTime ascii
    solve kill again "$solver" || return
    state_of 0.4 0.1 > state
    same_state kill/totals "$dir/state.whole" state 1e-9
    check_balance kill/balance kinematicCloud 0.1
    merged floor 0 0.1 > rows.merged
    (cd "$dir" && merged floor 0) > rows.whole
    # A start writes its first row also when nothing changed in its first step
    for rows in whole merged; do
        awk '{ now = $0; sub(/^[^ ]+/, "", now); if (now != before) print; before = now }' "rows.$rows" > rows && mv rows "rows.$rows"
    done
    rows="$(awk 'NR == FNR { t[NR] = $1; h[NR] = $2; n = NR; next } { if (($1 - t[FNR])^2 > 1e-18 || $2 != h[FNR]) bad++; m = FNR }
        END { print (n == m && !bad) ? "same" : n " and " m " rows, " bad " others" }' rows.whole rows.merged)"
    if [ "$rows" = same ]
    then ok "kill/tables ($(wc -l < rows.merged) rows, none twice, none lost)"
    else bad kill/tables "$rows"
    fi
}

# Serial, then decomposed where it stands, then put together, then serial again
case_decompose() {
    local dir="$work/decompose"
    bouncing_box "$dir" 2000 || return
    settings 0.3 0.1 startTime ascii
    solve decompose whole "$solver" || return
    state_of 0.3 0 > state.whole
    rm -rf "$dir-mid"; mkdir "$dir-mid"; cp -r 0 0.1 constant system "$dir-mid"; cd "$dir-mid" || return
    ranks_are 2
    quiet decompose decomposePar -latestTime
    settings 0.2 0.1 latestTime ascii
    solve decompose ranks mpirun -np 2 "$solver" -parallel || return
    quiet reconstruct reconstructPar -latestTime
    rm -rf processor*
    settings 0.3 0.1 latestTime ascii
    solve decompose serial "$solver" || return
    state_of 0.3 0.2 > state
    same_state decompose/serial-ranks-serial "$dir/state.whole" state 1e-9
    check_balance decompose/balance kinematicCloud 0.2
    redistribute "$dir"
}

# The same of a decomposed case, over all ranks: redistributePar numbers faces
# anew, so of the wall fields the sums over a patch
state_of_ranks() {  # time start-folder
    local f d
    totals kinematicCloud "$2"
    for f in depositedMass hitCount meanImpactSpeed; do
        for d in ${3-processor*}; do face_values "$d/$1/kinematicCloud:$f"; done |
            awk -v f="$f" '{ s[$1] += $2 } END { for (p in s) printf "%s-%s %.15g\n", f, p, s[p] }' | sort
    done
    for d in ${3-processor*}; do
        d="$d/$1/lagrangian/kinematicCloudDeposit"
        [ -d "$d" ] && paste -d' ' <(values "$d/d") <(values "$d/captureTime") <(values "$d/mass") <(values "$d/positions" | cut -d' ' -f1-3)
    done | awk '{ for (i = 1; i <= NF; i++) if ($i*$i < 1e-24) $i = 0 } 1' | sort -g | sed 's/^/deposit-/'
}

# All lies on one of two ranks when they start again, in files of either kind
case_one-rank() {
    local kind
    for kind in uncollated collated; do
        build kinematic "$work/one-rank-$kind" || return
        one_parcel
        sed -i 's/floor .*/floor { type stick; }/' constant/interaction
        quiet decompose decomposePar -fileHandler "$kind"
        settings 0.1 0.1
        solve "one-rank/$kind" run mpirun -np 2 "$solver" -parallel -fileHandler "$kind" || return
        settings 0.2 0.1 latestTime
        solve "one-rank/$kind" again mpirun -np 2 "$solver" -parallel -fileHandler "$kind" || return
        if [ "$(last "$(folder kinematicCloud 0.1)/balance.dat" stuck_in_cloud_kg)" = 1e-06 ]
        then ok "one-rank/$kind/kept"; else bad "one-rank/$kind/kept" "not 1e-06 kg after the restart"; fi
        check_balance "one-rank/$kind/balance" kinematicCloud 0.1
    done
}

# From two to four ranks on the way, by redistributePar. Its -reconstruct drops
# most files of every cloud in v1912, the solver's too: the ranks' own are read.
redistribute() {
    offers redistributePar || return
    rm -rf "$1-two"; mkdir "$1-two"; cp -r "$1/0" "$1/0.1" "$1/constant" "$1/system" "$1-two"; cd "$1-two" || return
    ranks_are 2
    quiet decompose decomposePar -latestTime
    settings 0.2 0.1 latestTime ascii
    solve redistribute two mpirun -np 2 "$solver" -parallel || return
    ranks_are 4
    mkdir -p processor2 processor3
    if ! quiet redistribute mpirun -np 4 redistributePar -parallel -overwrite -latestTime
    then bad redistribute "$(grep -A4 -m1 FATAL log.redistribute | tr -s '\n ' ' ')"; return; fi
    settings 0.3 0.1 latestTime ascii
    solve redistribute four mpirun -np 4 "$solver" -parallel || return
    state_of_ranks 0.3 0.2 > state
    (cd "$1" && state_of_ranks 0.3 0 .) > state.whole
    same_state decompose/redistributePar state.whole state 1e-9
    check_balance decompose/redistributePar/balance kinematicCloud 0.2
}

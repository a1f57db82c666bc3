# Cases of run: the record of single impacts, the distributions, and what
# nearwall diagnose makes of them.
# shellcheck shell=bash disable=SC2154

# Parcels of all speeds, angles and sizes a little above the floor, each of which
# hits it once. None meets the ranks' boundary while it is injected.
# file count seed: log-uniform 0.05 to 3 m/s, 10 to 90 degrees, 30 to 300 um
shower() {
    {
        header "GlobalIOList<kinematicParcelInjectionData>" "$1"
        echo "("
        awk -v n="$2" -v seed="$3" 'BEGIN {
            srand(seed); pi = atan2(0, -1)
            for (i = 0; i < n; i++) {
                speed = 0.05*exp(log(60)*rand()); angle = (10 + 80*rand())*pi/180; turn = 2*pi*rand()
                d = 30e-6*exp(log(10)*rand()); vn = speed*sin(angle); vt = speed*cos(angle)
                x = 0.015 + 0.02*rand() + (rand() < 0.5 ? 0 : 0.05); y = 0.015 + 0.02*rand() + (rand() < 0.5 ? 0 : 0.05)
                time = 0.0021 + (speed < 0.5 ? 0.02 : 0.0018)*rand()
                printf "(%.9g %.9g %.9g) (%.9g %.9g %.9g) %.9g 1000 1e-6\n", x, y, vn*time, vt*cos(turn), vt*sin(turn), -vn, d
            } }'
        echo ")"
    } > "constant/$1"
}

# A shower of so many parcels at the start, and another after the write in the
# middle; what leaves the floor is gone
two_showers() {
    shower early "$1" "$2"; shower late "$1" "$(($2 + 1))"
    sed -i 's/injectionModels/injectionModelsOfCommon/' constant/cloudCommon
    cat >> constant/kinematicCloudProperties <<END
showers { type kinematicLookupTableInjection; parcelBasisType $3; nParticle 1; massTotal 1e-4;
          duration 0.001; parcelsPerSecond 500.0001; randomise false; }
subModels
{
    injectionModels
    {
        early { \$showers; inputFile early; SOI 0;    injectorID 1; }
        late  { \$showers; inputFile late;  SOI 0.12; injectorID 2; }
    }
}
END
    cat > constant/interaction <<'END'
model "<constant>/nearWall.toml";
particleTemperature 300;
record { maxRows 100000; }
patches
{
    floor           { type interact; wallTemperature 300; }
    "lid|sides"     { type escape; }
}
END
}

# The last table of distributions of a patch: injector/quantity/low, the numbers
distributions() {   # start patch
    awk 'NR == 1 { next }
        $1 != time { time = $1; n = 0 }
        { key = $2 "/" $3 "/" $4; $1 = $2 = $3 = $4 = ""; row[n++] = key " " $0 }
        END { for (i = 0; i < n; i++) print row[i] }' "$(folder kinematicCloud "$1")/$2.distributions.dat"
}

# The classes of each quantity add up to what the patch's own table says
check_sums() {  # name start patch
    local file said
    file="$(folder kinematicCloud "$2")"
    if said="$(awk -v tol=1e-12 '
        FNR == 1 { delete at; for (i = 2; i <= NF; i++) at[$i] = i - 1; next }
        NR == FNR { for (c in at) own[c] = $at[c]; next }
        $1 != time { time = $1; delete sum }
        { for (i = 6; i <= NF; i++) sum[$3, i] += $i; quantities[$3] = 1 }
        END {
            split("hits particles mass_kg sticks stick_particles stick_mass_kg", here)
            split("hits hit_particles hit_mass_kg sticks stick_particles stick_mass_kg", there)
            for (q in quantities) for (j = 1; j <= 6; j++) {
                d = sum[q, at[here[j]]] - own[there[j]]; if (d < 0) d = -d
                if (d > tol*own[there[j]]) { print q " " here[j] ": " sum[q, at[here[j]]] " and " own[there[j]]; bad = 1 }
                n++
            }
            exit bad || n != 18
        }' "$file/$3.dat" "$file/$3.distributions.dat")"
    then ok "$1"; else bad "$1" "$(head -n 1 <<< "$said")"; fi
}

# Two records: the same rows, numbers to 1e-9 (zero: to 1e-12)
same_records() {
    paste -d ';' <(grep -v '^#' "$1") <(grep -v '^#' "$2") | awk -F ';' '
        {
            n = split($1, a, ","); m = split($2, b, ",")
            if (n != m) { print "row " NR ": " n " and " m " cells"; exit bad = 1 }
            for (i = 1; i <= n; i++) {
                if (a[i] == b[i]) continue
                d = a[i] - b[i]; if (d < 0) d = -d
                s = a[i] < 0 ? -a[i] : a[i]
                if (a[i] + 0 == 0 && a[i] != "0" || d > 1e-9*s + 1e-12) { print "row " NR " cell " i ": " a[i] " and " b[i]; exit bad = 1 }
            }
        }
        END { exit bad || NR < 2 }'
}

check_record() { # name file file
    local difference
    if difference="$(same_records "$2" "$3")"
    then ok "$1 ($(grep -vc '^[#t]' "$2") rows)"; else bad "$1" "$difference"; fi
}

# The rows by parcel, each known again by its diameter, in the order of the file and
# without the identity, which depends on the ranks
by_parcel() {
    grep -v '^[#t]' "$1" | cut -d, -f1-4,7- | LC_ALL=C sort -s -t, -k10,10g
}

check_histories() { # name file file
    by_parcel "$2" > first.parcels; by_parcel "$3" > second.parcels
    check_record "$1" first.parcels second.parcels
}

# Without gas a parcel flies straight: it arrives with the speed that it left with, and
# the way from impact to impact is that speed times its age's growth. So no impact is
# missing, none is another parcel's, and they are in order, also within a step.
check_flights() {   # name file
    local said
    if said="$(awk -F, '
        /^#/ { next }
        $1 == "time" { for (i = 1; i <= NF; i++) at[$i] = i; next }
        function off(a, b) { d = a - b; if (d < 0) d = -d; return d > 1e-6*(b + 1e-3) }
        {
            p = $at["origProcId"] "/" $at["origId"]; d = $at["d"]
            if (p in of && of[p] != d || d in is && is[d] != p) { print "parcel " p " of diameter " d " is not the only one"; bad = 1 }
            of[p] = d; is[d] = p
            v = sqrt($at["v_n"]^2 + $at["v_t"]^2)
            if (p in speed) {
                n++; twice += $1 == time[p]
                way = sqrt(($at["x"] - x[p])^2 + ($at["y"] - y[p])^2 + ($at["z"] - z[p])^2)
                if (off(v, speed[p]) || off(way, v*($at["parcel_age"] - age[p]))) { print "row " NR " does not follow"; bad = 1 }
            }
            speed[p] = sqrt(($at["e_n"]*$at["v_n"])^2 + ($at["e_t"]*$at["v_t"])^2); time[p] = $1; age[p] = $at["parcel_age"]
            x[p] = $at["x"]; y[p] = $at["y"]; z[p] = $at["z"]
        }
        END { print length(of) " parcels, " n " flights, " twice " within a step"; exit bad || n < 1000 || twice < 10 }' "$2")"
    then ok "$1 ($said)"; else bad "$1" "$(head -n 1 <<< "$said")"; fi
}

# Rows of some parcels, each with all its impacts
check_whole_parcels() { # name sampled whole share
    local said
    if said="$(awk -F, -v share="$4" '
        /^[#t]/ { next }
        { p = $5 "/" $6 }
        NR == FNR { some[p]++; rows++; next }
        { if (!(p in all)) parcels++; all[p]++ }
        END {
            for (p in some) { n++; if (some[p] != all[p]) { print "parcel " p ": " some[p] " of " all[p] " impacts"; bad = 1 } }
            e = (n - parcels/share)/sqrt(parcels/share)
            printf "%d rows, %d of %d parcels\n", rows, n, parcels
            exit bad || rows > 1000 || e < -4 || e > 4
        }' "$2" "$3")"
    then ok "$1 ($said)"; else bad "$1" "$(head -n 1 <<< "$said")"; fi
}

# The histories of all parcels: serial, on two ranks, over a restart on one and on two,
# and of a sample
case_histories() {
    local dir="$work/histories" file="impacts.csv" f share said
    bouncing_box "$dir" 2000 || return
    sed -i 's/outlet .*/outlet { type interact; wall default; wallTemperature 350; }/; 1i record { maxRows 100000; }' constant/interaction
    settings 0.2 0.1 startTime ascii
    rm -rf "$dir-ranks" "$dir-sampled"; cp -r "$dir" "$dir-ranks"; cp -r "$dir" "$dir-sampled"
    solve histories serial "$solver" || return
    f="$(folder kinematicCloud)"
    check_flights histories/serial "$f/$file"
    check_injected histories/injected 0 2000

    cd "$dir-ranks" || return
    quiet decompose decomposePar
    solve histories/ranks ranks mpirun -np 2 "$solver" -parallel || return
    check_flights histories/ranks/order "$f/$file"
    check_histories histories/ranks "$dir/$f/$file" "$f/$file"

    # The rows with their identities
    cd "$dir" || return
    cp "$f/$file" whole.csv
    rm -rf 0.2 "$dir-more"; cp -r "$dir" "$dir-more"
    settings 0.2 0.1 latestTime ascii
    solve histories/restart restart "$solver" || return
    check_record histories/restart whole.csv "$(folder kinematicCloud 0.1)/$file"
    cd "$dir-more" || return
    settings 0.2 0.1 latestTime ascii
    quiet decompose decomposePar -latestTime
    solve histories/more-ranks ranks mpirun -np 2 "$solver" -parallel || return
    check_record histories/more-ranks whole.csv "$(folder kinematicCloud 0.1)/$file"

    cd "$dir-sampled" || return
    sed -i 's/maxRows .*;/maxRows 1000;/' constant/interaction
    solve histories/sample sampled "$solver" || return
    share="$(sed -n '1s/.*: 1 in \([0-9]*\) .*/\1/p' "$f/$file")"
    check_whole_parcels histories/sample "$f/$file" "$dir/whole.csv" "${share:-1}"
    if said="$(comm -13 <(sort "$dir/whole.csv") <(grep -v '^#' "$f/$file" | sort))" && [ -z "$said" ]
    then ok histories/sample/rows; else bad histories/sample/rows "rows that the whole has not"; fi
}

# The balance counts the injected parcels
check_injected() {  # name start number
    local n
    n="$(last "$(folder kinematicCloud "$2")/balance.dat" injected_parcels)"
    if [ "$n" = "$3" ]; then ok "$1 ($n parcels)"; else bad "$1" "$n injected, expected $3"; fi
}

# Two ranks, then one, then two again: parcels injected later share no identity with
# those before
identities() {
    local dir="$work/recorder-identities" said
    build kinematic "$dir" || return
    two_showers 1500 5 mass
    thornton_ning ""
    settings 0.05 0.05
    quiet decompose decomposePar
    solve recorder/identities ranks mpirun -np 2 "$solver" -parallel || return
    quiet reconstruct reconstructPar -latestTime
    rm -rf processor*; settings 0.1 0.05 latestTime
    solve recorder/identities one "$solver" || return
    settings 0.2 0.05 latestTime
    quiet decompose.again decomposePar -latestTime
    solve recorder/identities again mpirun -np 2 "$solver" -parallel || return
    if said="$(awk -F, '
        /^[#t]/ { next }
        { n++; p = $5 "/" $6; d = $12; if (p in of && of[p] != d) { print "parcels of " of[p] " and " d " m are both " p; exit bad = 1 } of[p] = d }
        END { if (!bad) print n " rows"; exit bad || n < 2500 }' "$(folder kinematicCloud 0.1)/impacts.csv")"
    then ok "recorder/identities ($said)"; else bad recorder/identities "$said"; fi
    check_injected recorder/identities/injected 0.1 3000
}

thornton_ning() {   # effects, in TOML
    cat > constant/nearWall.toml <<END
[particle]
material = "montan-wax"

[walls.default]
material = "pyrex"

[normal]
model = "thornton-ning"
yield_ratio = 0.7

[tangential]
model = "constant"
e_t = 0.76
$1
END
}

# The record and the distributions: by hand, as a whole, sampled, on 2 and 4 ranks
# and over a restart. Other ranks give the parcels other identities, and so another
# sample: what must agree between ranks is the whole.
case_recorder() {
    local dir="$work/recorder" file="impacts.csv" f n ranks
    one_recorded
    identities
    build kinematic "$dir" || return
    two_showers 1500 5 mass
    thornton_ning ""
    solve recorder serial "$solver" || return
    f="$(folder kinematicCloud)"
    n="$(grep -vc '^[#t]' "$f/$file")"
    if [ "$n" = "$(last "$f/floor.dat" hits)" ] && [ "$n" -gt 2500 ] \
        && [ "$(grep -c ',stick,,$' "$f/$file")" = "$(last "$f/floor.dat" sticks)" ]
    then ok "recorder/all ($n rows)"; else bad recorder/all "$n rows of $(last "$f/floor.dat" hits)"; fi
    check_sums recorder/sums 0 floor
    check_flux recorder/flux
    distributions 0 floor > distributions
    cp "$f/$file" whole.csv

    sed -i 's/maxRows .*;/maxRows 200;/' constant/interaction
    rm -rf 0.1 0.2 postProcessing
    solve recorder sampled "$solver" || return
    cp "$f/$file" sampled.csv
    check_sample recorder/sample
    for ranks in 2 4; do
        rm -rf "$dir-$ranks"; cp -r "$dir" "$dir-$ranks"; cd "$dir-$ranks" || return
        rm -rf 0.1 0.2 postProcessing
        sed -i 's/maxRows .*;/maxRows 100000;/' constant/interaction
        if [ "$ranks" = 4 ]; then sed -i 's/(2 1 1)/(2 2 1)/; s/numberOfSubdomains 2/numberOfSubdomains 4/' system/decomposeParDict; fi
        quiet decompose decomposePar
        solve "recorder/ranks-$ranks" ranks mpirun -np "$ranks" "$solver" -parallel || return
        check_histories "recorder/ranks-$ranks" ../recorder/whole.csv "$f/$file"
        distributions 0 floor > distributions.ranks
        if n="$(same_totals distributions distributions.ranks 1e-12)"
        then ok "recorder/ranks-$ranks/distributions"
        else bad "recorder/ranks-$ranks/distributions" "$(head -n 1 <<< "$n")"
        fi
        check_sums "recorder/ranks-$ranks/sums" 0 floor
    done

    # The first run went on after 0.1 s, as one that was killed later: what it
    # recorded then must not be there twice
    rm -rf "$dir-restart"; cp -r "$dir" "$dir-restart"; cd "$dir-restart" || return
    rm -rf 0.2; settings 0.2 0.1 latestTime
    solve recorder/restart restart "$solver" || return
    check_record recorder/restart sampled.csv "$(folder kinematicCloud 0.1)/$file"
    distributions 0.1 floor > distributions.restart
    if n="$(same_totals distributions distributions.restart 1e-12)"
    then ok recorder/restart/distributions; else bad recorder/restart/distributions "$(head -n 1 <<< "$n")"; fi
    check_sums recorder/restart/sums 0.1 floor

    # Rows that someone removed are missed aloud
    rm -rf 0.2 postProcessing
    solve recorder/lost lost "$solver" || return
    if grep -q "impacts recorded before 0 are left" log.lost
    then ok recorder/lost; else bad recorder/lost "the log does not say that rows are missing"; fi
}

# (1 0 -2) from z = 0.051 m: after 0.0255 s, at x = 0.0465 m (OpenFOAM moves a parcel
# twice in its first step of 0.002 s: at 0.024 s); 63.4 degrees, 2.24 m/s; leaves
# with (0.75 0 1): of 5/2 the energy, 1.5625/2 is left
one_recorded() {
    local f mass said
    build kinematic "$work/recorder-one" || return
    one_parcel
    sed -i '1i record { patches ("fl.*"); }' constant/interaction
    solve recorder-one serial "$solver" || return
    f="$(folder kinematicCloud)"
    if said="$(awk -F, '
        /^#/ { next }
        $1 == "time" { for (i = 1; i <= NF; i++) at[$i] = i; next }
        function is(name, want,   d) { d = $at[name] - want; if (d < 0) d = -d; if (d > 1e-9) { print name " " $at[name] " by hand " want; bad = 1 } }
        { n++; is("time", 0.024); is("x", 0.0465); is("y", 0.051); is("z", 0); is("v_n", 2); is("v_t", 1); is("d", 1e-4)
          is("T_p", 293.15); is("T_w", 700); is("n_particles", 1e-6/(1000*atan2(0, -1)/6*1e-12)); is("coverage", 0); is("melt_thickness", 0); is("mass", 1e-6); is("e_n", 0.5); is("e_t", 0.75)
          if ($at["patch"] $at["wall"] $at["injector"] $at["outcome"] != "floorfloormodel1rebound") { print $0; bad = 1 } }
        END { exit bad || n != 1 }' "$f/impacts.csv")"
    then ok recorder/one; else bad recorder/one "$said"; fi
    said="$(distributions 0 floor | awk '
        { split($1, key, "/"); printf "%s %.6g-%.6g %s %s %.9g %.9g;", key[2], key[3], $2, $3, $7, 1e6*$10, 1e6*$11 }')"
    f="speed_m_s 1.77828-2.37137 1 0 2.5 0.78125;angle_deg 60-65 1 0 2.5 0.78125;diameter_m 0.0001-0.000133352 1 0 2.5 0.78125;"
    if [ "$said" = "$f" ]; then ok recorder/one/classes; else bad recorder/one/classes "$said"; fi
}

# What arrived between two writes: flux times area and time, all injectors
check_flux() {
    local f said
    f="$(folder kinematicCloud)"
    said="$(awk 'NR > 1 { mass += $5*$4*($1 - $2); stuck += $6*$4*($1 - $2); area = $4 } END { print mass, stuck, area }' "$f/floor.flux.dat")"
    # shellcheck disable=SC2086
    set -- "$1" $said
    if near "$2" "$(last "$f/floor.dat" hit_mass_kg)" 1e-9 && near "$3" "$(last "$f/floor.dat" stick_mass_kg)" 1e-9 && near "$4" 0.01 1e-9
    then ok "$1"; else bad "$1" "mass, stuck mass, area: $said"; fi
}

# At most maxRows, all of them among the whole, as many as chance allows, and in
# speed and outcome like the whole within four standard errors
check_sample() {
    local said
    if [ -n "$(comm -13 <(sort whole.csv) <(grep -v '^#' sampled.csv | sort))" ]; then bad "$1" "rows that the whole has not"; return; fi
    if said="$(awk -F, '
        /^#/ { if (FILENAME == "sampled.csv" && match($0, /1 in [0-9]+/)) share = 0 + substr($0, RSTART + 5, RLENGTH - 5); next }
        $1 == "time" { for (i = 1; i <= NF; i++) at[$i] = i; next }
        { k = FILENAME; n[k]++; v = log($at["v_n"]); s[k] += v; q[k] += v*v; stuck[k] += $at["outcome"] == "stick" }
        function abs(x) { return x < 0 ? -x : x }
        END {
            w = "whole.csv"; k = "sampled.csv"; expected = n[w]/share
            mean = s[w]/n[w]; sd = sqrt(q[w]/n[w] - mean*mean); p = stuck[w]/n[w]
            a = (n[k] - expected)/sqrt(expected); b = (s[k]/n[k] - mean)/(sd/sqrt(n[k])); c = (stuck[k]/n[k] - p)/sqrt(p*(1 - p)/n[k])
            printf "%d rows, 1 in %d of %d; off by %.1f, %.1f, %.1f standard errors\n", n[k], share, n[w], a, b, c
            exit !(n[k] <= 200 && n[k] > 50 && share >= 8 && abs(a) < 4 && abs(b) < 4 && abs(c) < 4)
        }' whole.csv sampled.csv)"
    then ok "$1 ($said)"; else bad "$1" "$said"; fi
}

# The command, built where none is named
nearwall() {
    if [ -n "${NEARWALL_COMMAND:-}" ]; then "$NEARWALL_COMMAND" "$@"; return; fi
    cargo run --release --locked --quiet --manifest-path "$NEARWALL_ROOT/Cargo.toml" --bin nearwall -- "$@"
}

# A wall model with a planted effect, recorded, diagnosed from the log alone with
# the model that lacks it; and silence where nothing is planted
case_closing() {
    closing none    ''
    closing oblique-angle $'\n[[effects]]\nkind = "oblique-angle"\nstrength = 1.2\nspeed_exponent = 0.4' strength=1.2 speed_exponent=0.4
    closing size-dependent-yield $'\n[[effects]]\nkind = "size-dependent-yield"\ndiameter = 3e-4\nexponent = 0.4' diameter=3e-4 exponent=0.4
}

closing() { # effect toml parameter=value...
    local name="closing/$1" effect="$1" toml="$2" said
    shift 2
    build kinematic "$work/closing-$effect" || return
    two_showers 1500 5 fixed
    thornton_ning ""; cp constant/nearWall.toml base.toml
    thornton_ning "$toml"
    solve "$name" serial "$solver" || return
    cp "$(folder kinematicCloud)/impacts.csv" .

    # The command, told what the solver was told, says the same bits
    nearwall predict --model constant/nearWall.toml impacts.csv -o predicted.csv > log.predict 2>&1 \
        || { bad "$name/predict" "nearwall predict failed, see $PWD/log.predict"; return; }
    if said="$(awk -F, '
        /^#/ { next }
        $1 == "time" { for (i = 1; i <= NF; i++) at[$i] = i; next }
        $at["outcome"] == "rebound" {
            n++
            if ($at["e_n"] != $at["e_n_predicted"] || $at["e_t"] != $at["e_t_predicted"] || $at["regime"] != $at["regime_predicted"]) bad++
        }
        END { print n " rebounds, " bad + 0 " differ"; exit bad || !n }' predicted.csv)"
    then ok "$name/predict ($said)"; else bad "$name/predict" "$said"; fi

    nearwall diagnose impacts.csv --model base.toml --out diagnosed > log.diagnose 2>&1 \
        || { bad "$name" "nearwall diagnose failed, see $PWD/log.diagnose"; return; }
    if said="$(diagnosed "$effect" "$@")"; then ok "$name ($said)"; else bad "$name" "$said"; fi
}

# What the command says of its findings: none, or this one with the planted values
# inside its intervals
diagnosed() {   # effect parameter=value...
    if [ "$1" = none ]; then
        grep -v '^nearwall: ' log.diagnose | head -n 1
        grep -q "no deviation from the model is significant" log.diagnose && ! grep -q '^  [a-z]' log.diagnose
        return
    fi
    grep '^  [a-z]' log.diagnose | awk -v planted="$*" '
        { print; n++; sub(/^ */, ""); split($0, part, ": "); cause = part[1]; m = split(part[2], each, ", ") }
        END {
            k = split(planted, want, " ")
            for (i = 2; i <= k; i++) for (j = 1; j <= m; j++) {
                split(want[i], w, "="); gsub(/[()]/, "", each[j]); split(each[j], f, " ")
                if (f[1] == w[1] && f[4] <= w[2] && w[2] <= f[6]) inside++
            }
            exit n != 1 || cause != want[1] || inside != k - 1
        }'
}

# Cases of run: what nearwall itself sends between ranks.
# shellcheck shell=bash disable=SC2154

# folder: messages of all ranks, their bytes, most messages of one rank, collective operations of a rank, bytes of one
counted() {
    cat "$1"/* | awk '{ m += $1; b += $2; if ($1 > most) most = $1; if ($3 > c) c = $3; if ($4 > cb) cb = $4 }
        END { print m, b, most, c, cb }'
}

# ranks model steps: one run of the decomposed case, written at its end only
count_run() {
    local ranks="$1" how="$2" end counts="$PWD/counts-$2-$3"
    rm -rf "$counts" postProcessing processor*/0.*; mkdir "$counts"
    end="$(awk -v n="$3" 'BEGIN { print 0.002*n }')"
    settings "$end" "$end"
    solve "messages/$ranks" "$how-$3" mpirun -np "$ranks" env LD_PRELOAD="$work/libcountMessages.so" \
        COUNT_MESSAGES="$counts" "$solver" -parallel || return
    [ "$(find "$counts" -type f | wc -l)" = "$ranks" ] || { bad "messages/$ranks" "not all ranks have counted"; return 1; }
}

# model: all reflect without loss, so the parcels move alike with each. OpenFOAM's rebound keeps no statistics.
reflecting() {
    cp cloud.base constant/kinematicCloudProperties
    case "$1" in
        rebound) echo 'subModels { patchInteractionModel rebound; reboundCoeffs { UFactor 1; } }' ;;
        local)   echo 'subModels { patchInteractionModel localInteraction; localInteractionCoeffs { patches
                    ( floor { type rebound; } lid { type rebound; } sides { type rebound; } outlet { type rebound; } ); } }' ;;
        near)    ;;
        memory)  echo 'subModels { nearWallInteractionCoeffs { memory { } } }' ;;
    esac >> constant/kinematicCloudProperties
}

# ranks parcels: a line for each model with its counts of one step (that of 30 steps less that of 10, over 20) less those
# of rebound: model messages bytes most-of-a-rank collective bytes
own_messages() {
    local ranks="$1" how
    bouncing_box "$work/messages-$1-$2" "$2" || return
    sed -i '/^cloudFunctions/d' constant/kinematicCloudProperties
    cp constant/kinematicCloudProperties cloud.base
    sed -i '/^\[\[effects/,$d; s/^e_n = .*/e_n = 1/; s/^e_t = .*/e_t = 1/' constant/nearWall.toml
    printf 'model "<constant>/nearWall.toml";\npatches { ".*" { type interact; wall default; } }\n' > constant/interaction
    ranks_are "$ranks"
    quiet decompose decomposePar || { bad "messages/$ranks" "decomposePar failed"; return 1; }
    for how in rebound local near memory; do
        reflecting "$how"
        count_run "$ranks" "$how" 10 && count_run "$ranks" "$how" 30 || return
        echo "$how $(counted "counts-$how-10") $(counted "counts-$how-30")"
    done | awk '
        { for (i = 2; i <= 6; i++) step[i] = ($(i + 5) - $i)/20 }
        $1 == "rebound" { for (i = 2; i <= 6; i++) base[i] = step[i]; next }
        { printf "%s", $1; for (i = 2; i <= 6; i++) printf " %.5g", step[i] - base[i]; print "" }' > own
}

# A sum over n ranks, to the first and back, is 2(n - 1) messages along a tree. Beside rebound, nearwall needs one more, memory
# another two and a maximum, which goes only to the first: whatever the number of parcels, and no collective operation more.
# Since v2206 the way back is a broadcast of the MPI library.
case_messages() {
    local n how messages bytes most collective expected broadcasts=no
    case "${WM_PROJECT_VERSION:-}" in v*) [ "${WM_PROJECT_VERSION#v}" -lt 2206 ] || broadcasts=yes ;; esac
    mpicc -O1 -shared -fPIC -o "$work/libcountMessages.so" "$here/countMessages.c" > "$work/log.mpicc" 2>&1 \
        || { bad messages "mpicc cannot compile countMessages.c: $(head -n 3 "$work/log.mpicc" | tr '\n' ' ')"; \
            return; }
    for n in 2 4 8; do
        own_messages "$n" 600 || return
        while read -r how messages bytes most collective _; do
            case "$how" in
                local)  expected="" ;;
                near)   expected=$((2*(n - 1))) ;;
                memory) expected=$((7*(n - 1))) ;;
            esac
            if [ -z "$expected" ] || awk -v m="$messages" -v e="$expected" -v c="$collective" -v b="$broadcasts" \
                    'BEGIN { exit !(b == "no" && m == e && c < 0.5 || b == "yes" && m <= e && c < 8) }'
            then ok "messages/$n/$how (a step: $messages with $bytes bytes, at most $most from a rank; $collective collective operations)"
            else bad "messages/$n/$how" "a step: $messages messages with $bytes bytes and $collective collective operations, expected $expected and none"; fi
        done < own
        cp own "$work/own-$n"
    done
    own_messages 4 60 || return
    if awk 'NR == FNR { m[$1] = $2; b[$1] = $3; next } $2 != m[$1] || $3 > 1.05*b[$1] || $3 < 0.95*b[$1] { bad = 1 } END { exit bad }' "$work/own-4" own
    then ok "messages/parcels (as many with a tenth of the parcels)"
    else bad messages/parcels "$(tr '\n' ';' < own) and $(tr '\n' ';' < "$work/own-4")"
    fi
}

# Prints the deposits: measured, of the base simulation, as the replay predicts them, and of the run with the extended model; writes
# the same to `table`.
#
#   awk -v runs=run -v table=run/against.csv -f against.awk

function read_deposits(file, into,    line, cell, n, i) {
    while ((getline line < file) > 0) {
        n = split(line, cell, ",")
        for (i = 2; i <= n; i += 2) into[cell[1], i/2] = cell[i]
    }
}

# The text after "key": in a line of diagnosis.json
function value(line) { sub(/^[^:]*: */, "", line); sub(/,$/, "", line); gsub(/"/, "", line); return line }

BEGIN {
    getline line < (runs "/MEASURED.csv"); n = split(line, head, ",")
    for (i = 5; i <= n; i += 2) column[++columns] = head[i]
    while ((getline line < (runs "/MEASURED.csv")) > 0) {
        n = split(line, cell, ","); name[++rows] = cell[1]
        for (i = 5; i <= n; i += 2) { measured[cell[1], (i - 3)/2] = cell[i]; particles[cell[1]] = cell[i + 1] }
    }
    read_deposits(runs "/deposits-base.csv", base)
    read_deposits(runs "/deposits-after.csv", after)
    while ((getline line < (runs "/diagnosis/diagnosis.json")) > 0) {
        if (line ~ /^  "readings": \[/) on = 1; else if (line ~ /^  \]/) on = 0
        if (!on) continue
        if (line ~ /^      "experiment":/) own = value(line)
        if (line ~ /^      "observable":/) observable = value(line)
        if (line ~ /^      "extended":/) replay[own, observable] = value(line)
    }
    print "                                        share of the injected mass [%]"
    print "experiment  deposit                   measured    base   replay   rerun"
    print "experiment,deposit,measured,base,replay,rerun" > table
    for (r = 1; r <= rows; r++) for (c = 1; c <= columns; c++) {
        m = measured[name[r], c]; b = base[name[r], c]; p = replay[name[r], column[c]]; a = after[name[r], c]
        short = column[c]; sub(/captured_from_/, "", short); sub(/captured@/, "", short); sub(/_to_/, "-", short)
        sub(/@plate/, " m, plate", short)
        printf "%-10s  %-24s  %8.1f %7.1f %8.1f %7.1f\n", name[r], short, 100*m, 100*b, 100*p, 100*a
        print name[r] "," column[c] "," m "," b "," p "," a > table
        count++; before2 += (b - m)^2; replay2 += (p - m)^2; after2 += (a - m)^2
    }
    before = sqrt(before2/count); now = sqrt(after2/count)
    printf "%-36s  %8s %7.2f %8.2f %7.2f\n", "rms error", "", 100*before, 100*sqrt(replay2/count), 100*now
    printf "gain: the rms error of the rerun is %.0f %% of that of the base\n", 100*now/before
    print "rms_error,,," before "," sqrt(replay2/count) "," now > table
    while ((getline line < (runs "/deposits-draws.csv")) > 0) {
        n = split(line, cell, ","); sum = 0
        for (i = 2; i <= n; i += 2) sum += cell[i]
        draws++; caught += sum; square += sum^2
    }
    if (draws > 1) {
        for (c = 1; c <= columns; c++) { was += base["T345", c]; sum_measured += measured["T345", c] }
        # 95 % for another measurement: Student's t of the reruns, which have their own sampling error, with that of counting
        split("12.706 4.303 3.182 2.776 2.571 2.447 2.365 2.306 2.262", t, " ")
        mean = caught/draws; variance = (square - draws*mean^2)/(draws - 1)
        counting = mean*(1 - mean)/particles["T345"]
        half = (draws <= 10 ? t[draws - 1] : 2)*sqrt((variance > 0 ? variance : 0)*(1 + 1/draws) + counting)
        low = mean - half; high = mean + half
        printf "T345 rerun with %d of the drawn model files: 95 %% band of the mass caught %.1f to %.1f %% (measured %.1f, base %.1f)\n", \
            draws, 100*low, 100*high, 100*sum_measured, 100*was
    }
}

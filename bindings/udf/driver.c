/* What a solver would do around wall.c: hands over the particles of a table one by one, each on its way to a wall.
 *
 *     NEARWALL_MODEL=nearWall.toml ./driver impacts.csv
 *
 * Prints the velocity away from the wall and along it, and 1 where the path ended in the wall. */
#include "stand_in.h"

#include <stdio.h>

int main(int argc, char **argv) {
    const real normal[3] = {0, 0, 1};
    char header[256];
    real v_n, v_t, d, T_p, T_w;
    long id = 0;
    FILE *table = argc == 2 ? fopen(argv[1], "r") : NULL;

    if (!table || !fgets(header, sizeof header, table)) return 2;
    nearwall_load("driver");
    while (fscanf(table, "%lf,%lf,%lf,%lf,%lf", &v_n, &v_t, &d, &T_p, &T_w) == 5) {
        Tracked_Particle particle = {0, {0, 0, 0}, {0, 0, 0}, 0, 0, {0}};
        Thread wall;
        int state;
        particle.id = id++;
        particle.velocity[0] = v_t;
        particle.velocity[2] = v_n;
        particle.diameter = d;
        particle.temperature = T_p;
        wall.temperature = &T_w;
        state = nearwall_wall(&particle, &wall, 0, normal, 3);
        if (state == PATH_ABORT) return 1;
        printf("%.17g %.17g %d\n", -particle.velocity[2], particle.velocity[0], state == PATH_END);
    }
    fclose(table);
    return 0;
}

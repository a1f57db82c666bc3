/* NOT a vendor's header. A stand-in of nearwall's own, so that wall.c compiles and is tested without a commercial solver:
 * it declares the few names that wall.c uses, in the manner of a solver's manual for user-defined functions. With the solver,
 * its own header takes this file's place. Nothing here was compared with one; layouts are not those of any product. */
#ifndef STAND_IN_H
#define STAND_IN_H

typedef double real;
typedef int face_t;

/* A wall: here nothing but its temperature [K] on every face. */
typedef struct {
    const real *temperature;
} Thread;

/* A particle in flight: here what wall.c asks for. */
typedef struct {
    long id;
    real velocity[3];        /* now [m/s] */
    real velocity_before[3]; /* where the next step begins [m/s] */
    real diameter;           /* [m] */
    real temperature;        /* [K] */
    real user[1];            /* the user's own numbers, 0 at the start */
} Tracked_Particle;

#define TP_ID(tp) ((tp)->id)
#define TP_VEL(tp) ((tp)->velocity)
#define TP_VEL0(tp) ((tp)->velocity_before)
#define TP_DIAM(tp) ((tp)->diameter)
#define TP_T(tp) ((tp)->temperature)
#define TP_USER_REAL(tp, i) ((tp)->user[i])
#define F_T(f, t) ((t)->temperature[f])

enum { PATH_ABORT, PATH_ACTIVE, PATH_END };

#define DEFINE_DPM_BC(name, tp, t, f, f_normal, dim) \
    int name(Tracked_Particle *tp, Thread *t, face_t f, const real f_normal[], int dim)
#define DEFINE_EXECUTE_ON_LOADING(name, libname) void name(const char *libname)

DEFINE_DPM_BC(nearwall_wall, tp, t, f, f_normal, dim);
DEFINE_EXECUTE_ON_LOADING(nearwall_load, libname);

#endif

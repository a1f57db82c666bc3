/*
 * countMessages - count what a program sends through MPI.
 *
 *     mpicc -shared -fPIC -o libcountMessages.so countMessages.c
 *     mpirun -np 4 env LD_PRELOAD=./libcountMessages.so COUNT_MESSAGES=folder program
 *
 * Stands before the MPI library through its profiling interface. Each rank writes folder/<rank> at the end:
 * messages sent to one rank, their bytes, collective operations, bytes that it contributes to them.
 *
 * Part of nearwall. Copyright (C) the nearwall authors. GPL-3.0-or-later.
 */
#include <mpi.h>
#include <stdio.h>
#include <stdlib.h>

static long long messages, bytes, collectives, collective_bytes;

static long long size_of(int count, MPI_Datatype type)
{
    int size = 0;
    PMPI_Type_size(type, &size);
    return (long long)count * size;
}

static void sent(int count, MPI_Datatype type)
{
    ++messages;
    bytes += size_of(count, type);
}

static void joined(int count, MPI_Datatype type)
{
    ++collectives;
    collective_bytes += size_of(count, type);
}

int MPI_Send(const void *b, int n, MPI_Datatype t, int to, int tag, MPI_Comm c)
{
    sent(n, t);
    return PMPI_Send(b, n, t, to, tag, c);
}

int MPI_Bsend(const void *b, int n, MPI_Datatype t, int to, int tag, MPI_Comm c)
{
    sent(n, t);
    return PMPI_Bsend(b, n, t, to, tag, c);
}

int MPI_Ssend(const void *b, int n, MPI_Datatype t, int to, int tag, MPI_Comm c)
{
    sent(n, t);
    return PMPI_Ssend(b, n, t, to, tag, c);
}

int MPI_Isend(const void *b, int n, MPI_Datatype t, int to, int tag, MPI_Comm c, MPI_Request *r)
{
    sent(n, t);
    return PMPI_Isend(b, n, t, to, tag, c, r);
}

int MPI_Allreduce(const void *b, void *r, int n, MPI_Datatype t, MPI_Op o, MPI_Comm c)
{
    joined(n, t);
    return PMPI_Allreduce(b, r, n, t, o, c);
}

int MPI_Iallreduce(const void *b, void *r, int n, MPI_Datatype t, MPI_Op o, MPI_Comm c, MPI_Request *q)
{
    joined(n, t);
    return PMPI_Iallreduce(b, r, n, t, o, c, q);
}

int MPI_Reduce(const void *b, void *r, int n, MPI_Datatype t, MPI_Op o, int root, MPI_Comm c)
{
    joined(n, t);
    return PMPI_Reduce(b, r, n, t, o, root, c);
}

int MPI_Bcast(void *b, int n, MPI_Datatype t, int root, MPI_Comm c)
{
    joined(n, t);
    return PMPI_Bcast(b, n, t, root, c);
}

int MPI_Alltoall(const void *b, int n, MPI_Datatype t, void *r, int m, MPI_Datatype u, MPI_Comm c)
{
    int ranks;
    PMPI_Comm_size(c, &ranks);
    joined(n * ranks, t);
    return PMPI_Alltoall(b, n, t, r, m, u, c);
}

int MPI_Alltoallv(const void *b, const int n[], const int d[], MPI_Datatype t, void *r, const int m[], const int e[],
                  MPI_Datatype u, MPI_Comm c)
{
    int ranks, all = 0;
    PMPI_Comm_size(c, &ranks);
    for (int i = 0; i < ranks; ++i) all += n[i];
    joined(all, t);
    return PMPI_Alltoallv(b, n, d, t, r, m, e, u, c);
}

int MPI_Scatterv(const void *b, const int n[], const int d[], MPI_Datatype t, void *r, int m, MPI_Datatype u, int root,
                 MPI_Comm c)
{
    joined(m, u);
    return PMPI_Scatterv(b, n, d, t, r, m, u, root, c);
}

int MPI_Gather(const void *b, int n, MPI_Datatype t, void *r, int m, MPI_Datatype u, int root, MPI_Comm c)
{
    joined(n, t);
    return PMPI_Gather(b, n, t, r, m, u, root, c);
}

int MPI_Gatherv(const void *b, int n, MPI_Datatype t, void *r, const int m[], const int d[], MPI_Datatype u, int root,
                MPI_Comm c)
{
    joined(n, t);
    return PMPI_Gatherv(b, n, t, r, m, d, u, root, c);
}

int MPI_Allgather(const void *b, int n, MPI_Datatype t, void *r, int m, MPI_Datatype u, MPI_Comm c)
{
    joined(n, t);
    return PMPI_Allgather(b, n, t, r, m, u, c);
}

int MPI_Barrier(MPI_Comm c)
{
    ++collectives;
    return PMPI_Barrier(c);
}

int MPI_Finalize(void)
{
    const char *folder = getenv("COUNT_MESSAGES");
    int rank;
    PMPI_Comm_rank(MPI_COMM_WORLD, &rank);
    if (folder) {
        char name[4096];
        snprintf(name, sizeof name, "%s/%d", folder, rank);
        FILE *file = fopen(name, "w");
        if (file) {
            fprintf(file, "%lld %lld %lld %lld\n", messages, bytes, collectives, collective_bytes);
            fclose(file);
        }
    }
    return PMPI_Finalize();
}

# Writes the mesh of the duct in Gmsh's format 2: hexahedra, and named by numbers on the boundary
#   1 inlet   2 injector, one face of the inlet   3 outlet   4 bottom wall   5 top wall   6 sides
# Usage: awk -f duct.awk > duct.msh
function node(i, j, k) { return 1 + i + (nx + 1)*(j + (ny + 1)*k) }
function quad(tag, a, b, c, d) { face[++faces] = "3 2 " tag " " tag " " a " " b " " c " " d }
BEGIN {
    nx = 24; ny = 5; nz = 8                     # cells
    lx = 0.24; ly = 0.05; lz = 0.04             # m
    for (i = 0; i < nx; i++) for (j = 0; j < ny; j++) {
        quad(4, node(i, j, 0), node(i, j + 1, 0), node(i + 1, j + 1, 0), node(i + 1, j, 0))
        quad(5, node(i, j, nz), node(i + 1, j, nz), node(i + 1, j + 1, nz), node(i, j + 1, nz))
    }
    for (j = 0; j < ny; j++) for (k = 0; k < nz; k++) {
        injector = j == int(ny/2) && k == nz/2
        quad(injector ? 2 : 1, node(0, j, k), node(0, j, k + 1), node(0, j + 1, k + 1), node(0, j + 1, k))
        quad(3, node(nx, j, k), node(nx, j + 1, k), node(nx, j + 1, k + 1), node(nx, j, k + 1))
    }
    for (i = 0; i < nx; i++) for (k = 0; k < nz; k++) {
        quad(6, node(i, 0, k), node(i + 1, 0, k), node(i + 1, 0, k + 1), node(i, 0, k + 1))
        quad(6, node(i, ny, k), node(i, ny, k + 1), node(i + 1, ny, k + 1), node(i + 1, ny, k))
    }
    print "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" (nx + 1)*(ny + 1)*(nz + 1)
    for (k = 0; k <= nz; k++) for (j = 0; j <= ny; j++) for (i = 0; i <= nx; i++)
        printf "%d %.17g %.17g %.17g\n", node(i, j, k), lx*i/nx, ly*j/ny, lz*k/nz
    print "$EndNodes\n$Elements\n" faces + nx*ny*nz
    for (n = 1; n <= faces; n++) print n, face[n]
    for (k = 0; k < nz; k++) for (j = 0; j < ny; j++) for (i = 0; i < nx; i++)
        print n++, "5 2 7 7", node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k), node(i, j + 1, k), \
            node(i, j, k + 1), node(i + 1, j, k + 1), node(i + 1, j + 1, k + 1), node(i, j + 1, k + 1)
    print "$EndElements"
}

// One iteration of the local flow, one work-item per patch: Householder QR of [mu L; I] with three
// right-hand sides (docs/study/fairing.md, "The QR").
//
// REAL   float or double: positions and arithmetic
// LEAST_HEIGHT   of faces that have an area
// SLOTS  a multiple of 8: patches of up to SLOTS - 1 vertices, in private memory;
//        0: of any size, in `workspace`, whose slots are an argument
//
// Eliminating column j touches the rows j.. of mu L and 0..j of I, n + 1 in all: row j + 1 of I
// takes the slot of row j of mu L, which is done with. The centre is the last column, so that its
// value needs no back substitution. A column is a run of real8, its unused slots 0.

#ifdef cl_khr_fp64
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
#endif

#define JOIN(a, b) a##b
#define VECTOR(type, width) JOIN(type, width)
typedef VECTOR(REAL, 3) real3;
typedef VECTOR(REAL, 4) real4;
typedef VECTOR(REAL, 8) real8;

#if SLOTS
#define SPACE __private
#define VECTORS (SLOTS / 8)
#else
#define SPACE __global
#define VECTORS vectors
#endif

static real3 position(__global const real4* positions, int i) { return positions[i].xyz; }

static REAL sum(real8 v) {
  const real4 half_sum = v.lo + v.hi;
  return half_sum.x + half_sum.y + (half_sum.z + half_sum.w);
}

static REAL largest(real8 v) {
  const real4 of_halves = fmax(v.lo, v.hi);
  return fmax(fmax(of_halves.x, of_halves.y), fmax(of_halves.z, of_halves.w));
}

// 1 in the lane of this slot within its real8, else 0.
static real8 lane_of(int slot) {
  const real8 lanes = (real8)(0, 1, 2, 3, 4, 5, 6, 7);
  return fmax((real8)(0), 1 - fabs(lanes - (REAL)(slot % 8)));
}

static void add_edge(SPACE REAL* matrix, int slots, int i, int j, REAL weight) {
  matrix[j * slots + i] += weight;
  matrix[i * slots + j] += weight;
  matrix[i * slots + i] -= weight;
  matrix[j * slots + j] -= weight;
}

// Adds mu L of the patch's faces, the centre last.
static void add_laplacian(SPACE REAL* matrix, int slots, int n, __global const real4* now,
                          __global const int* vertices, __global const int* triangles,
                          int triangle_count, REAL half_smoothing) {
  for (int t = 0; t < triangle_count; ++t) {
    const int3 corner = vload3(t, triangles);
    const real3 base = position(now, vertices[corner.x]);
    const real3 first = position(now, vertices[corner.y]) - base;
    const real3 second = position(now, vertices[corner.z]) - base;
    const real3 edge = second - first;
    const real3 normal = cross(first, second);
    const REAL square = dot(normal, normal);
    const real3 at = (real3)(dot(first, second), -dot(first, edge), dot(second, edge));
    const REAL longest = fmax(fmax(at.x + at.y, at.x + at.z), at.y + at.z);
    if (!(square > (REAL)(LEAST_HEIGHT * LEAST_HEIGHT) * longest)) continue;
    const REAL scale = half_smoothing / sqrt(square);
    const int a = corner.x == 0 ? n - 1 : corner.x - 1;
    const int b = corner.y == 0 ? n - 1 : corner.y - 1;
    const int c = corner.z == 0 ? n - 1 : corner.z - 1;
    add_edge(matrix, slots, b, c, scale * at.x);
    add_edge(matrix, slots, c, a, scale * at.y);
    add_edge(matrix, slots, a, b, scale * at.z);
  }
}

// Patch i has the vertices vertices[vertex_start[i]].., the centre first, and the triangles
// triangle_start[i].., whose corners are indices into its vertices.
__kernel void patch_qr(__global const real4* now, __global real4* next,
                       __global const int* vertex_start, __global const int* vertices,
                       __global const int* triangle_start, __global const int* triangles,
                       const int patches, const REAL smoothing
#if !SLOTS
                       ,
                       __global real8* workspace, const int vectors
#endif
) {
  const int patch = get_global_id(0);
  if (patch >= patches) return;
  const int n = vertex_start[patch + 1] - vertex_start[patch];
  vertices += vertex_start[patch];
  triangles += 3 * triangle_start[patch];
  const int triangle_count = triangle_start[patch + 1] - triangle_start[patch];
  const real3 centre = position(now, vertices[0]);
#if SLOTS
  real8 system[VECTORS * (SLOTS + 2)];
#else
  __global real8* system = workspace + (size_t)patch * vectors * (8 * vectors + 2);
#endif

  for (int i = 0; i < VECTORS * (n + 3); ++i) system[i] = 0;
  SPACE REAL* const matrix = (SPACE REAL*)system;
  const int slots = 8 * VECTORS;
  add_laplacian(matrix, slots, n, now, vertices, triangles, triangle_count, smoothing / 2);
  const real3 first = position(now, vertices[n == 1 ? 0 : 1]) - centre;
  matrix[n] = 1;
  matrix[n * slots + n] = first.x;
  matrix[(n + 1) * slots + n] = first.y;
  matrix[(n + 2) * slots + n] = first.z;

  REAL diagonal = 1;
  for (int j = 0; j < n; ++j) {
    SPACE real8* const reflector = system + j * VECTORS;
    const real8 lane = lane_of(j);
    const int row = j / 8;
    real8 sizes = 0;
    for (int r = 0; r < VECTORS; ++r) sizes = fmax(sizes, fabs(reflector[r]));
    const REAL size = largest(sizes);
    const REAL inverse_size = 1 / size;
    real8 squares = 0;
    for (int r = 0; r < VECTORS; ++r) {
      reflector[r] *= inverse_size;
      squares += reflector[r] * reflector[r];
    }
    const REAL norm = sqrt(sum(squares));
    const REAL pivot = sum(lane * reflector[row]);
    const REAL signed_norm = pivot > 0 ? -norm : norm;
    diagonal = size * signed_norm;
    reflector[row] -= lane * signed_norm;
    // H = I - factor v v^T
    const REAL factor = 1 / (norm * (norm + fabs(pivot)));

    const int following = j + 2 >= n ? 0 : j + 2;  // the vertex whose row of I enters
    const real3 entering = position(now, vertices[following]) - centre;
    const bool last = j + 1 == n;
    for (int k = j + 1; k < n + 3; ++k) {
      SPACE real8* const column = system + k * VECTORS;
      real8 products = 0;
      for (int r = 0; r < VECTORS; ++r) products += reflector[r] * column[r];
      const REAL product = factor * sum(products);
      for (int r = 0; r < VECTORS; ++r) column[r] -= product * reflector[r];
      if (last) continue;
      const REAL value = k == j + 1   ? 1
                         : k < n      ? 0
                         : k == n     ? entering.x
                         : k == n + 1 ? entering.y
                                      : entering.z;
      column[row] = column[row] * (1 - lane) + value * lane;
    }
  }
  const int end = n - 1;
  const real3 moved = centre + (real3)(matrix[n * slots + end], matrix[(n + 1) * slots + end],
                                       matrix[(n + 2) * slots + end]) /
                                   diagonal;
  next[vertices[0]] = (real4)(moved, 0);
}

// Puts values that were computed elsewhere in their places: next[vertices[i]] = values[i].
__kernel void place(__global real4* next, __global const int* vertices,
                    __global const real4* values, const int count) {
  const int i = get_global_id(0);
  if (i < count) next[vertices[i]] = values[i];
}

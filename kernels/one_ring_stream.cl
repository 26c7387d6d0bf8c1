// One iteration of the local flow, one work-item per vertex, any valence: the patch's system in
// closed form (docs/method.md, "Local flow"), eliminated from the ring's first vertex to its last.
// Nothing but the running sums is kept.
//
// REAL          float or double: the precision of the arithmetic
// STORED        float or double: the precision of the positions
// LEAST_HEIGHT  of faces that have an area

#ifdef cl_khr_fp64
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
#endif

#define JOIN(a, b) a##b
#define VECTOR(type, width) JOIN(type, width)
typedef VECTOR(REAL, 2) complex;  // (real, imaginary)
typedef VECTOR(REAL, 3) real3;
typedef VECTOR(STORED, 4) stored4;

typedef struct {
  real3 re, im;
} complex3;

static complex times(complex a, complex b) {
  return (complex)(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x);
}
static complex times_i(complex a) { return (complex)(-a.y, a.x); }
static complex inverse(complex a) { return (complex)(a.x, -a.y) / dot(a, a); }
static complex3 add_times(complex3 sum, complex a, complex3 b) {
  sum.re += a.x * b.re - a.y * b.im;
  sum.im += a.x * b.im + a.y * b.re;
  return sum;
}

// Half the smoothing times the cotangents of the face (centre, first, second) at its corners, in
// that order; 0 for a face that is no higher than LEAST_HEIGHT over its longest side.
static real3 corners(real3 first, real3 second, REAL half_smoothing) {
  const real3 edge = second - first;
  const real3 normal = cross(first, second);
  const REAL square = dot(normal, normal);
  const real3 at = (real3)(dot(first, second), -dot(first, edge), dot(second, edge));
  const REAL longest = fmax(fmax(at.x + at.y, at.x + at.z), at.y + at.z);
  const bool has_area = square > (REAL)(LEAST_HEIGHT * LEAST_HEIGHT) * longest;
  return (has_area ? half_smoothing / sqrt(square) : 0) * at;
}

static real3 position(__global const stored4* positions, int i) {
  const stored4 p = positions[i];
  return (real3)(p.x, p.y, p.z);
}

// Vertex `first_vertex` + i has the neighbours ring[start[i]] .. ring[start[i + 1] - 1], in order
// round it; none = held.
__kernel void one_ring_stream(__global const stored4* now, __global stored4* next,
                              __global const int* start, __global const int* ring,
                              const int first_vertex, const int vertices, const STORED smoothing) {
  const int item = get_global_id(0);
  if (item >= vertices || start[item] == start[item + 1]) return;
  const int vertex = first_vertex + item;
  const REAL half_smoothing = (REAL)smoothing / 2;
  const real3 centre = position(now, vertex);
  const int begin = start[item];
  const int last = start[item + 1] - 1;

  real3 here = position(now, ring[begin]) - centre;
  const real3 end = position(now, ring[last]) - centre;
  const real3 closing = corners(end, here, half_smoothing);
  real3 before = closing;
  complex to_last = (complex)(0, -closing.x);  // the entry that couples this row to the last one
  complex carry = 0;                           // i x the multiplier of the row before
  complex right = 0;                           // the couplings to the centre, eliminated
  complex3 value = {0, 0};                     // the positions, eliminated
  complex right_right = 0, last_right = 0, last_last = 0;  // sums of products over the pivots
  complex3 right_value = {0, 0}, last_value = {0, 0};
  REAL coupling_sum = 0;
  for (int i = begin; i < last; ++i) {
    const real3 following = i + 1 == last ? end : position(now, ring[i + 1]) - centre;
    const real3 after = corners(here, following, half_smoothing);
    const REAL coupling = after.z + before.y;  // to the centre
    coupling_sum += coupling;
    const complex pivot =
        (complex)(1, after.x + before.x + coupling) - before.x * times_i(carry);
    const complex reciprocal = inverse(pivot);
    right = times(carry, right) + (complex)(coupling, 0);
    const complex3 plain = {here, 0};
    value = add_times(plain, carry, value);
    if (i > begin) to_last = times(carry, to_last);
    if (i + 1 == last) to_last.y -= after.x;

    const complex scaled_right = times(reciprocal, right);
    const complex scaled_last = times(reciprocal, to_last);
    right_right += times(scaled_right, right);
    last_right += times(scaled_last, right);
    last_last += times(scaled_last, to_last);
    right_value = add_times(right_value, scaled_right, value);
    last_value = add_times(last_value, scaled_last, value);
    carry = times_i(after.x * reciprocal);
    before = after;
    here = following;
  }
  const REAL coupling = closing.z + before.y;
  coupling_sum += coupling;
  const complex pivot = (complex)(1, closing.x + before.x + coupling) - last_last;
  right = (complex)(coupling, 0) - last_right;
  const complex scaled_right = times(inverse(pivot), right);
  right_right += times(scaled_right, right);
  value.re = end - last_value.re;
  value.im = -last_value.im;
  right_value = add_times(right_value, scaled_right, value);

  const complex weight = times_i(inverse((complex)(1, coupling_sum) + right_right));
  const real3 moved = centre + weight.x * right_value.re - weight.y * right_value.im;
  next[vertex] = (stored4)(moved.x, moved.y, moved.z, 0);
}

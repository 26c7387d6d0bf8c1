// Conjugate gradients for three right-hand sides at once, and Chebyshev's iteration to precondition
// it. Vectors hold a double4 per row, the last component 0; matrices are symmetric, in compressed
// rows. One work-item per row, except in `dots`. docs/study/solvers.md.

#pragma OPENCL EXTENSION cl_khr_fp64 : enable

static double4 row_times(__global const int* start, __global const int* column,
                         __global const double* value, const int row, __global const double4* x) {
  double4 sum = 0;
  for (int e = start[row]; e < start[row + 1]; ++e) sum += value[e] * x[column[e]];
  return sum;
}

// y = H x.
__kernel void product(__global const int* start, __global const int* column,
                      __global const double* value, __global const double4* x, __global double4* y,
                      const int rows) {
  const int row = get_global_id(0);
  if (row < rows) y[row] = row_times(start, column, value, row, x);
}

// Item k of `count` sums the rows k, k + count, ...: the same bytes on every device.
__kernel void dots(__global const double4* a, __global const double4* b, __global double4* sums,
                   const int rows) {
  const int count = get_global_size(0);
  double4 sum = 0;
  for (int row = get_global_id(0); row < rows; row += count) sum += a[row] * b[row];
  sums[get_global_id(0)] = sum;
}

// x += length p; r -= length H p.
__kernel void advance(__global double4* x, __global double4* r, __global const double4* p,
                      __global const double4* h_p, const double4 length, const int rows) {
  const int row = get_global_id(0);
  if (row >= rows) return;
  x[row] += length * p[row];
  r[row] -= length * h_p[row];
}

// p = z + keep p.
__kernel void turn(__global double4* p, __global const double4* z, const double4 keep,
                   const int rows) {
  const int row = get_global_id(0);
  if (row < rows) p[row] = z[row] + keep * p[row];
}

// The first step of Chebyshev's iteration for M z = r from z = 0; `reciprocal` holds 1 / M(i, i).
__kernel void first_step(__global const double4* r, __global double4* z, __global double4* step,
                         __global const double* reciprocal, const double add, const int rows) {
  const int row = get_global_id(0);
  if (row < rows) z[row] = step[row] = add * reciprocal[row] * r[row];
}

// Any further one: step = keep step + add D^-1 (r - M z), next = z + step.
__kernel void next_step(__global const int* start, __global const int* column,
                        __global const double* value, __global const double4* r,
                        __global const double4* z, __global double4* next, __global double4* step,
                        __global const double* reciprocal, const double keep, const double add,
                        const int rows) {
  const int row = get_global_id(0);
  if (row >= rows) return;
  const double4 rest = r[row] - row_times(start, column, value, row, z);
  step[row] = keep * step[row] + add * reciprocal[row] * rest;
  next[row] = z[row] + step[row];
}

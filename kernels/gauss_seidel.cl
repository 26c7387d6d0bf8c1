// One colour of a Gauss-Seidel sweep over H X = R with three right-hand sides: no two rows of a
// colour share an entry, so all of them can be relaxed at once. One work-item per row.

#pragma OPENCL EXTENSION cl_khr_fp64 : enable

// Row k of the colour is row[first + k] of H; its entries off the diagonal are
// column[start[first + k]] .. and value[...]; reciprocal holds 1 / H(i, i).
__kernel void gauss_seidel(__global double* x, __global const double* r, __global const int* row,
                           __global const int* start, __global const int* column,
                           __global const double* value, __global const double* reciprocal,
                           const int first, const int count) {
  if (get_global_id(0) >= count) return;
  const int k = first + (int)get_global_id(0);
  const int i = row[k];
  double3 rest = vload3(i, r);
  for (int e = start[k]; e < start[k + 1]; ++e) rest -= value[e] * vload3(column[e], x);
  vstore3(reciprocal[k] * rest, i, x);
}

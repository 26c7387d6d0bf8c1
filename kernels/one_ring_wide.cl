// One iteration of the local flow for processors with vector registers: a work-item moves the 16
// vertices of one slice, a vertex to a lane. The patch's system as in docs/method.md, "Local flow",
// times -i: (Laplacian + i) w = couplings to the centre. It is eliminated from the ring's first
// vertex to its last, which the second pass goes back; all sums are of what is left of the rows, so
// that large weights cancel nowhere.
//
// LARGEST_RING     the longest ring of a slice
// SLICES_PER_ITEM  taken in turn by a work-item
// LEAST_HEIGHT     of faces that have an area

typedef struct {
  float16 re, im;
} complex;
typedef struct {
  float16 x, y, z;
} vectors;
typedef struct {
  float16 centre, first, second;
} corners;

// The parts of a row that the second pass needs: its position, and w = right + following times the
// next row's w + last times the last row's w.
typedef struct {
  vectors position;
  complex right, following, last;
} row;

static complex times(complex a, complex b) {
  const complex product = {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
  return product;
}
static complex add_times(complex sum, complex a, complex b) {
  sum.re = sum.re + a.re * b.re - a.im * b.im;
  sum.im = sum.im + a.re * b.im + a.im * b.re;
  return sum;
}
static float16 dots(vectors a, vectors b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static vectors minus(vectors a, vectors b) {
  const vectors difference = {a.x - b.x, a.y - b.y, a.z - b.z};
  return difference;
}

// The halves of a and b, alternating, within each quarter of the registers: elements of 4 bytes and
// of 8.
static float16 low(float16 a, float16 b) {
  return (float16)(a.s0, b.s0, a.s1, b.s1, a.s4, b.s4, a.s5, b.s5, a.s8, b.s8, a.s9, b.s9, a.sc,
                   b.sc, a.sd, b.sd);
}
static float16 high(float16 a, float16 b) {
  return (float16)(a.s2, b.s2, a.s3, b.s3, a.s6, b.s6, a.s7, b.s7, a.sa, b.sa, a.sb, b.sb, a.se,
                   b.se, a.sf, b.sf);
}
static float16 low_pairs(float16 a, float16 b) {
  return (float16)(a.s0, a.s1, b.s0, b.s1, a.s4, a.s5, b.s4, b.s5, a.s8, a.s9, b.s8, b.s9, a.sc,
                   a.sd, b.sc, b.sd);
}
static float16 high_pairs(float16 a, float16 b) {
  return (float16)(a.s2, a.s3, b.s2, b.s3, a.s6, a.s7, b.s6, b.s7, a.sa, a.sb, b.sa, b.sb, a.se,
                   a.sf, b.se, b.sf);
}

// Positions 4 q .. 4 q + 3 in quarter q of a .. d, to the coordinates of position i in lane i.
static vectors transposed(float16 a, float16 b, float16 c, float16 d) {
  const float16 ab = low(a, b), cd = low(c, d);
  const vectors result = {low_pairs(ab, cd), high_pairs(ab, cd), low_pairs(high(a, b), high(c, d))};
  return result;
}

static vectors gather(__global const float4* from, __global const int* at) {
  return transposed((float16)(from[at[0]], from[at[4]], from[at[8]], from[at[12]]),
                    (float16)(from[at[1]], from[at[5]], from[at[9]], from[at[13]]),
                    (float16)(from[at[2]], from[at[6]], from[at[10]], from[at[14]]),
                    (float16)(from[at[3]], from[at[7]], from[at[11]], from[at[15]]));
}

static void scatter(float16 x, float16 y, float16 z, __global float4* to) {
  const float16 xy_low = low(x, y), z_low = low(z, (float16)0);
  const float16 xy_high = high(x, y), z_high = high(z, (float16)0);
  const float16 a = low_pairs(xy_low, z_low), b = high_pairs(xy_low, z_low);
  const float16 c = low_pairs(xy_high, z_high), d = high_pairs(xy_high, z_high);
  to[0] = a.s0123;
  to[1] = b.s0123;
  to[2] = c.s0123;
  to[3] = d.s0123;
  to[4] = a.s4567;
  to[5] = b.s4567;
  to[6] = c.s4567;
  to[7] = d.s4567;
  to[8] = a.s89ab;
  to[9] = b.s89ab;
  to[10] = c.s89ab;
  to[11] = d.s89ab;
  to[12] = a.scdef;
  to[13] = b.scdef;
  to[14] = c.scdef;
  to[15] = d.scdef;
}

// Half the smoothing times the cotangents of the faces (centre, first, second) at their corners, in
// that order; 0 for a face that is no higher than LEAST_HEIGHT over its longest side.
static corners cotangents(vectors first, vectors second, float half_smoothing) {
  const vectors edge = minus(second, first);
  const vectors normal = {first.y * edge.z - first.z * edge.y, first.z * edge.x - first.x * edge.z,
                          first.x * edge.y - first.y * edge.x};
  const float16 square = dots(normal, normal);
  const float16 at_centre = dots(first, second);
  const float16 at_first = -dots(first, edge);
  const float16 at_second = dots(second, edge);
  const float16 longest =
      fmax(fmax(at_centre + at_first, at_centre + at_second), at_first + at_second);
  const float16 scale = select((float16)0, half_smoothing / sqrt(square),
                               square > LEAST_HEIGHT * LEAST_HEIGHT * longest);
  const corners result = {scale * at_centre, scale * at_first, scale * at_second};
  return result;
}

// One iteration for the 16 vertices of a slice; `at` has their neighbours, 16 to a row.
static void move(__global const float4* now, __global const float4* own, __global float4* to,
                 __global const int* at, const int last, const float half_smoothing) {
  const vectors centre = transposed(
      (float16)(own[0], own[4], own[8], own[12]), (float16)(own[1], own[5], own[9], own[13]),
      (float16)(own[2], own[6], own[10], own[14]), (float16)(own[3], own[7], own[11], own[15]));

  const vectors end = minus(gather(now, at + 16 * last), centre);
  vectors here = minus(gather(now, at), centre);
  const corners closing = cotangents(end, here, half_smoothing);
  corners before = closing;
  // A row's couplings once the rows before it are eliminated: to the centre, to the last row, and
  // what holds it to where it was. The rest of its pivot is the coupling to the next row.
  complex right = {0, 0}, held = {0, 0}, to_last = {closing.centre, 0}, following = {0, 0};
  complex last_right = {0, 0}, last_held = {0, 1}, centre_held = {0, 1};
  row rows[LARGEST_RING - 1];
  for (int i = 0; i < last; ++i) {
    const int16 padding = vload16(i, at) == vload16(i + 1, at);
    const vectors there = i + 1 < last ? minus(gather(now, at + 16 * (i + 1)), centre) : end;
    const corners after = cotangents(here, there, half_smoothing);
    const complex fresh_right = {after.second + before.first, 0}, fresh_held = {0, 1};
    right = add_times(fresh_right, following, right);
    held = add_times(fresh_held, following, held);
    float16 to_next = after.centre;
    if (i + 1 == last) {
      to_last.re += to_next;
      to_next = 0;
    }
    const complex pivot = {(to_next + to_last.re) + (right.re + held.re),
                           to_last.im + (right.im + held.im)};
    const float16 scale =
        select(1 / (pivot.re * pivot.re + pivot.im * pivot.im), (float16)0, padding);
    const complex inverse = {scale * pivot.re, -scale * pivot.im};
    following.re = to_next * inverse.re;
    following.im = to_next * inverse.im;
    const complex scaled_right = times(inverse, right);
    const complex scaled_last = times(inverse, to_last);
    last_held = add_times(last_held, scaled_last, held);
    last_right = add_times(last_right, scaled_last, right);
    centre_held = add_times(centre_held, scaled_right, held);
    to_last = times(following, to_last);
    to_last.re = select(to_last.re, closing.centre, padding);
    before.first = select(after.first, closing.first, padding);
    rows[i].position = here;
    rows[i].right = scaled_right;
    rows[i].following = following;
    rows[i].last = scaled_last;
    here = there;
  }
  last_right.re += closing.second + before.first;
  const complex pivot = {last_right.re + last_held.re, last_right.im + last_held.im};
  const float16 scale = 1 / (pivot.re * pivot.re + pivot.im * pivot.im);
  const complex inverse = {scale * pivot.re, -scale * pivot.im};
  const complex last_weight = times(inverse, last_right);
  centre_held = add_times(centre_held, last_weight, last_held);

  complex weight = last_weight;
  vectors re = {weight.re * end.x, weight.re * end.y, weight.re * end.z};
  vectors im = {weight.im * end.x, weight.im * end.y, weight.im * end.z};
  for (int i = last - 1; i >= 0; --i) {
    weight =
        add_times(add_times(rows[i].right, rows[i].last, last_weight), rows[i].following, weight);
    const vectors position = rows[i].position;
    re.x += weight.re * position.x;
    re.y += weight.re * position.y;
    re.z += weight.re * position.z;
    im.x += weight.im * position.x;
    im.y += weight.im * position.y;
    im.z += weight.im * position.z;
  }
  const float16 over = 1 / (centre_held.re * centre_held.re + centre_held.im * centre_held.im);
  const float16 of_re = over * centre_held.im;
  const float16 of_im = -over * centre_held.re;
  const float16 x = centre.x + (of_re * re.x + of_im * im.x);
  const float16 y = centre.y + (of_re * re.y + of_im * im.y);
  const float16 z = centre.z + (of_re * re.z + of_im * im.z);
  scatter(x, y, z, to);
}

// Slice s holds the positions 16 s .. 16 s + 15. Row i of its rings, one entry per lane, is
// ring[16 (first_row[s] + i)]...; shorter rings repeat their first neighbour at the front.
__kernel void one_ring_wide(__global const float4* now, __global float4* next,
                            __global const int* first_row, __global const int* ring,
                            const int slices, const float smoothing) {
  const int begin = SLICES_PER_ITEM * get_global_id(0);
  const int end = min(begin + SLICES_PER_ITEM, slices);
  for (int slice = begin; slice < end; ++slice) {
    const size_t first = 16 * (size_t)slice;
    move(now, now + first, next + first, ring + 16 * (size_t)first_row[slice],
         first_row[slice + 1] - first_row[slice] - 1, smoothing / 2);
  }
}

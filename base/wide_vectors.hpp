// Loops compiled for wide vectors, too.
#pragma once

/// Before the definition of a function: it is compiled a second time for processors with AVX2, and
/// the right one is taken when the library is loaded. All that it calls is inlined, as nothing else
/// of it would be wider. Neither fuses a product with a sum, so both give the same bytes as long as
/// no loop's sum is split.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define CURVESKEL_WIDE_VECTORS __attribute__((flatten, target_clones("avx2", "default")))
#else
#define CURVESKEL_WIDE_VECTORS
#endif

// GCC warns that vectors of 32 bytes are passed otherwise where there is AVX: none leaves its unit.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wpsabi"
#endif

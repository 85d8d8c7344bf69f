/*******************************************************************************
 * povaccelmeshtest.cpp
 *
 * SPDX-License-Identifier: AGPL-3.0-or-later
 *
 * This module tests a ray against eight triangles of a mesh at once: what
 * Mesh::intersect_mesh_triangle computes, operation by operation in the same order
 * in double, so that every lane has the bits that POV-Ray's own test would have.
 * Nothing may be fused or reordered here. It is a derivative work of POV-Ray
 * 3.7.0.10; see LICENSE.
 *******************************************************************************/

#include "backend/accel/povaccelmeshtest.h"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

// all vectors stay within this file: how they are handed over is of no concern
#pragma GCC diagnostic ignored "-Wpsabi"

// wide instruction sets have fused operations, which a compiler may use for a * b + c
#pragma GCC optimize("fp-contract=off")

namespace pov
{

typedef float AccelFloats __attribute__((vector_size(4 * ACCEL_MESH_LANES)));
typedef uint32_t AccelWords __attribute__((vector_size(4 * ACCEL_MESH_LANES)));
typedef double AccelLanes __attribute__((vector_size(8 * ACCEL_MESH_LANES)));
typedef int64_t AccelMask __attribute__((vector_size(8 * ACCEL_MESH_LANES)));

// the limits of mesh.cpp and configbackend.h
static const double LEAST_COSINE = 1.0e-10; // EPSILON
static const double LEAST_DEPTH = 1e-6; // DEPTH_TOLERANCE
static const double LARGEST_DEPTH = 1.0e7; // MAX_DISTANCE

namespace plain
{

static inline uint32_t Mask_Bits(AccelMask mask)
{
	uint32_t bits = 0;

	for(int i = 0; i < ACCEL_MESH_LANES; i++)
		bits |= uint32_t(mask[i] & 1) << i;

	return bits;
}

#include "backend/accel/povaccelmeshlanes.h"

}

#if defined(__x86_64__)

#pragma GCC push_options
#pragma GCC target("avx2")

namespace avx2
{

static inline uint32_t Mask_Bits(AccelMask mask)
{
	__m256d half[2];

	__builtin_memcpy(half, &mask, sizeof(half));
	return uint32_t(_mm256_movemask_pd(half[0])) | (uint32_t(_mm256_movemask_pd(half[1])) << 4);
}

#include "backend/accel/povaccelmeshlanes.h"

}

#pragma GCC pop_options
#pragma GCC push_options
#pragma GCC target("avx512f,avx512dq,avx512vl")

namespace avx512
{

static inline uint32_t Mask_Bits(AccelMask mask)
{
	__m512i all;

	__builtin_memcpy(&all, &mask, sizeof(all));
	return _mm512_movepi64_mask(all);
}

#include "backend/accel/povaccelmeshlanes.h"

}

#pragma GCC pop_options

#endif

AccelMeshTest *Choose_Mesh_Test()
{
#if defined(__x86_64__)
	__builtin_cpu_init();
	if(__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl"))
		return &avx512::Test;
	if(__builtin_cpu_supports("avx2"))
		return &avx2::Test;
#endif
	return &plain::Test;
}

}

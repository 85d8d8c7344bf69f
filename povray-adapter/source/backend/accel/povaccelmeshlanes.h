/*******************************************************************************
 * povaccelmeshlanes.h
 *
 * SPDX-License-Identifier: AGPL-3.0-or-later
 *
 * The test of a ray against eight triangles, for one instruction set. Included by
 * povaccelmeshtest.cpp once for each, in a namespace of its own and after
 * Mask_Bits(mask), which makes bits of the lanes of a mask. See there for what it
 * computes. It is a derivative work of POV-Ray 3.7.0.10; see LICENSE.
 *******************************************************************************/

static inline AccelLanes Load_Lanes(const float *from)
{
	AccelFloats floats;

	__builtin_memcpy(&floats, from, sizeof(floats));
	return __builtin_convertvector(floats, AccelLanes);
}

static inline AccelLanes In_All_Lanes(double x)
{
	const AccelLanes lanes = { x, x, x, x, x, x, x, x };

	return lanes;
}

/// The lanes where (s, t) lies beyond the edge from one corner to the next.
static inline uint32_t Beyond_Edge(AccelLanes s, AccelLanes t, AccelLanes a1, AccelLanes b1, AccelLanes a2, AccelLanes b2)
{
	return Mask_Bits((a2 - s) * (b2 - b1) < (b2 - t) * (a2 - a1));
}

/// The lanes whose triangle does not hold the point at that depth, seen along its dominant axis.
static inline uint32_t Miss_Triangles(const AccelMeshBlock& block, const AccelMeshRay& ray, AccelLanes depth)
{
	const double *o = ray.origin, *d = ray.direction;
	AccelWords words;

	__builtin_memcpy(&words, block.triangle, sizeof(words));

	const AccelMask axis = __builtin_convertvector(words >> AccelMeshBlock::INDEX_BITS, AccelMask);
	const AccelMask alongX = (axis == 0), alongZ = (axis == 2);
	const AccelLanes oy = In_All_Lanes(o[1]), dy = In_All_Lanes(d[1]);
	const AccelLanes s = (alongX ? oy : In_All_Lanes(o[0])) + depth * (alongX ? dy : In_All_Lanes(d[0]));
	const AccelLanes t = (alongZ ? oy : In_All_Lanes(o[2])) + depth * (alongZ ? dy : In_All_Lanes(d[2]));
	const AccelLanes a1 = Load_Lanes(block.corner[0][0]), b1 = Load_Lanes(block.corner[0][1]);
	const AccelLanes a2 = Load_Lanes(block.corner[1][0]), b2 = Load_Lanes(block.corner[1][1]);
	const AccelLanes a3 = Load_Lanes(block.corner[2][0]), b3 = Load_Lanes(block.corner[2][1]);

	return Beyond_Edge(s, t, a1, b1, a2, b2) | Beyond_Edge(s, t, a2, b2, a3, b3) | Beyond_Edge(s, t, a3, b3, a1, b1);
}

static uint32_t Test(const AccelMeshBlock& block, const AccelMeshRay& ray, double out[ACCEL_MESH_LANES])
{
	const double *o = ray.origin, *d = ray.direction;
	const AccelLanes x = Load_Lanes(block.normal[0]), y = Load_Lanes(block.normal[1]), z = Load_Lanes(block.normal[2]);
	const AccelLanes cosine = x * d[0] + y * d[1] + z * d[2];
	const AccelLanes depth = -(Load_Lanes(block.distance) + (x * o[0] + y * o[1] + z * o[2])) / cosine;
	const uint32_t all = (1u << ACCEL_MESH_LANES) - 1u;
	uint32_t missed = Mask_Bits((cosine < LEAST_COSINE) & (cosine > -LEAST_COSINE)) |
	                  Mask_Bits((depth < LEAST_DEPTH) | (depth > LARGEST_DEPTH));

	if(missed == all)
		return 0;
	missed |= Miss_Triangles(block, ray, depth);
	__builtin_memcpy(out, &depth, sizeof(depth));

	return missed ^ all;
}

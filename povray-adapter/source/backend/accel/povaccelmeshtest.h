/*******************************************************************************
 * povaccelmeshtest.h
 *
 * SPDX-License-Identifier: AGPL-3.0-or-later
 *
 * This module contains all defines, typedefs, and prototypes for
 * povaccelmeshtest.cpp: the test of a ray against eight triangles of a mesh at
 * once. It is a derivative work of POV-Ray 3.7.0.10; see LICENSE.
 *******************************************************************************/

#ifndef POVRAY_BACKEND_POVACCELMESHTEST_H
#define POVRAY_BACKEND_POVACCELMESHTEST_H

#include <stdint.h>

namespace pov
{

/// Triangles that are tested together.
static const int ACCEL_MESH_LANES = 8;

/// What Mesh::intersect_mesh_triangle reads of up to eight triangles. A lane without one has a normal of 0, which no ray meets.
struct AccelMeshBlock
{
	float normal[3][ACCEL_MESH_LANES];
	float distance[ACCEL_MESH_LANES];
	/// first and second coordinate of each corner across the dominant axis
	float corner[3][2][ACCEL_MESH_LANES];
	/// index of the triangle, and its dominant axis in the highest two bits
	uint32_t triangle[ACCEL_MESH_LANES];

	static const uint32_t INDEX_BITS = 30;

	uint32_t Index(int lane) const { return triangle[lane] & ((1u << INDEX_BITS) - 1u); }
	int Axis(int lane) const { return triangle[lane] >> INDEX_BITS; }
};

/// A ray in the space of the mesh.
struct AccelMeshRay
{
	double origin[3];
	double direction[3];
};

/// The lanes whose triangle the ray meets, as bits, and how far away.
typedef uint32_t AccelMeshTest(const AccelMeshBlock& block, const AccelMeshRay& ray, double depth[ACCEL_MESH_LANES]);

/// The test for this processor. All give the same bits.
AccelMeshTest *Choose_Mesh_Test();

}

#endif // POVRAY_BACKEND_POVACCELMESHTEST_H

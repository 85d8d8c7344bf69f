/*******************************************************************************
 * povaccelmeshgroup.h
 *
 * SPDX-License-Identifier: AGPL-3.0-or-later
 *
 * This module contains all defines, typedefs, and prototypes for
 * povaccelmeshgroup.cpp: the triangles of a mesh in blocks of eight neighbours,
 * and boxes for them. It is a derivative work of POV-Ray 3.7.0.10; see LICENSE.
 *******************************************************************************/

#ifndef POVRAY_BACKEND_POVACCELMESHGROUP_H
#define POVRAY_BACKEND_POVACCELMESHGROUP_H

#include <vector>

#include "backend/frame.h"
#include "backend/shape/mesh.h"
#include "backend/accel/accel.h"
#include "backend/accel/povaccelmeshtest.h"

namespace pov
{

/// The triangles that a ray can hit.
struct AccelMeshGroups
{
	/// neighbours together
	vector<AccelMeshBlock> blocks;
	/// triangles for which no box is known: any ray may hit them anywhere
	vector<AccelMeshBlock> looseBlocks;
	size_t triangles, looseTriangles;
	/// the largest coordinate of a corner of the others
	double largest;

	explicit AccelMeshGroups(const MESH_DATA& data);
};

/// A box that holds all hits of the triangles but for rounding, for which `growth` is added: an infinite one if some may be
/// anywhere. Says what the largest coordinate of a corner is.
accel_box Bound_Mesh(const MESH_DATA& data, double& largest);

/// What rounding needs, on all sides, for rays that begin within `reach` of the origin.
double Mesh_Growth(double largest, double reach);

/// A box that holds all hits of a block for rays that begin within `reach` of the origin, along every axis.
accel_box Bound_Mesh_Block(const AccelMeshBlock& block, double largest, double reach);

}

#endif // POVRAY_BACKEND_POVACCELMESHGROUP_H

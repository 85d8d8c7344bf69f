/*******************************************************************************
 * povaccelbox.h
 *
 * SPDX-License-Identifier: AGPL-3.0-or-later
 *
 * This module contains all defines, typedefs, and prototypes for povaccelbox.cpp:
 * the boxes of POV-Ray's objects for the accel library. It is a derivative work
 * of POV-Ray 3.7.0.10; see LICENSE.
 *******************************************************************************/

#ifndef POVRAY_BACKEND_POVACCELBOX_H
#define POVRAY_BACKEND_POVACCELBOX_H

#include <vector>

#include "backend/frame.h"
#include "backend/accel/accel.h"
#include "backend/accel/povaccelframe.h"

namespace pov
{

class SceneData;

/// Stock looks for the interiors around a point in two places, and leaves clips out in both.
enum AccelContainerSearch
{
	ACCEL_OF_CAMERA_RAYS, // TracePixel::InitRayContainerState: the object's BBox has to hold the point as well
	ACCEL_OF_PHOTONS      // PhotonShootingTask::ShootPhotonsAtObject
};

/// Where rays begin that boxes are made for, each within the next. Most begin in the first, near the camera, where rounding is
/// small: `near` are the boxes for these. The last is for rays that are along one of `grazings`, which belong to no other.
void Find_Reaches(const SceneData& scene, const vector<ObjectPtr>& objects, AccelGrazings& grazings, AccelReach reach[ACCEL_REACHES],
                  vector<accel_box>& near);

/// The largest cube around the same centre as `whole`, and no larger, for which boxes are hardly larger than for rays from the
/// centre.
AccelReach Find_Near_Reach(const vector<ObjectPtr>& objects, const AccelReach& whole);

/// A box for each object that holds all hits of rays that begin within `reach`, with infinite sides where none is known,
/// and the lower side above the upper one if it has no hits.
vector<accel_box> Find_Boxes(const vector<ObjectPtr>& objects, const AccelReach& reach);

/// A box for each part of a CSG object, an intersection if it is `common`, which holds those of its hits that may be hits of the
/// object, and the points that it may settle; `always` are the parts without such a box, rising.
void Find_Part_Boxes(const vector<ObjectPtr>& parts, bool common, const AccelReach& reach, vector<accel_box>& boxes, vector<uint32_t>& always);

/// Is there nothing that a ray can hit or a point can be in? So it is with light sources without looks_like.
bool Is_Dark_Light(const ObjectBase *object);

/// A box for each object with an interior that holds the points inside it, without its clips; an empty one for the others. The
/// observer of `reach` sees the CSG objects among these objects and their parts.
vector<accel_box> Find_Insides(const vector<ObjectPtr>& objects, const AccelReach& reach);

/// The objects with an interior that a point outside their box may be in, as far as a container search tells.
vector<uint32_t> Objects_Beyond_Boxes(const vector<ObjectPtr>& objects, const vector<accel_box>& boxes, const vector<accel_box>& insides,
                                      AccelContainerSearch search);

}

#endif // POVRAY_BACKEND_POVACCELBOX_H

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

/// A light source without looks_like: no test ever finds it.
bool Is_Dark_Light(const ObjectBase *object);

/// Where rays begin that boxes are made for, each within the next. Most begin in the first, near the camera, where rounding is
/// small.
void Find_Reaches(const SceneData& scene, const vector<ObjectPtr>& objects, AccelReach reach[ACCEL_REACHES]);

/// A box for each object that holds all hits of rays that begin within `reach`, with infinite sides where none is known,
/// and the lower side above the upper one if it has no hits.
vector<accel_box> Find_Boxes(const vector<ObjectPtr>& objects, const AccelReach& reach);

/// The objects that a point outside their box for this reach may be in, as far as TracePixel::InitRayContainerState tells.
vector<uint32_t> Objects_Beyond_Boxes(const vector<ObjectPtr>& objects, const AccelReach& reach);

}

#endif // POVRAY_BACKEND_POVACCELBOX_H

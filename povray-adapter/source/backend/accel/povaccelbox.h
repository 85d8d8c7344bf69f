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

namespace pov
{

class SceneData;

/// The boxes of some objects of a scene, with infinite sides where they are not known.
/// A light source among them must have a looks_like object.
vector<accel_box> Find_Boxes(const SceneData& scene, const vector<ObjectPtr>& objects);

}

#endif // POVRAY_BACKEND_POVACCELBOX_H

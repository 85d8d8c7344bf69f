/*******************************************************************************
 * povaccelmissed.h
 *
 * SPDX-License-Identifier: AGPL-3.0-or-later
 *
 * This module contains what spares a shadow ray the second test of one object. Stock
 * tests the object in the light's shadow cache first, alone, and when that is not hit,
 * all objects, that one again. A leaf test depends on nothing but its ray, so it would
 * miss again. It is a derivative work of POV-Ray 3.7.0.10; see LICENSE.
 *******************************************************************************/

#ifndef POVRAY_BACKEND_POVACCELMISSED_H
#define POVRAY_BACKEND_POVACCELMISSED_H

#include "backend/frame.h"
#include "backend/scene/threaddata.h"

namespace pov
{

/// While it lives, a thread knows of an object that the ray of its next query does not hit.
class AccelMissed
{
	public:
		explicit AccelMissed(TraceThreadData *t) : thread(t) { Forget(); }
		~AccelMissed() { Forget(); }

		/// The object is now tested against the ray, up to the limit.
		void Note(ObjectPtr object, DBL limit)
		{
			thread->accelMissed = object;
			thread->accelMissedLimit = limit;
		}

		/// It was hit, or the ray is no longer the same.
		void Forget() { thread->accelMissed = NULL; }
	private:
		TraceThreadData *thread;

		/// not available
		AccelMissed(const AccelMissed&);
		AccelMissed& operator=(const AccelMissed&);
};

}

#endif // POVRAY_BACKEND_POVACCELMISSED_H

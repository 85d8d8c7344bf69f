/*******************************************************************************
 * povaccelplain.h
 *
 * SPDX-License-Identifier: AGPL-3.0-or-later
 *
 * This module contains what makes a thread search without structures inside
 * objects: the judge of Accelerator_Verify shares nothing with what it judges. It is
 * a derivative work of POV-Ray 3.7.0.10; see LICENSE.
 *******************************************************************************/

#ifndef POVRAY_BACKEND_POVACCELPLAIN_H
#define POVRAY_BACKEND_POVACCELPLAIN_H

#include "backend/frame.h"
#include "backend/scene/threaddata.h"

namespace pov
{

/// While it lives, a thread runs POV-Ray's own loops over all parts of an object.
class AccelPlain
{
	public:
		explicit AccelPlain(TraceThreadData *t) : thread(t), before(t->accelPlain) { thread->accelPlain = true; }
		~AccelPlain() { thread->accelPlain = before; }
	private:
		TraceThreadData *thread;
		const bool before;

		/// not available
		AccelPlain(const AccelPlain&);
		AccelPlain& operator=(const AccelPlain&);
};

}

#endif // POVRAY_BACKEND_POVACCELPLAIN_H

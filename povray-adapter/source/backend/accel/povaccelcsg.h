/*******************************************************************************
 * povaccelcsg.h
 *
 * SPDX-License-Identifier: AGPL-3.0-or-later
 *
 * This module contains all defines, typedefs, and prototypes for povaccelcsg.cpp:
 * the parts of a CSG object in a structure of their own. It is a derivative work of
 * POV-Ray 3.7.0.10; see LICENSE.
 *******************************************************************************/

#ifndef POVRAY_BACKEND_POVACCELCSG_H
#define POVRAY_BACKEND_POVACCELCSG_H

#include <atomic>
#include <vector>

#include <boost/container/small_vector.hpp>
#include <boost/thread.hpp>

#include "backend/frame.h"
#include "backend/accel/accel.h"
#include "backend/accel/povaccelfew.h"
#include "backend/accel/povaccelframe.h"
#include "backend/scene/objects.h"

namespace pov
{

/// How CSG puts its parts together. Differences are intersections with inverted parts.
enum AccelOperation { ACCEL_UNION, ACCEL_MERGE, ACCEL_INTERSECTION };

/// Places among the parts, rising. Memory is asked for only where there are many.
typedef boost::container::small_vector<uint32_t, 64> AccelPlaces;

/*
 * Answers as the functions of csg.cpp do, whose loops it runs over the parts that a
 * ray or point is near, in the same order: a part whose box of hits the ray misses
 * has no hit, and to be inside (for an intersection: outside) of a part, a point has
 * to lie in its box of that side. A structure is built when the first ray or point
 * comes, and shared by all threads after that; few boxes are asked one by one.
 */
class AccelCsg
{
	public:
		/// Fewer parts get no structure; of some of these the boxes are asked one after the other.
		static const size_t FEWEST_PARTS = 6;

		/// Of many parts, for rays and points within `reach`.
		AccelCsg(CompoundObject& object, AccelOperation operation, const AccelReach& reach);

		/// Of few parts, with boxes for rays and points within `reach`.
		AccelCsg(CompoundObject& object, AccelOperation operation, const AccelReach& reach, const AccelFewParts& few);
		~AccelCsg();

		/// Does it answer, or do stock's loops over all parts?
		bool Answers(const VECTOR where, const TraceThreadData *thread) const;

		bool AllIntersections(const Ray& ray, IStack& depths, TraceThreadData *thread) const;
		bool Inside(const VECTOR point, TraceThreadData *thread) const;

		bool IsOfFew() const { return !few.IsEmpty(); }
		bool IsBuilt() const { return IsOfFew() || levels[NEAR].built || levels[FAR].built; }
		size_t PartCount() const { return parts.size(); }
		size_t Bytes() const;
	private:
		/// Over one box for each part, which holds its hits and the points that it may settle.
		struct Level
		{
			AccelReach reach;
			accel *structure; // NULL also where there was no memory
			vector<uint32_t> always; // the parts without such a box, rising
			std::atomic<bool> built;

			Level() : structure(NULL), built(false) { }
		};

		/// Boxes for rays from far away may be much larger than small parts.
		enum { NEAR, FAR, LEVELS };

		CompoundObject& object;
		const vector<ObjectPtr>& parts;
		const AccelOperation operation;
		const AccelFewParts few; // none where there is a structure
		mutable Level levels[LEVELS];
		mutable std::atomic<bool> measured; // levels[NEAR].reach is known
		mutable boost::mutex mutex;

		void Build(Level& level) const;
		const Level *Choose(const VECTOR where) const;
		void FindNear(const Ray& ray, AccelPlaces& near, TraceThreadData *thread) const;
		void FindNear(const VECTOR point, AccelPlaces& near) const;
		bool AddHitsOfFew(uint32_t near, const Ray& ray, IStack& depths, TraceThreadData *thread) const;
		bool AddHitsOfMany(const Ray& ray, IStack& depths, TraceThreadData *thread) const;
		bool AddHits(uint32_t place, const Ray& ray, IStack& local, IStack& depths, TraceThreadData *thread) const;
		bool Hides(uint32_t place, const VECTOR point, const Ray& ray, TraceThreadData *thread) const;
		bool IsSurface(const VECTOR point, uint32_t place, const Ray& ray, TraceThreadData *thread) const;

		/// not available
		AccelCsg(const AccelCsg&);
		AccelCsg& operator=(const AccelCsg&);
};

/// Gives structures to the CSG objects with enough parts among these objects, their parts, clips and bounds, and to some of the
/// others the boxes that were kept, which are for rays within `near`.
void Accel_Take_Csg(const vector<ObjectPtr>& objects, const AccelReach& reach, const AccelReach& near, const AccelFewBoxes& boxes,
                    vector<AccelCsg *>& taken);

}

#endif // POVRAY_BACKEND_POVACCELCSG_H

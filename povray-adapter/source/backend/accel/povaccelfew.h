/*******************************************************************************
 * povaccelfew.h
 *
 * SPDX-License-Identifier: AGPL-3.0-or-later
 *
 * This module contains all defines, typedefs, and prototypes for povaccelfew.cpp:
 * the boxes of a CSG object's parts where they are few. It is a derivative work of
 * POV-Ray 3.7.0.10; see LICENSE.
 *******************************************************************************/

#ifndef POVRAY_BACKEND_POVACCELFEW_H
#define POVRAY_BACKEND_POVACCELFEW_H

#include <unordered_map>
#include <vector>

#include "backend/frame.h"
#include "backend/accel/accel.h"
#include "backend/accel/povaccelframe.h"

namespace pov
{

/// The boxes of up to 32 parts, asked one after the other. A box costs less than the test of most parts.
class AccelFewParts
{
	public:
		/// None: no part is passed over.
		AccelFewParts() : always(0) { }

		AccelFewParts(const vector<accel_box>& boxes, uint32_t always);

		bool IsEmpty() const { return boxes.empty(); }
		size_t Bytes() const { return boxes.size() * sizeof(accel_box); }

		/// All parts, as bits.
		uint32_t All() const { return (1u << boxes.size()) - 1; }

		/// The parts that a ray may hit from there on, as bits. The ray begins within the reach of the boxes.
		uint32_t Near(const Ray& ray) const;

		/// The parts whose boxes hold a point, as bits.
		uint32_t Near(const VECTOR point) const;
	private:
		vector<accel_box> boxes;
		uint32_t always; // those that are not asked
};

/// Keeps the boxes of those CSG objects for which asking them takes less time than it saves.
class AccelFewBoxes : public AccelPartObserver
{
	public:
		/// Of objects of fewer parts.
		explicit AccelFewBoxes(size_t most) : mostParts(most) { }

		virtual bool Wants(const CompoundObject& compound) const;
		virtual void See(const CompoundObject& compound, const accel_box& whole, const vector<accel_box>& boxes, const vector<uint32_t>& always);

		/// NULL if there are none of that object.
		const AccelFewParts *Of(const CompoundObject& compound) const;
	private:
		const size_t mostParts;
		std::unordered_map<const CompoundObject *, AccelFewParts> kept;
};

}

#endif // POVRAY_BACKEND_POVACCELFEW_H

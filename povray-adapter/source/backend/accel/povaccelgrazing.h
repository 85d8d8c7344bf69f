/*******************************************************************************
 * povaccelgrazing.h
 *
 * SPDX-License-Identifier: AGPL-3.0-or-later
 *
 * This module contains all defines, typedefs, and prototypes for
 * povaccelgrazing.cpp: which rays are kept from the boxes that most rays are tested
 * with. It is a derivative work of POV-Ray 3.7.0.10; see LICENSE.
 *******************************************************************************/

#ifndef POVRAY_BACKEND_POVACCELGRAZING_H
#define POVRAY_BACKEND_POVACCELGRAZING_H

#include <vector>

#include "backend/frame.h"
#include "backend/math/vector.h"

namespace pov
{

/// The directions, of length 1, for which a form is small: least < |form(direction)| <= most.
class AccelGrazing
{
	public:
		/// normal * direction. The normal may have any length, by which the limits count as well.
		static AccelGrazing Linear(const VECTOR normal, DBL least, DBL most);

		/// The sum of square[k] * direction[k]^2 and the mixed products xy, xz, yz.
		static AccelGrazing Quadratic(const VECTOR square, const VECTOR mixed, DBL most);

		/// Is the form one, and are there directions for which it is not small?
		bool IsUseful() const { return (most > 0.0) && (most < 0.25); }

		bool IsLinear() const { return linear; }

		/// The same form, up to rounding?
		bool IsLike(const AccelGrazing& other) const;

		/// Adds the directions of one like it.
		void Include(const AccelGrazing& other);

		/// Has it all directions of one like it?
		bool Includes(const AccelGrazing& other) const;

		/// So that what is like it by rounding alone holds no more.
		void Widen();

		/// Of a linear form.
		bool HoldsLinear(const VECTOR d) const
		{
			return IsSmall(factor[0] * d[X] + factor[1] * d[Y] + factor[2] * d[Z]);
		}

		/// Of a quadratic one.
		bool HoldsQuadratic(const VECTOR d) const
		{
			return IsSmall(d[X] * (factor[0] * d[X] + factor[3] * d[Y] + factor[4] * d[Z]) +
			               d[Y] * (factor[1] * d[Y] + factor[5] * d[Z]) + factor[2] * Sqr(d[Z]));
		}
	private:
		static constexpr DBL SAME = 1.0e-14;

		bool linear;
		DBL factor[6]; // the largest is 1 or -1
		DBL least, most;

		bool IsSmall(DBL form) const { return !(fabs(form) > most) && !(fabs(form) <= least); }

		void Normalize(DBL lower, DBL upper);
};

/// The grazing directions of a scene.
class AccelGrazings
{
	public:
		/// Some shape would have a smaller box without these.
		void Want(const AccelGrazing& grazing);

		/// Keeps those that are wanted most. False if some shape may not get what it wants.
		bool Keep();

		bool Keeps(const AccelGrazing& grazing) const;

		/// Is a ray like that? Those whose direction does not have length 1 count as well. Each ray asks.
		bool Holds(const VECTOR d) const
		{
			if(linear.empty() && quadratic.empty())
				return false;

			bool holds = !(fabs(Sqr(d[X]) + Sqr(d[Y]) + Sqr(d[Z]) - 1.0) < 1.0e-9);

			for(vector<AccelGrazing>::const_iterator i = linear.begin(); i != linear.end(); i++)
				holds |= i->HoldsLinear(d);
			for(vector<AccelGrazing>::const_iterator i = quadratic.begin(); i != quadratic.end(); i++)
				holds |= i->HoldsQuadratic(d);

			return holds;
		}
	private:
		static const size_t MOST_WANTED = 64, MOST_QUADRATIC = 4, MOST_LINEAR = 32;

		struct Wanted
		{
			AccelGrazing grazing;
			size_t count;

			explicit Wanted(const AccelGrazing& g) : grazing(g), count(1) { }

			bool operator<(const Wanted& other) const { return count > other.count; }
		};

		vector<Wanted> wanted;
		vector<AccelGrazing> linear, quadratic; // kept
};

}

#endif // POVRAY_BACKEND_POVACCELGRAZING_H

/*******************************************************************************
 * povaccelgrazing.h
 *
 * SPDX-License-Identifier: AGPL-3.0-or-later
 *
 * This module says which rays are kept from the boxes that most rays are tested
 * with. Some leaf tests divide by a form of the direction of a ray: a lathe by its
 * component along the axis, a cone by the quadratic term that vanishes along its
 * side. Where the form is nearly 0 the hit may be far from the shape, so a box that
 * holds it would be large or endless. Few rays are like that. They get boxes of their
 * own, and the boxes for all others need not allow for them.
 *
 * A form that only some of many shapes have is not worth asking each ray for: those
 * that most shapes share are kept, quadratic ones up to MOST_QUADRATIC, and linear ones,
 * without which no allowance would do and which take less time, up to MOST_LINEAR. Shapes
 * with other forms allow for all rays, as far as they can. It is a derivative work of
 * POV-Ray 3.7.0.10; see LICENSE.
 *******************************************************************************/

#ifndef POVRAY_BACKEND_POVACCELGRAZING_H
#define POVRAY_BACKEND_POVACCELGRAZING_H

#include <algorithm>
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
		static AccelGrazing Linear(const VECTOR normal, DBL least, DBL most)
		{
			AccelGrazing grazing;

			grazing.linear = true;
			for(int k = 0; k < 6; k++)
				grazing.factor[k] = (k < 3) ? normal[k] : 0.0;
			grazing.Normalize(least, most);

			return grazing;
		}

		/// The sum of square[k] * direction[k]^2 and the mixed products xy, xz, yz.
		static AccelGrazing Quadratic(const VECTOR square, const VECTOR mixed, DBL most)
		{
			AccelGrazing grazing;

			grazing.linear = false;
			for(int k = 0; k < 6; k++)
				grazing.factor[k] = (k < 3) ? square[k] : mixed[k - 3];
			grazing.Normalize(-1.0, most);

			return grazing;
		}

		/// Is the form one, and are there directions for which it is not small?
		bool IsUseful() const { return (most > 0.0) && (most < 0.25); }

		bool IsLinear() const { return linear; }

		bool Holds(const VECTOR d) const
		{
			const DBL size = fabs(linear ? factor[0] * d[X] + factor[1] * d[Y] + factor[2] * d[Z] :
				d[X] * (factor[0] * d[X] + factor[3] * d[Y] + factor[4] * d[Z]) +
				d[Y] * (factor[1] * d[Y] + factor[5] * d[Z]) + factor[2] * Sqr(d[Z]));

			return !(size <= least) && !(size > most);
		}

		/// The same form, up to rounding?
		bool IsLike(const AccelGrazing& other) const
		{
			DBL difference = fabs(DBL(linear) - DBL(other.linear)), opposite = difference;

			for(int k = 0; k < 6; k++)
			{
				difference += fabs(factor[k] - other.factor[k]);
				opposite += fabs(factor[k] + other.factor[k]);
			}

			return min(difference, opposite) < SAME;
		}

		/// Adds the directions of one like it.
		void Include(const AccelGrazing& other)
		{
			least = min(least, other.least);
			most = max(most, other.most);
		}

		/// Has it all directions of one like it?
		bool Includes(const AccelGrazing& other) const { return IsLike(other) && (least <= other.least) && (most >= other.most); }

		/// So that what is like it by rounding alone holds no more.
		void Widen()
		{
			least -= 4.0 * SAME;
			most += 4.0 * SAME;
		}
	private:
		static constexpr DBL SAME = 1.0e-14;

		bool linear;
		DBL factor[6]; // the largest is 1 or -1
		DBL least, most;

		void Normalize(DBL lower, DBL upper)
		{
			DBL largest = 0.0;

			for(int k = 0; k < 6; k++)
				largest = max(largest, fabs(factor[k]));
			least = lower / largest;
			most = upper / largest;
			if(!(largest > 0.0) || !(largest < HUGE_VAL))
				most = -1.0;
			for(int k = 0; k < 6; k++)
				factor[k] /= largest;
		}
};

/// The grazing directions of a scene.
class AccelGrazings
{
	public:
		/// Some shape would have a smaller box without these.
		void Want(const AccelGrazing& grazing)
		{
			if(grazing.IsUseful() == false)
				return;
			for(size_t i = 0; i < wanted.size(); i++)
			{
				if(wanted[i].grazing.IsLike(grazing))
				{
					wanted[i].grazing.Include(grazing);
					wanted[i].count++;
					return;
				}
			}
			if(wanted.size() < MOST_WANTED)
				wanted.push_back(Wanted(grazing));
		}

		/// Keeps those that are wanted most. False if some shape may not get what it wants.
		bool Keep()
		{
			size_t left[2] = { MOST_QUADRATIC, MOST_LINEAR };
			bool all = true;

			std::stable_sort(wanted.begin(), wanted.end());
			for(size_t i = 0; i < wanted.size(); i++)
			{
				size_t& room = left[wanted[i].grazing.IsLinear()];

				all = all && (room > 0);
				if(room == 0)
					continue;
				room--;
				kept.push_back(wanted[i].grazing);
				kept.back().Widen();
			}
			wanted.clear();

			return all;
		}

		bool Keeps(const AccelGrazing& grazing) const
		{
			bool keeps = false;

			for(size_t i = 0; i < kept.size(); i++)
				keeps = keeps || kept[i].Includes(grazing);

			return keeps && grazing.IsUseful();
		}

		/// Is a ray like that? Those whose direction does not have length 1 count as well.
		bool Holds(const VECTOR direction) const
		{
			if(kept.empty())
				return false;

			const DBL length2 = Sqr(direction[X]) + Sqr(direction[Y]) + Sqr(direction[Z]);
			bool holds = !(fabs(length2 - 1.0) < 1.0e-9);

			for(size_t i = 0; i < kept.size(); i++)
				holds = holds || kept[i].Holds(direction);

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
		vector<AccelGrazing> kept;
};

}

#endif // POVRAY_BACKEND_POVACCELGRAZING_H

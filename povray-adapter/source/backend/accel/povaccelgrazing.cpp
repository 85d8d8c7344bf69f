/*******************************************************************************
 * povaccelgrazing.cpp
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

#include <algorithm>

// frame.h must always be the first POV file included (pulls in platform config)
#include "backend/frame.h"

#include "backend/accel/povaccelgrazing.h"

// this must be the last file included
#include "base/povdebug.h"

namespace pov
{

AccelGrazing AccelGrazing::Linear(const VECTOR normal, DBL least, DBL most)
{
	AccelGrazing grazing;

	grazing.linear = true;
	for(int k = 0; k < 6; k++)
		grazing.factor[k] = (k < 3) ? normal[k] : 0.0;
	grazing.Normalize(least, most);

	return grazing;
}

AccelGrazing AccelGrazing::Quadratic(const VECTOR square, const VECTOR mixed, DBL most)
{
	AccelGrazing grazing;

	grazing.linear = false;
	for(int k = 0; k < 6; k++)
		grazing.factor[k] = (k < 3) ? square[k] : mixed[k - 3];
	grazing.Normalize(-1.0, most);

	return grazing;
}

void AccelGrazing::Normalize(DBL lower, DBL upper)
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

bool AccelGrazing::IsLike(const AccelGrazing& other) const
{
	DBL difference = fabs(DBL(linear) - DBL(other.linear)), opposite = difference;

	for(int k = 0; k < 6; k++)
	{
		difference += fabs(factor[k] - other.factor[k]);
		opposite += fabs(factor[k] + other.factor[k]);
	}

	return min(difference, opposite) < SAME;
}

void AccelGrazing::Include(const AccelGrazing& other)
{
	least = min(least, other.least);
	most = max(most, other.most);
}

bool AccelGrazing::Includes(const AccelGrazing& other) const
{
	return IsLike(other) && (least <= other.least) && (most >= other.most);
}

void AccelGrazing::Widen()
{
	least -= 4.0 * SAME;
	most += 4.0 * SAME;
}

void AccelGrazings::Want(const AccelGrazing& grazing)
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

bool AccelGrazings::Keep()
{
	bool all = true;

	std::stable_sort(wanted.begin(), wanted.end());
	for(size_t i = 0; i < wanted.size(); i++)
	{
		const bool isLinear = wanted[i].grazing.IsLinear();
		vector<AccelGrazing>& kept = isLinear ? linear : quadratic;
		const bool room = kept.size() < (isLinear ? MOST_LINEAR : MOST_QUADRATIC);

		all = all && room;
		if(room == false)
			continue;
		kept.push_back(wanted[i].grazing);
		kept.back().Widen();
	}
	wanted.clear();

	return all;
}

bool AccelGrazings::Keeps(const AccelGrazing& grazing) const
{
	const vector<AccelGrazing>& kept = grazing.IsLinear() ? linear : quadratic;
	bool keeps = false;

	for(size_t i = 0; i < kept.size(); i++)
		keeps = keeps || kept[i].Includes(grazing);

	return keeps && grazing.IsUseful();
}

}

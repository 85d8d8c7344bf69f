/*******************************************************************************
 * povaccelmeshgroup.cpp
 *
 * SPDX-License-Identifier: AGPL-3.0-or-later
 *
 * This module puts the triangles of a mesh in blocks of eight neighbours, by the
 * surface-area heuristic, and says where their hits may be.
 *
 * A hit is what Mesh::intersect_mesh_triangle accepts: a depth from the plane of the
 * triangle, normal and distance of which are in float, and a place (s, t) across the
 * dominant axis that three comparisons find within the corners. Let u = 2^-53, C the
 * largest coordinate of a corner, M that of the origin of the ray, La, Lb the extents
 * of the triangle across the dominant axis k, D twice its area there.
 *
 * - Across k: products and differences of a comparison are wrong by 3.1u of what they
 *   are, so what it finds not to be beyond an edge is beyond it by a weight of 6.3u *
 *   La * Lb * (1 + 2d) / D at most, where d bounds these weights; that holds for
 *   d = 2 * K with K = 8u * La * Lb / D <= 1/32. So (s, t) leaves the box of the
 *   corners by no more than 4 * K of its extent. Where the corners run the other way
 *   round, nothing is accepted. Where K is larger, as for corners that float made
 *   coincide, (s, t) may be anywhere: such a triangle is loose.
 * - Along k: the hit lies on the plane as float has it, whose height over the corners is
 *   computed here, and not on that of the corners. |normal[k]| is about 1/sqrt(3) or
 *   more; a triangle for which it is below 1/2 is loose. So the slopes add up to less
 *   than 3.
 * - Rounding: the depth is wrong by what adds up to 14.1u * (M + C) in the plane's
 *   equation, hence 28.2u along k; s and t by 3u, and 8.7u along k for it; the heights
 *   here by 28u; and the place that depth / length along the direction of the scene
 *   means by 3.1u more. `growth` is 128u * (M + C).
 *
 * It is a derivative work of POV-Ray 3.7.0.10; see LICENSE.
 *******************************************************************************/

#include <algorithm>
#include <cmath>
#include <cstring>

// frame.h must always be the first POV file included (pulls in platform config)
#include "backend/frame.h"

#include "backend/accel/povaccelmeshgroup.h"
#include "backend/accel/povaccelregion.h"

// this must be the last file included
#include "base/povdebug.h"

namespace pov
{

/*****************************************************************************
 *
 * Boxes
 *
 *****************************************************************************/

/// The axes across a dominant axis, in the order in which mesh.cpp takes them.
static void Find_Axes_Across(int dominant, int& first, int& second)
{
	first = (dominant == X) ? Y : X;
	second = (dominant == Z) ? Y : Z;
}

/// The range of three numbers.
struct AccelRange
{
	double lo, hi;

	AccelRange(double a, double b, double c) : lo(min(a, min(b, c))), hi(max(a, max(b, c))) { }

	double Extent() const { return hi - lo; }

	void Grow(double by)
	{
		lo -= by;
		hi += by;
	}
};

/// K, as above.
static double Overshoot(const AccelMeshBlock& block, int lane)
{
	const double a1 = block.corner[0][0][lane], b1 = block.corner[0][1][lane];
	const double a2 = block.corner[1][0][lane], b2 = block.corner[1][1][lane];
	const double a3 = block.corner[2][0][lane], b3 = block.corner[2][1][lane];
	const double area = fabs((a2 - a1) * (b3 - b1) - (a3 - a1) * (b2 - b1));
	const double extents = AccelRange(a1, a2, a3).Extent() * AccelRange(b1, b2, b3).Extent();

	return ldexp(extents, -50) / area; // a NaN where the corners coincide
}

static bool Is_Loose(const AccelMeshBlock& block, int lane, double largest)
{
	bool sound = (Overshoot(block, lane) <= 1.0 / 32.0) && (fabs(block.normal[block.Axis(lane)][lane]) >= 0.5f) &&
	             (fabs(block.distance[lane]) <= 2.0 * largest);

	for(int axis = X; axis <= Z; axis++)
		sound = sound && (fabs(block.normal[axis][lane]) <= 1.01f);

	return !sound;
}

/// The box of one triangle, which is not loose.
static void Include_Triangle(accel_box& box, const AccelMeshBlock& block, int lane, double growth)
{
	const int axis = block.Axis(lane);
	int first, second;
	double height[3];

	Find_Axes_Across(axis, first, second);
	for(int i = 0; i < 3; i++)
	{
		height[i] = -(double(block.distance[lane]) + double(block.normal[first][lane]) * block.corner[i][0][lane] +
		              double(block.normal[second][lane]) * block.corner[i][1][lane]) / block.normal[axis][lane];
	}

	AccelRange range[3] =
	{
		AccelRange(block.corner[0][0][lane], block.corner[1][0][lane], block.corner[2][0][lane]),
		AccelRange(block.corner[0][1][lane], block.corner[1][1][lane], block.corner[2][1][lane]),
		AccelRange(height[0], height[1], height[2])
	};
	const double overshoot = 4.0 * Overshoot(block, lane) * max(range[0].Extent(), range[1].Extent());
	const int axes[3] = { first, second, axis };

	for(int i = 0; i < 3; i++)
	{
		range[i].Grow(growth + ((i == 2) ? 3.0 : 1.0) * overshoot);
		box.lo[axes[i]] = min(box.lo[axes[i]], range[i].lo);
		box.hi[axes[i]] = max(box.hi[axes[i]], range[i].hi);
	}
}

/// A lane that no ray meets.
static bool Is_Idle(const AccelMeshBlock& block, int lane)
{
	return (block.normal[X][lane] == 0.0f) && (block.normal[Y][lane] == 0.0f) && (block.normal[Z][lane] == 0.0f);
}

double Mesh_Growth(double largest, double reach)
{
	return ldexp(reach + largest, -46);
}

accel_box Bound_Mesh_Block(const AccelMeshBlock& block, double largest, double reach)
{
	const double growth = Mesh_Growth(largest, reach);
	accel_box box = Empty_Box();

	for(int lane = 0; lane < ACCEL_MESH_LANES; lane++)
	{
		if(!Is_Idle(block, lane))
			Include_Triangle(box, block, lane, growth);
	}

	return box;
}



/*****************************************************************************
 *
 * Blocks
 *
 *****************************************************************************/

static AccelMeshBlock Idle_Block()
{
	AccelMeshBlock block = AccelMeshBlock();

	return block;
}

static void Put_Triangle(AccelMeshBlock& block, int lane, const MESH_DATA& data, uint32_t index)
{
	const MESH_TRIANGLE& triangle = data.Triangles[index];
	const long corners[3] = { triangle.P1, triangle.P2, triangle.P3 };
	int first, second;

	Find_Axes_Across(triangle.Dominant_Axis, first, second);
	for(int axis = X; axis <= Z; axis++)
		block.normal[axis][lane] = data.Normals[triangle.Normal_Ind][axis];
	block.distance[lane] = triangle.Distance;
	for(int i = 0; i < 3; i++)
	{
		block.corner[i][0][lane] = data.Vertices[corners[i]][first];
		block.corner[i][1][lane] = data.Vertices[corners[i]][second];
	}
	block.triangle[lane] = index | (uint32_t(triangle.Dominant_Axis) << AccelMeshBlock::INDEX_BITS);
}

/// What the grouping knows of a triangle: its box, not in need of being exact.
struct AccelMeshItem
{
	float lo[3], hi[3];
	uint32_t index;

	float Middle(int axis) const { return lo[axis] + hi[axis]; }
};

typedef vector<AccelMeshItem>::iterator AccelMeshIterator;

/// A box that grows.
struct AccelMeshExtent
{
	float lo[3], hi[3];

	AccelMeshExtent()
	{
		for(int axis = X; axis <= Z; axis++)
		{
			lo[axis] = HUGE_VAL;
			hi[axis] = -HUGE_VAL;
		}
	}

	template<class BOX> void Include(const BOX& box)
	{
		for(int axis = X; axis <= Z; axis++)
		{
			lo[axis] = min(lo[axis], box.lo[axis]);
			hi[axis] = max(hi[axis], box.hi[axis]);
		}
	}

	float Surface() const
	{
		const float x = hi[X] - lo[X], y = hi[Y] - lo[Y], z = hi[Z] - lo[Z];

		return (x < 0.0f) ? 0.0f : x * y + y * z + z * x;
	}
};

static size_t Blocks_For(size_t triangles)
{
	return (triangles + ACCEL_MESH_LANES - 1) / ACCEL_MESH_LANES;
}

/// Is a triangle on the lower side of a cut between bins?
struct AccelMeshBelow
{
	int axis, bin;
	float from, scale;

	static const int BINS = 16;

	int Bin(const AccelMeshItem& item) const { return min(BINS - 1, max(0, int((item.Middle(axis) - from) * scale))); }
	bool operator()(const AccelMeshItem& item) const { return Bin(item) < bin; }
};

/// The cut of least cost: the surfaces of both sides, times their blocks.
struct AccelMeshCut
{
	AccelMeshBelow below;
	float cost;
};

static void Try_Axis(AccelMeshIterator begin, AccelMeshIterator end, AccelMeshBelow below, AccelMeshCut& best)
{
	const int bins = AccelMeshBelow::BINS;
	AccelMeshExtent extent[bins], rising;
	size_t count[bins] = { 0 }, above = 0, lower = 0;
	float costAbove[bins];

	for(AccelMeshIterator item = begin; item != end; item++)
	{
		const int bin = below.Bin(*item);

		extent[bin].Include(*item);
		count[bin]++;
	}

	AccelMeshExtent falling;

	for(int i = bins - 1; i > 0; i--)
	{
		falling.Include(extent[i]);
		above += count[i];
		costAbove[i] = (above > 0) ? falling.Surface() * Blocks_For(above) : HUGE_VAL;
	}
	for(int i = 1; i < bins; i++)
	{
		rising.Include(extent[i - 1]);
		lower += count[i - 1];

		const float cost = rising.Surface() * Blocks_For(lower) + costAbove[i];

		if((lower > 0) && (cost < best.cost))
		{
			best.below = below;
			best.below.bin = i;
			best.cost = cost;
		}
	}
}

/// Where many triangles are divided.
static AccelMeshIterator Divide_Many(AccelMeshIterator begin, AccelMeshIterator end)
{
	AccelMeshCut best;
	float lo[3], hi[3];

	best.cost = HUGE_VAL;
	for(int axis = X; axis <= Z; axis++)
	{
		lo[axis] = HUGE_VAL;
		hi[axis] = -HUGE_VAL;
		for(AccelMeshIterator item = begin; item != end; item++)
		{
			lo[axis] = min(lo[axis], item->Middle(axis));
			hi[axis] = max(hi[axis], item->Middle(axis));
		}
	}
	for(int axis = X; axis <= Z; axis++)
	{
		AccelMeshBelow below = { axis, 0, lo[axis], AccelMeshBelow::BINS / (hi[axis] - lo[axis]) };

		if((below.scale > 0.0f) && (below.scale < HUGE_VAL))
			Try_Axis(begin, end, below, best);
	}

	return (best.cost < HUGE_VAL) ? std::partition(begin, end, best.below) : begin + (end - begin) / 2;
}

/// As many are few.
static const size_t FEW_TRIANGLES = 8 * ACCEL_MESH_LANES;

/// A number that orders triangles as their middles along an axis do, and holds the place of one below.
static uint64_t Sort_Key(float middle, size_t place)
{
	uint32_t bits;

	memcpy(&bits, &middle, sizeof(bits));
	bits ^= (bits >> 31) ? 0xffffffffu : 0x80000000u;

	return (uint64_t(bits) << 32) | place;
}

/// The best cut of few triangles in order, behind full blocks.
static float Find_Cut(const AccelMeshItem *items, const uint64_t *order, size_t count, size_t& place)
{
	AccelMeshExtent rising, falling;
	float least = HUGE_VAL, above[FEW_TRIANGLES / ACCEL_MESH_LANES];

	for(size_t i = count; i-- > size_t(ACCEL_MESH_LANES); )
	{
		falling.Include(items[uint32_t(order[i])]);
		if(i % ACCEL_MESH_LANES == 0)
			above[i / ACCEL_MESH_LANES] = falling.Surface() * Blocks_For(count - i);
	}
	place = ACCEL_MESH_LANES;
	for(size_t i = 0; i < count; i++)
	{
		if((i > 0) && (i % ACCEL_MESH_LANES == 0))
		{
			const float cost = rising.Surface() * Blocks_For(i) + above[i / ACCEL_MESH_LANES];

			if(cost < least)
			{
				least = cost;
				place = i;
			}
		}
		rising.Include(items[uint32_t(order[i])]);
	}

	return least;
}

/// Where few triangles are divided, so that the lower ones fill their blocks.
static AccelMeshIterator Divide_Few(AccelMeshIterator begin, AccelMeshIterator end)
{
	const size_t count = end - begin;
	AccelMeshItem items[FEW_TRIANGLES];
	uint64_t order[3][FEW_TRIANGLES];
	size_t place[3];
	float cost[3];
	int best = X;

	std::copy(begin, end, items);
	for(int axis = X; axis <= Z; axis++)
	{
		for(size_t i = 0; i < count; i++)
			order[axis][i] = Sort_Key(items[i].Middle(axis), i);
		std::sort(order[axis], order[axis] + count);
		cost[axis] = Find_Cut(items, order[axis], count, place[axis]);
		if(cost[axis] < cost[best])
			best = axis;
	}
	for(size_t i = 0; i < count; i++)
		begin[i] = items[uint32_t(order[best][i])];

	return begin + place[best];
}

static void Put_Blocks(const MESH_DATA& data, AccelMeshIterator begin, AccelMeshIterator end, vector<AccelMeshBlock>& blocks)
{
	while(end - begin > ACCEL_MESH_LANES)
	{
		const AccelMeshIterator middle = (size_t(end - begin) > FEW_TRIANGLES) ? Divide_Many(begin, end) : Divide_Few(begin, end);

		// the smaller part first, so that the stack stays small
		if(middle - begin < end - middle)
		{
			Put_Blocks(data, begin, middle, blocks);
			begin = middle;
		}
		else
		{
			Put_Blocks(data, middle, end, blocks);
			end = middle;
		}
	}
	if(begin == end)
		return;
	blocks.push_back(Idle_Block());
	for(int lane = 0; begin + lane != end; lane++)
		Put_Triangle(blocks.back(), lane, data, begin[lane].index);
}

static AccelMeshItem Make_Item(const MESH_DATA& data, uint32_t index)
{
	const MESH_TRIANGLE& triangle = data.Triangles[index];
	AccelMeshItem item;

	item.index = index;
	for(int axis = X; axis <= Z; axis++)
	{
		const float a = data.Vertices[triangle.P1][axis], b = data.Vertices[triangle.P2][axis], c = data.Vertices[triangle.P3][axis];

		item.lo[axis] = min(a, min(b, c));
		item.hi[axis] = max(a, max(b, c));
	}

	return item;
}

/// The largest finite coordinate of a corner.
static double Largest_Corner(const MESH_DATA& data)
{
	double largest = 0.0;

	for(long i = 0; i < data.Number_Of_Triangles; i++)
	{
		const long corners[3] = { data.Triangles[i].P1, data.Triangles[i].P2, data.Triangles[i].P3 };

		for(int j = 0; j < 9; j++)
		{
			const double size = fabs(data.Vertices[corners[j / 3]][j % 3]);

			if((size > largest) && (size < HUGE_VAL))
				largest = size;
		}
	}

	return largest;
}

accel_box Bound_Mesh(const MESH_DATA& data, double& largest)
{
	accel_box box = Empty_Box();

	largest = Largest_Corner(data);
	for(long i = 0; i < data.Number_Of_Triangles; i++)
	{
		AccelMeshBlock block;

		Put_Triangle(block, 0, data, i);
		if(Is_Idle(block, 0))
			continue;
		if(Is_Loose(block, 0, largest))
			return Infinite_Box();
		Include_Triangle(box, block, 0, 0.0);
	}

	return box;
}

AccelMeshGroups::AccelMeshGroups(const MESH_DATA& data) : triangles(0), looseTriangles(0), largest(Largest_Corner(data))
{
	vector<AccelMeshItem> items;

	items.reserve(data.Number_Of_Triangles);
	for(long i = 0; i < data.Number_Of_Triangles; i++)
	{
		AccelMeshBlock block = Idle_Block();

		Put_Triangle(block, 0, data, i);
		if(Is_Idle(block, 0))
			continue;
		if(Is_Loose(block, 0, largest))
		{
			if(looseTriangles % ACCEL_MESH_LANES == 0)
				looseBlocks.push_back(Idle_Block());
			Put_Triangle(looseBlocks.back(), looseTriangles % ACCEL_MESH_LANES, data, i);
			looseTriangles++;
		}
		else
			items.push_back(Make_Item(data, i));
	}
	triangles = items.size();
	blocks.reserve(Blocks_For(triangles) + Blocks_For(triangles) / 8);
	Put_Blocks(data, items.begin(), items.end(), blocks);
	if(blocks.capacity() > blocks.size() + blocks.size() / 16)
		vector<AccelMeshBlock>(blocks).swap(blocks);
}

}
